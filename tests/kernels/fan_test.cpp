// Barnes' fans: the changes of basis, the counts, the answers, and meshes taken apart into them.
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <kernels/all_kernels.h>
#include <kernels/counted.h>
#include <pierce/fans.h>
#include <pierce/pierce.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using kernels::TriangleFan;
using D = Vec3<double>;

struct Geometry {
    D apex;
    std::vector<D> ring;
};

/// n good triangles that go up around an axis like a spiral stair, in any orientation.
Geometry stair(std::size_t n, Random& random) {
    Geometry fan{random.in_cube(), {}};
    const D axis = random.direction();
    const D x = axis.cross(random.direction()).normalized();
    const D y = axis.cross(x);
    double angle = 0;
    for (std::size_t k = 0; k <= n; ++k) {
        fan.ring.push_back(fan.apex + random.between(0.5, 1) * (std::cos(angle) * x + std::sin(angle) * y) + random.between(-0.4, 0.4) * axis);
        angle += random.between(0.4, 1.6);
    }
    return fan;
}

TEST(TriangleFan, EachChangeOfBasisTakesItsTriangleToTheUnitTriangle) {
    Random random(1);
    for (int i = 0; i < 2'000; ++i) {
        const Geometry fan = stair(2 + random.below(7), random);
        const auto stored = kernels::triangle_fan.prepare<double>(fan.apex, fan.ring);
        ASSERT_EQ(stored.triangles() + 1, fan.ring.size());
        for (std::size_t k = 0; k < stored.triangles(); ++k) {
            const D n = (fan.ring[k] - fan.apex).cross(fan.ring[k + 1] - fan.apex);
            const std::array<D, 4> points = {fan.apex, fan.ring[k], fan.ring[k + 1], fan.apex + n};
            for (std::size_t p = 0; p < 4; ++p) {
                const auto at = kernels::triple(points[p]);
                std::array<double, 3> x = {stored.first.u(at), stored.first.u_plus_v(at), stored.first.height(at)};
                for (std::size_t step = 0; step < k; ++step) {
                    const auto& m = stored.turns[step];
                    x = {m.a * x[0] + x[1] + m.d * x[2], m.b * x[0] + m.e * x[2], m.c * x[0] + m.f * x[2]};
                }
                if (k == 0) x[1] -= x[0];
                EXPECT_NEAR(x[0], p == 1 ? 1 : 0, 1e-9);
                EXPECT_NEAR(x[1], p == 2 ? 1 : 0, 1e-9);
                EXPECT_NEAR(x[2], p == 3 ? 1 : 0, 1e-9);
            }
        }
    }
}

TriangleFan::First<Counted> counted(const TriangleFan::First<double>& f) {
    const auto plane = [](const kernels::Plane<double>& p) {
        return kernels::Plane<Counted>{{Counted(p.normal[0]), Counted(p.normal[1]), Counted(p.normal[2])}, Counted(p.offset)};
    };
    return {plane(f.u), plane(f.u_plus_v), plane(f.height)};
}

Counts count(const TriangleFan::First<double>& first, const std::vector<TriangleFan::Turn<double>>& turns, const D& from,
                      const D& to, bool& hit, std::size_t& which) {
    std::vector<TriangleFan::Turn<Counted>> copy;
    for (const auto& m : turns) copy.push_back({Counted(m.a), Counted(m.b), Counted(m.c), Counted(m.d), Counted(m.e), Counted(m.f)});
    const auto point = [](const D& p) { return kernels::Triple<Counted>{Counted(p[0]), Counted(p[1]), Counted(p[2])}; };
    const auto numbers = counted(first);
    Counted::counts = {};
    const auto answer = kernels::triangle_fan.evaluate<Counted>(numbers, copy, point(from), point(to));
    hit = answer.has_value();
    which = hit ? answer->triangle : 0;
    return Counted::counts;
}

void expect_within(const Counts& counts, int n) {
    EXPECT_LE(counts.divisions, n);
    EXPECT_LE(counts.multiplications, 6 + 14 * n);
    EXPECT_LE(counts.additions, 7 + 11 * n);
}

