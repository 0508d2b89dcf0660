// The tips of thin spikes, seen from inside: no place near the hit is clear, and some 2,000 are asked about. Each took
// a test of all the faces that meet there, 0.5 ms a hit with 3 faces and 30 ms with 200; now what is certain of a
// face's shadow is not tested (query/nearby.h). Counted are full tests of a triangle, which a kernel of the test's own
// sees. The judges are the naive twin, which knows no shadows, and exact arithmetic.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>
#include <query/answer.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/naive.h>
#include <Eigen/Geometry>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// Five times as high as wide, open at its base; about half of them are regular.
template <class Scalar>
struct Spike {
    TriangleSoup<Scalar> soup;
    V tip;
    V axis;
    double height;
    double unit;

    Spike(std::uint32_t faces, Random& random) {
        axis = random.direction();
        height = std::exp(random.between(-2, 1));
        const double ragged = random.chance(0.5) ? 0.4 : 0;
        const V at = (random.chance(0.5) ? 1 : 10) * random.in_cube();
        const V x = axis.unitOrthogonal();
        const V y = axis.cross(x);
        soup.positions.push_back(at.cast<Scalar>());
        for (std::uint32_t i = 0; i < faces; ++i) {
            const double angle = 6.283185307179586 * i / faces;
            const double radius = height / 10 * (1 + ragged * random.between(-1, 1));
            const V rim = at - height * axis + radius * (std::cos(angle) * x + std::sin(angle) * y);
            soup.positions.push_back(rim.cast<Scalar>());
            soup.triangles.push_back({0, i + 1, (i + 1) % faces + 1});
        }
        tip = soup.positions[0].template cast<double>();
        double largest = 0;
        for (const Vec3<Scalar>& p : soup.positions) largest = std::max(largest, double(p.cwiseAbs().maxCoeff()));
        unit = detail::last_place<Scalar>(largest);
    }

    // From inside or, one of four, from anywhere, to within some units of the tip and on.
    [[nodiscard]] Segment<Scalar> segment(Random& random) const {
        const V inside = tip - height * (random.between(0.05, 0.95) * axis + 0.02 * random.in_cube());
        const V from = random.chance(0.75) ? inside : V(tip + height * random.between(0.3, 3) * random.direction());
        const V at = tip + unit * (4 * random.in_cube() - random.between(0, random.chance(0.5) ? 6 : 60) * axis);
        const V to = at + random.between(0.01, 1) * (at - from);
        return {from.cast<Scalar>(), to.cast<Scalar>()};
    }
};

std::uint64_t g_tests = 0;

struct Counting : detail::Certified {
    template <class Scalar>
    static bool test(const detail::Scene<Scalar>& scene, detail::TriangleRef triangle, const detail::Path& path,
                     Sides sides, double limit, QueryCounters& counters, detail::Candidate& candidate) {
        ++g_tests;
        return Certified::test(scene, triangle, path, sides, limit, counters, candidate);
    }
};

// The most tests of a triangle that one of 200 hits took.
template <class Scalar>
std::uint64_t most_tests(std::uint32_t faces) {
    Random random(71);
    std::uint64_t most = 0;
    for (int hits = 0; hits < 200;) {
        const Spike<Scalar> spike(faces, random);
        const detail::Scene<Scalar> scene = detail::make_scene(spike.soup.view(), {});
        for (int i = 0; i < 20; ++i) {
            QueryCounters counters;
            g_tests = 0;
            const auto hit = detail::first_answer<Counting>(scene, detail::to_path(spike.segment(random)),
                                                            {.sides = Sides::both}, counters);
            hits += hit ? 1 : 0;
            most = std::max(most, g_tests);
        }
    }
    return most;
}

TEST(Spikes, faces_are_not_tested_for_each_place) {
    for (const std::uint32_t faces : {3U, 12U, 50U, 200U}) {
        const std::uint64_t in_float = most_tests<float>(faces);
        const std::uint64_t in_double = most_tests<double>(faces);
        std::cout << faces << " faces: at most " << in_float << " tests a hit in float, " << in_double
                  << " in double\n";
        // Three ways past all of them, some hundred tries at a few faces each, and then each face once or twice.
        EXPECT_LE(in_float, 400 + 20 * faces);
        EXPECT_LE(in_double, 400 + 20 * faces);
    }
}

