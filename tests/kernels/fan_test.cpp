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
                    auto m = stored.turns[step];
                    if (step + 1 == stored.turns.size()) m = {m.a - m.b, m.b, m.c, m.d - m.e, m.e, m.f};
                    x = {m.a * x[0] + x[1] + m.d * x[2], m.b * x[0] + m.e * x[2], m.c * x[0] + m.f * x[2]};
                }
                if (k == 0) x[1] -= x[0];
                const D size = (fan.ring[k] - fan.apex).cwiseAbs().cwiseMax((fan.ring[k + 1] - fan.apex).cwiseAbs());
                const double height = std::exp2(std::ilogb(size.maxCoeff()));  // the basis has n at this scale, for units' sake
                EXPECT_NEAR(x[0], p == 1 ? 1 : 0, 1e-9);
                EXPECT_NEAR(x[1], p == 2 ? 1 : 0, 1e-9);
                EXPECT_NEAR(x[2], p == 3 ? height : 0, 1e-9);
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

// No geometry has each plane of a fan met nearer than the one before, always in the same place. Numbers do: each change of basis is chosen so
// that the line meets the next plane a little earlier, at u = v = `at`. With 1/4 every triangle is hit, and the last is the answer; with
// 3/4 all but the first are rejected by u + v <= 1, the last condition, and the first is the answer. So every operation that the code has is run
// but the difference v = z - u of the one that is not the answer.
Counts worst_case(int n, double at, std::size_t& which) {
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
        turns.push_back({(at - v) / u, at / u, sign * c, 0, 0, 1});
        const auto& m = turns.back();
        const auto turned = [&m](const std::array<double, 3>& x) {
            return std::array<double, 3>{m.a * x[0] + x[1] + m.d * x[2], m.b * x[0] + m.e * x[2], m.c * x[0] + m.f * x[2]};
        };
        start = turned(start);
        back = turned(back);
    }
    if (n > 1) turns.back().a += turns.back().b;  // as the last one is stored; d and e are zero
    bool hit = false;
    const Counts counts = count(first, turns, from, to, hit, which);
    EXPECT_TRUE(hit);
    return counts;
}

TEST(TriangleFan, WorstCasesStayWithinBarnesCounts) {
    for (int n = 1; n <= 12; ++n) {
        for (const double at : {0.25, 0.75}) {
            std::size_t which = 0;
            const Counts counts = worst_case(n, at, which);
            ASSERT_EQ(which, at < 0.5 ? static_cast<std::size_t>(n - 1) : 0U);
            std::printf("n = %2d, answer %2zu: %d divisions, %d multiplications, %d additions (Barnes %d, %d, %d)\n", n, which, counts.divisions,
                        counts.multiplications, counts.additions, n, 6 + 14 * n, 7 + 11 * n);
            expect_within(counts, n);
            EXPECT_EQ(counts.divisions, n);
            EXPECT_EQ(counts.additions, 7 + 11 * n);  // else this is not the worst case
        }
    }
}

// The reviewer found one addition too many with these numbers, when the last triangle was judged by a sum.
TEST(TriangleFan, AFirstTriangleThatStaysTheAnswerCostsNoMore) {
    const TriangleFan::First<double> first{{{1, 0, 0}, 0}, {{1, 1, 0}, 0}, {{0, 0, 1}, 0}};
    bool hit = false;
    std::size_t which = 9;
    const Counts counts = count(first, {{8, 8, -1.0 / 64, 0, 0, 1}}, {0.125, 0.25, 1}, {0.375, 0.25, -1}, hit, which);
    EXPECT_TRUE(hit && which == 0);
    expect_within(counts, 2);
}