// No geometry hits every triangle of a fan, each nearer than the one before. Numbers do: each change of basis is chosen so that the line
// meets the next plane a little earlier, at (1/4, 1/4). So every operation that the code has is run.
TEST(TriangleFan, WorstCaseStaysWithinBarnesCounts) {
    for (int n = 1; n <= 12; ++n) {
        const TriangleFan::First<double> first{{{1, 0, 0}, 0}, {{1, 1, 0}, 0}, {{0, 0, 1}, 0}};
        const D from(0.125, 0.25, 1);
        const D to(0.375, 0.25, -1);
        std::vector<TriangleFan::Turn<double>> turns;
        // u, v (u + v at first) and w at the start, and how much they fall towards the end.
        std::array<double, 3> start = {0.125, 0.375, 1};
        std::array<double, 3> back = {-0.25, -0.25, 2};
        for (int k = 1; k < n; ++k) {
            const double c = 1.0 / 64;
            const double w = c * start[0] + start[2];
            const double fall = c * back[0] + back[2];
            // w / fall must be below start[2] / back[2]: turn c around if it is not.
            const double sign = w / fall < start[2] / back[2] ? 1 : -1;
            const double t = (sign * c * start[0] + start[2]) / (sign * c * back[0] + back[2]);
            const double u = start[0] - t * back[0];
            const double v = start[1] - t * back[1];
            turns.push_back({(0.25 - v) / u, 0.25 / u, sign * c, 0, 0, 1});
            const auto& m = turns.back();
            const auto turned = [&m](const std::array<double, 3>& x) {
                return std::array<double, 3>{m.a * x[0] + x[1] + m.d * x[2], m.b * x[0] + m.e * x[2], m.c * x[0] + m.f * x[2]};
            };
            start = turned(start);
            back = turned(back);
        }
        bool hit = false;
        std::size_t which = 0;
        const Counts counts = count(first, turns, from, to, hit, which);
        ASSERT_TRUE(hit);
        ASSERT_EQ(which, static_cast<std::size_t>(n - 1));  // each was nearer than the one before
        std::printf("n = %2d: %d divisions, %d multiplications, %d additions (Barnes %d, %d, %d)\n", n, counts.divisions,
                    counts.multiplications, counts.additions, n, 6 + 14 * n, 7 + 11 * n);
        expect_within(counts, n);
        EXPECT_EQ(counts.divisions, n);
        EXPECT_EQ(counts.additions, 7 + 11 * n);  // else this is not the worst case
    }
}