// Some queries' options: sides, a mask, and a test of the caller's that takes a face at one place and not at the next.
template <class Scalar>
void expect_naive_answers(std::uint32_t faces, int meshes, int segments) {
    Random random(72 + faces);
    std::uint64_t retreats = 0;
    for (int m = 0; m < meshes; ++m) {
        const Spike<Scalar> spike(faces, random);
        const CollisionMesh<Scalar> mesh(spike.soup.view());
        const CollisionMesh<Scalar> grid(spike.soup.view(), {.broadphase = Broadphase::grid});
        const NaiveMesh<Scalar> naive(spike.soup.view());
        std::vector<std::uint8_t> mask(faces, 1);
        mask[random.below(faces)] = 0;
        const auto fickle = [](const Contact& contact) { return (bits(contact.barycentric[0]) & 3) != 0; };
        for (int i = 0; i < segments; ++i) {
            const Segment<Scalar> segment = spike.segment(random);
            QueryCounters counters;
            QueryOptions options;
            options.sides = std::array{Sides::front, Sides::back, Sides::both, Sides::both}[random.below(4)];
            options.counters = &counters;
            if (random.chance(0.2)) options.face_mask = mask;
            if (random.chance(0.1)) options.accept = fickle;
            const auto expected = naive.first_hit(segment, options);
            ASSERT_TRUE(same_answer(mesh.first_hit(segment, options), expected)) << to_text(segment);
            ASSERT_TRUE(same_answer(grid.first_hit(segment, options), expected)) << to_text(segment);
            std::array<std::optional<Hit<Scalar>>, 1> of_batch;
            mesh.first_hits(std::span(&segment, 1), of_batch, options);
            ASSERT_TRUE(same_answer(of_batch[0], expected)) << to_text(segment);
            if (i % 4 == 0) {
                std::array<Hit<Scalar>, 3> all;
                std::array<Hit<Scalar>, 3> all_expected;
                const std::size_t count = naive.all_hits(segment, all_expected, options);
                ASSERT_EQ(mesh.all_hits(segment, all, options), count) << to_text(segment);
                for (std::size_t k = 0; k < std::min(count, all.size()); ++k)
                    ASSERT_TRUE(same_bits(all[k], all_expected[k])) << k << ", " << to_text(segment);
            }
            retreats += counters.retreats;
        }
    }
    EXPECT_GT(retreats, 100U);
}

void expect_naive_answers_of_both(std::uint32_t faces, int meshes, int segments) {
    expect_naive_answers<float>(faces, meshes, segments);
    expect_naive_answers<double>(faces, meshes, segments);
}

TEST(Spikes, naive_answers_with_3_faces) { expect_naive_answers_of_both(3, 40, 40); }
TEST(Spikes, naive_answers_with_12_faces) { expect_naive_answers_of_both(12, 20, 20); }
TEST(Spikes, naive_answers_with_50_faces) { expect_naive_answers_of_both(50, 10, 10); }
TEST(Spikes, naive_answers_with_200_faces) { expect_naive_answers_of_both(200, 5, 10); }

// What a shadow says is so: for triangles of all shapes and starts close to their planes, of places within parts of a
// unit of planes, edges and corners.
struct Told {
    int beside = 0;
    int hidden = 0;
    int unsure = 0;
};

void expect_true_shadows(double scale, Told& told) {
    Random random(73);
    for (int i = 0; i < 20'000; ++i) {
        const auto near = [&](double size) -> V { return scale * size * random.in_cube(); };
        const double thin = std::exp(random.between(-30, 0));
        const V middle = near(random.chance(0.5) ? 1 : 100);
        const V a = middle + near(1);
        const V b = middle + near(1);
        const V c = random.chance(0.5) ? V(a + random.unit() * (b - a) + near(thin)) : V(middle + near(1));
        const std::array<double, 3> w = {random.unit(), random.unit(), random.unit()};
        const V inside = (w[0] * a + w[1] * b + w[2] * c) / (w[0] + w[1] + w[2]);
        const double flat = random.chance(0.3) ? std::exp(random.between(-35, 0)) : 1;
        const V in_plane = middle + (b - a) * random.unit() + (c - a) * random.unit();
        const V from = near(flat) + (random.chance(0.3) ? inside : in_plane);
        const detail::Corners corners = {detail::to_point(a), detail::to_point(b), detail::to_point(c)};
        const double unit = std::exp2(std::floor(std::log2(scale))) * (random.chance(0.5) ? 0x1p-52 : 0x1p-23);
        const V at = std::array{a, V(a + random.unit() * (b - a)), inside}[random.below(3)];
        const V origin = at + 12 * unit * random.in_cube();
        const detail::Shadow shadow(corners, detail::to_point(from), detail::to_point(origin), unit);
        for (int n = 0; n < 8; ++n) {
            const V place = at + (random.chance(0.5) ? 12 : 0.01) * unit * random.in_cube();
            detail::Point relative;
            for (std::size_t k = 0; k < 3; ++k) relative[k] = (place[int(k)] - origin[int(k)]) / unit;
            const detail::Seen seen = shadow.seen(relative);
            const detail::Path way{detail::to_point(from), detail::to_point(place)};
            const auto decision = detail::decide(way, corners, Sides::both);
            EXPECT_EQ(shadow.hides(relative), seen == detail::Seen::hidden);
            if (seen == detail::Seen::hidden) {
                ASSERT_TRUE(decision.hit && !decision.at_start) << i;
            }
            if (seen == detail::Seen::beside) {
                ASSERT_FALSE(decision.hit) << i;
            }
            ++(seen == detail::Seen::hidden ? told.hidden : seen == detail::Seen::beside ? told.beside : told.unsure);
        }
    }
}

TEST(Spikes, shadows_say_what_exact_arithmetic_says) {
    for (const double scale : {1.0, 1e80, 1e-80, 1e300, 1e-290}) {
        Told told;
        expect_true_shadows(scale, told);
        std::cout << scale << ": " << told.beside << " beside, " << told.hidden << " hidden, " << told.unsure
                  << " unsure\n";
        if (scale > 1e-200 && scale < 1e200) {  // beyond, products of three lengths leave a double's range
            EXPECT_GT(told.beside, 10'000);
            EXPECT_GT(told.hidden, 10'000);
            EXPECT_GT(told.unsure, 1'000);
        }
    }
}

}  // namespace
}  // namespace pierce::test