/// A fan of n triangles in units of 2^exponent, each hit near its middle, alone or in the fan: the largest error of u, v and fraction, and how many
/// have another answer.
template <class Scalar>
std::pair<double, int> at_scale(int exponent, std::size_t n) {
    Random random(7);
    double worst = 0;
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
        const Geometry fan = stair(n, random);
        const auto placed = [exponent](const D& x) -> Vec3<Scalar> { return (std::ldexp(1.0, exponent) * x).cast<Scalar>(); };
        std::vector<Vec3<Scalar>> ring;
        for (const D& p : fan.ring) ring.push_back(placed(p));
        const auto stored = kernels::triangle_fan.prepare<Scalar>(placed(fan.apex), ring);
        const std::size_t k = random.below(n);
        const D w = D(0.2, 0.2, 0.2) + 0.4 * random.weights();
        const D x = w[0] * fan.apex + w[1] * fan.ring[k] + w[2] * fan.ring[k + 1];
        const D normal = (fan.ring[k] - fan.apex).cross(fan.ring[k + 1] - fan.apex).normalized();
        const auto answer = kernels::triangle_fan.test(stored, placed(x + 0.01 * normal), placed(x - 0.01 * normal));
        if (answer && answer->triangle == k)
            worst = std::max({worst, std::abs(double{answer->fraction} - 0.5), std::abs(double{answer->u} - w[1]), std::abs(double{answer->v} - w[2])});
        else ++wrong;
    }
    return {worst, wrong};
}

// Powers of two change nothing: each error is that of 2^0, to the bit, and all answers are right. Edges are 0.5 to 1.1 long, so the exponents of
// the documented range are those with one to spare.
template <class Scalar>
void expect_range() {
    constexpr int range = TriangleFan::k_range<Scalar>;
    static_assert(range == (sizeof(Scalar) == 4 ? 40 : 320));  // as has_basis documents it
    for (const std::size_t n : {1U, 4U}) {
        const auto plain = at_scale<Scalar>(0, n);
        std::printf("%zu bytes, n = %zu: largest error %.2g\n", sizeof(Scalar), n, plain.first);
        EXPECT_EQ(plain.second, 0);
        EXPECT_LT(plain.first, 3e3 * std::numeric_limits<Scalar>::epsilon());  // of 1 / 0.01 in fractions; a sanity check
        for (const int exponent : {1 - range, -26, -28, -30, 26, 30, range - 1}) EXPECT_EQ(at_scale<Scalar>(exponent, n), plain) << exponent;
        for (const int exponent : {-range - 4, range + 4}) {
            if (n == 1) EXPECT_EQ(at_scale<Scalar>(exponent, n).second, 500) << exponent;
            else EXPECT_THROW((void)at_scale<Scalar>(exponent, n), MeshError) << exponent;
        }
    }
    using V = Vec3<Scalar>;
    const Scalar large = std::ldexp(Scalar{1}, range);
    const Scalar small = std::ldexp(Scalar{1}, -range);
    const auto has_basis = [](const V& b, const V& c) { return TriangleFan::has_basis<Scalar>(V(0, 0, 0), b, c); };
    EXPECT_TRUE(has_basis({1, 0, 0}, {1, small, 0}));
    EXPECT_FALSE(has_basis({1, 0, 0}, {1, small / 2, 0}));
    // Neighbours that share a short edge, one as large and as thin as is allowed, the other as small: the turns' largest numbers, and finite.
    std::vector<V> ring = {{large, 0, 0}, {0, 2 * small * large, 0}, {-1, small, 0}};
    for (int turned = 0; turned < 2; ++turned) {
        const auto stored = kernels::triangle_fan.prepare<Scalar>(V(0, 0, 0), ring);
        const auto& m = stored.turns[0];
        EXPECT_TRUE(std::isfinite(m.a) && std::isfinite(m.b) && std::isfinite(m.c) && std::isfinite(m.d) && std::isfinite(m.e) && std::isfinite(m.f));
        std::swap(ring[0], ring[2]);
    }
}

TEST(TriangleFan, TheDocumentedRangeIsTrueInFloat) { expect_range<float>(); }
TEST(TriangleFan, TheDocumentedRangeIsTrueInDouble) { expect_range<double>(); }

// From the front of the first and second triangle through the edge between them, in numbers that nothing is rounded of.
TEST(TriangleFan, OfEqualFractionsTheFirstTriangleIsTheAnswer) {
    const std::vector<D> ring = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    for (const std::size_t n : {2U, 3U}) {
        const auto stored = kernels::triangle_fan.prepare<double>(D(0, 0, 0), std::span(ring).first(n + 1));
        const auto answer = kernels::triangle_fan.test(stored, D(0, 0.5, 1), D(0, 0.5, -1));
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->triangle, 0U);
        EXPECT_EQ(answer->v, 0.5);
        const auto last = kernels::triangle_fan.test(stored, D(ring[n - 1][0] / 2, ring[n - 1][1] / 2, 1), D(ring[n - 1][0] / 2, ring[n - 1][1] / 2, -1));
        ASSERT_TRUE(last);
        EXPECT_EQ(last->triangle, n - 2);
    }
}