TEST(TriangleFan, RealFansStayWithinBarnesCountsAndAnswerAsTheirTriangles) {
    Random random(9);
    int hits = 0;
    int different = 0;
    std::vector<std::int64_t> on(8);
    for (int i = 0; i < 100'000; ++i) {
        const Geometry fan = stair(1 + random.below(8), random);
        const auto n = fan.ring.size() - 1;
        const auto stored = kernels::triangle_fan.prepare<double>(fan.apex, fan.ring);
        const D from = 1.5 * random.in_cube();
        const std::size_t k = random.below(n);
        const D w = random.weights();
        const D to = from + random.between(0.5, 2) * (w[0] * fan.apex + w[1] * fan.ring[k] + w[2] * fan.ring[k + 1] - from);
        const auto answer = kernels::triangle_fan.test(stored, from, to);
        bool counted_hit = false;
        std::size_t which = 0;
        expect_within(count(stored.first, stored.turns, from, to, counted_hit, which), static_cast<int>(n));
        EXPECT_EQ(counted_hit, answer.has_value());
        std::optional<kernels::Answer<double>> nearest;
        std::size_t nearest_triangle = 0;
        for (std::size_t t = 0; t < n; ++t) {
            const auto one = tested(kernels::exact, {fan.apex, fan.ring[t], fan.ring[t + 1]}, from, to);
            if (!one || (nearest && nearest->fraction <= one->fraction)) continue;
            nearest = one;
            nearest_triangle = t;
        }
        if (nearest.has_value() != answer.has_value() || (answer && answer->triangle != nearest_triangle)) {
            ++different;
            continue;
        }
        if (!answer) continue;
        ++hits;
        ++on[answer->triangle];
        EXPECT_NEAR(answer->fraction, nearest->fraction, 1e-9);
        EXPECT_NEAR(answer->u, nearest->u, 1e-9);
        EXPECT_NEAR(answer->v, nearest->v, 1e-9);
    }
    std::printf("%d hits, %d answers that differ\n", hits, different);
    EXPECT_GT(hits, 30'000);
    for (const std::int64_t count : on) EXPECT_GT(count, 500);
    EXPECT_LE(different, 2);
}

TEST(TriangleFan, ABrokenChainIsRefusedByName) {
    const std::vector<D> ring = {{1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {-1, 0, 0}};
    try {
        (void)kernels::triangle_fan.prepare<double>(D(0, 0, 0), ring);
        FAIL() << "the second triangle has no area";
    } catch (const MeshError& error) {
        EXPECT_NE(std::string(error.what()).find("fan triangle 1"), std::string::npos) << error.what();
    }
    EXPECT_THROW((void)kernels::triangle_fan.prepare<double>(D(0, 0, 0), std::span(ring).first(1)), MeshError);
}

/// Every triangle once, each with its own corners in its own orientation, neighbours in a fan joined.
template <class Scalar>
std::size_t expect_cover(const TriangleSoup<Scalar>& soup) {
    const std::vector<Fan> fans = fans_of(soup.view());
    std::vector<int> covered(soup.triangles.size());
    std::size_t numbers = 0;
    for (const Fan& fan : fans) {
        EXPECT_EQ(fan.ring.size(), fan.triangles.size() + 1);
        for (std::size_t k = 0; k < fan.triangles.size(); ++k) {
            ++covered[fan.triangles[k]];
            IndexTriple t = soup.triangles[fan.triangles[k]];
            const IndexTriple expected = {fan.apex, fan.ring[k], fan.ring[k + 1]};
            for (int turns = 0; turns < 2 && t != expected; ++turns) t = {t[1], t[2], t[0]};
            EXPECT_EQ(t, expected);
        }
        const auto stored = prepare(soup.view(), fan);
        EXPECT_EQ(stored.triangles(), fan.triangles.size());
        numbers += 6 * (fan.triangles.size() + 1);
    }
    for (const int times : covered) EXPECT_EQ(times, 1);
    std::printf("%zu triangles in %zu fans: %.2f triangles a fan, %.2f numbers a triangle\n", soup.triangles.size(), fans.size(),
                double(soup.triangles.size()) / double(fans.size()), double(numbers) / double(soup.triangles.size()));
    return fans.size();
}

TEST(Fans, CoverEveryTriangleOnce) {
    const auto sphere = bumpy_sphere(20);
    EXPECT_LT(expect_cover(sphere), sphere.triangles.size() * 2 / 5);  // a perfect matching of one-rings would be a sixth
    expect_cover(terrain(20, 0.1, 1));
    expect_cover(polycube(4, 0.5, 1, 3));  // edges with four faces, vertices where several sheets meet
    expect_cover(shards(300, 4));          // nothing joined
    TriangleSoup<double> doubled = bumpy_sphere(3);
    doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(), doubled.triangles.end());
    expect_cover(doubled);
    TriangleSoup<double> odd = terrain(3, 0, 1);
    odd.triangles.push_back({0, 0, 1});  // names a vertex twice
    odd.triangles.push_back({0, 1, 2});  // without area
    odd.triangles.push_back({1, 0, 5});  // turned against its neighbour
    expect_cover(odd);
    EXPECT_TRUE(fans_of(TriangleSoup<double>{}.view()).empty());
    odd.triangles.push_back({0, 1, 99});
    EXPECT_THROW((void)fans_of(odd.view()), MeshError);
}

// All fans of a closed mesh, one after the other, find what its triangles tested exactly find.
TEST(Fans, OfAMeshAnswerAsTheMesh) {
    const TriangleSoup<double> sphere = bumpy_sphere(12);
    const CollisionMesh<double> mesh(sphere.view());
    const std::vector<Fan> fans = fans_of(sphere.view());
    std::vector<TriangleFan::Stored<double>> stored;
    for (const Fan& fan : fans) stored.push_back(prepare(sphere.view(), fan));
    Random random(6);
    int hits = 0;
    for (int i = 0; i < 2'000; ++i) {
        const D from = 2 * random.direction();
        const D to = 0.8 * random.in_cube();
        double best = 2;
        std::uint32_t face = ~0U;
        for (std::size_t f = 0; f < fans.size(); ++f)
            if (const auto hit = kernels::triangle_fan.test(stored[f], from, to); hit && hit->fraction < best) {
                best = hit->fraction;
                face = fans[f].triangles[hit->triangle];
            }
        const auto truth = mesh.first_hit({from, to});
        ASSERT_EQ(truth.has_value(), face != ~0U);
        if (!truth) continue;
        ++hits;
        EXPECT_EQ(face, truth->face);
        EXPECT_NEAR(best, truth->exact_fraction, 1e-12);
    }
    EXPECT_GT(hits, 1'000);
}

}  // namespace
}  // namespace pierce::test
