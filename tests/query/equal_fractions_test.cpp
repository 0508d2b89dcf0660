// Hits of one all_hits call that are at exactly the same fraction have the same bits in `exact_fraction`, and it never
// goes back from one hit to the next. Each was computed by itself once, within 1 ulp: of faces that meet in a vertex
// one had another last bit, and whoever grouped hits by it saw two walls.
#include <cmath>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/oracles.h>
#include <support/random.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

/// A fan around a vertex, and a segment through it at a fraction that lies exactly in the middle between two numbers of
/// the scalar type: the least error of a face decides to which of them it is rounded.
template <class Scalar>
struct Tie {
    explicit Tie(Random& random) {
        constexpr std::int64_t k_half = std::int64_t{1} << std::numeric_limits<Scalar>::digits;
        const double half = static_cast<double>(k_half);
        const auto odd = [&] { return 2 * static_cast<std::int64_t>(random.between(-0.2, 0.2) * half) + 1; };
        // from_z = -2^p and to_z = 2^p: the fraction is (2^p + z) / 2^(p+1), with z odd.
        const std::array<std::int64_t, 3> apex_of = {odd(), odd(), odd()};
        Vec3<double> apex;
        for (int k = 0; k < 3; ++k) {
            const std::int64_t x = apex_of[static_cast<std::size_t>(k)];
            const std::int64_t times = k == 2 ? 1 : random.between_ints(-1, 1);
            const std::int64_t from = x - times * (k_half + apex_of[2]);
            const std::int64_t to = from + 2 * times * k_half;
            apex[k] = static_cast<double>(x);
            segment.from[k] = static_cast<Scalar>(from);
            segment.to[k] = static_cast<Scalar>(to);
            exact = exact && static_cast<std::int64_t>(segment.from[k]) == from &&
                    static_cast<std::int64_t>(segment.to[k]) == to;
        }
        if (random.chance(0.5)) std::swap(segment.from, segment.to);
        soup.positions = {apex.cast<Scalar>()};
        for (int i = 0; i < k_faces; ++i) {
            const double angle = (i + random.between(-0.3, 0.3)) * 2 * M_PI / k_faces;
            const Vec3<double> ring(std::cos(angle), std::sin(angle), random.between(-0.3, 0.3));
            soup.positions.push_back((apex + half * random.between(0.1, 0.5) * ring).template cast<Scalar>());
            const auto ring_vertex = [](int at) { return static_cast<std::uint32_t>(at % k_faces + 1); };
            soup.triangles.push_back({0, ring_vertex(i), ring_vertex(i + 1)});
        }
    }
    static constexpr int k_faces = 7;
    TriangleSoup<Scalar> soup;
    Segment<Scalar> segment;
    bool exact = true;  ///< no coordinate was rounded
};

template <class Scalar>
void expect_equal_bits_at_ties() {
    Random random(5);
    int several = 0;
    for (int i = 0; i < 4000; ++i) {
        const Tie<Scalar> tie(random);
        if (!tie.exact) continue;
        const CollisionMesh<Scalar> mesh(tie.soup.view());
        std::array<Hit<Scalar>, Tie<Scalar>::k_faces> hits;
        const std::size_t count = mesh.all_hits(tie.segment, hits, {.sides = Sides::both});
        for (std::size_t k = 0; k < count; ++k) {
            ASSERT_EQ(hits[k].feature, Feature::vertex);
            ASSERT_EQ(bits(hits[k].exact_fraction), bits(hits[0].exact_fraction)) << i << ", hit " << k;
            ASSERT_LE(hits[k].fraction, hits[k].exact_fraction) << i << ", hit " << k;
        }
        several += count > 1 ? 1 : 0;
    }
    EXPECT_GT(several, 100);
}

TEST(EqualFractions, are_equal_bits_at_ties_in_float) { expect_equal_bits_at_ties<float>(); }
TEST(EqualFractions, are_equal_bits_at_ties_in_double) { expect_equal_bits_at_ties<double>(); }

// On meshes of lattice points, where many faces are met in one point, and in many; against rational numbers.
template <class Scalar>
void expect_right_on_lattices() {
    const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(4, 0.5, 2, 3), 1, Vec3<double>::Zero());
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(6);
    std::array<Hit<Scalar>, 64> hits;
    int equal = 0;
    int later = 0;
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
        Segment<Scalar> segment;
        for (int k = 0; k < 3; ++k) {
            segment.from[k] = static_cast<Scalar>(random.between_ints(-1, 9) + (random.chance(0.2) ? 1.0 / 3 : 0));
            segment.to[k] = static_cast<Scalar>(random.between_ints(-1, 9));
        }
        const std::size_t count = mesh.all_hits(segment, hits, {.sides = Sides::both});
        ASSERT_LE(count, hits.size());
        for (std::size_t k = 0; k < count; ++k) {
            const auto exact_of = [&](const Hit<Scalar>& hit) {
                const IndexTriple& t = soup.triangles[hit.triangle];
                const auto corner = [&](std::size_t c) { return detail::to_point(soup.positions[t[c]]); };
                return RationalOracle(detail::to_path(segment), {corner(0), corner(1), corner(2)}).fraction();
            };
            const auto exact = exact_of(hits[k]);
            worst = std::max(worst, ulps(hits[k].exact_fraction, exact, CGAL::to_double(exact)));
            if (k == 0) continue;
            ASSERT_GE(hits[k].exact_fraction, hits[k - 1].exact_fraction) << to_text(segment) << ", hit " << k;
            const bool same = exact_of(hits[k - 1]) == exact;
            ASSERT_TRUE(!same || bits(hits[k].exact_fraction) == bits(hits[k - 1].exact_fraction))
                << to_text(segment) << ", hit " << k;
            ++(same ? equal : later);
        }
    }
    EXPECT_GT(equal, 1000);
    EXPECT_GT(later, 1000);
    EXPECT_LE(worst, 1);
}

TEST(EqualFractions, are_equal_bits_on_lattices_in_float) { expect_right_on_lattices<float>(); }
TEST(EqualFractions, are_equal_bits_on_lattices_in_double) { expect_right_on_lattices<double>(); }

}  // namespace
}  // namespace pierce::test