// A fan that is folded: the first triangle is flat, the others stand up from it in turn.
TEST(TriangleFan, SidesAreWhatTheParameterSaysForEachTriangle) {
    Random random(3);
    for (int i = 0; i < 2'000; ++i) {
        const Geometry fan = stair(2 + random.below(4), random);
        const auto n = fan.ring.size() - 1;
        const auto stored = kernels::triangle_fan.prepare<double>(fan.apex, fan.ring);
        const std::size_t k = random.below(n);
        const D x = (fan.apex + fan.ring[k] + fan.ring[k + 1]) / 3;
        const D out = 1e-3 * (fan.ring[k] - fan.apex).cross(fan.ring[k + 1] - fan.apex).normalized();  // so short that no other is met
        for (const Sides sides : {Sides::front, Sides::back, Sides::both}) {
            const TriangleFan kernel{sides};
            const auto down = kernel.test(stored, x + out, x - out);
            const auto up = kernel.test(stored, x - out, x + out);
            ASSERT_EQ(down.has_value(), sides != Sides::back);
            ASSERT_EQ(up.has_value(), sides != Sides::front);
            for (const auto& answer : {down, up}) {
                if (!answer) continue;
                EXPECT_EQ(answer->triangle, k);
                EXPECT_NEAR(answer->fraction, 0.5, 1e-9);
                EXPECT_NEAR(answer->u, 1.0 / 3, 1e-9);
                EXPECT_NEAR(answer->v, 1.0 / 3, 1e-9);
            }
        }
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
std::size_t expect_cover(const TriangleSoup<Scalar>& soup, std::size_t most = k_most_in_fan) {
    const std::vector<Fan> fans = fans_of(soup.view(), most);
    std::vector<int> covered(soup.triangles.size());
    std::size_t numbers = 0;
    for (const Fan& fan : fans) {
        EXPECT_EQ(fan.ring.size(), fan.triangles.size() + 1);
        EXPECT_GE(fan.triangles.size(), 1U);
        EXPECT_LE(fan.triangles.size(), most);
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
    // Two triangles that share a long edge: each has a basis at the corner that it names first, but not at the ends of the edge.
    const double s = 1.5 * std::ldexp(1.0, TriangleFan::k_range<double>);
    TriangleSoup<double> long_edge;
    long_edge.positions = {{0, 0, 0}, {s, 0, 0}, {-s, s / 2, 0}, {0, s, 0}};
    long_edge.triangles = {{0, 1, 2}, {3, 2, 1}};
    EXPECT_EQ(expect_cover(long_edge), 2U);
    odd.triangles.push_back({0, 1, 99});
    EXPECT_THROW((void)fans_of(odd.view()), MeshError);
}

// A double cone over a polygon with 50 corners: two vertices of valence 50. Cut into as few parts as will do, equally long but for one.
TEST(Fans, HaveAtMostTheMembersThatAreAskedFor) {
    TriangleSoup<double> cone;
    cone.positions = {{0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t k = 0; k < 50; ++k) {
        cone.positions.emplace_back(std::cos(0.02 * 6.2831853 * k), std::sin(0.02 * 6.2831853 * k), 0);
        cone.triangles.push_back({0, 2 + k, 2 + (k + 1) % 50});
        cone.triangles.push_back({1, 2 + (k + 1) % 50, 2 + k});
    }
    EXPECT_EQ(k_most_in_fan, 16U);
    for (const auto& [most, fans] : {std::pair{50U, 2U}, {49U, 4U}, {16U, 8U}, {7U, 16U}, {1U, 100U}}) EXPECT_EQ(expect_cover(cone, most), fans);
    EXPECT_EQ(fans_of(cone.view(), 0).size(), 100U);
    for (const Fan& fan : fans_of(cone.view())) EXPECT_GE(fan.triangles.size(), 12U);
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
