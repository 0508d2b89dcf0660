// Each kernel against the exact one, on generic pairs: they differ only where the pair lies within the kernel's error
// of a boundary of the decision, and values are right within the same error.
//
// The error. u is the unit of rounding (2^-24, 2^-53). A height over the plane is a sum of products of coordinates, at
// most S in size, with a unit normal. The normal is a cross product of edges: each component is off by a few u times
// the product of the two longest edges, that is by u A of its length, where A is the longest edge over the smallest
// altitude. So a height is off by at most K u S A. Where the line meets the plane it is off by that times G, one over
// the cosine between segment and normal, along the segment. A weight changes by 1 over the altitude h for each unit of
// length in the plane; its own coefficients are off by K u A of their size. So a weight is off by at most
// K u S A G / h, and a fraction by K u S A G / length. S is the distance between the points where differences of
// coordinates come first, and that from the origin for kernels whose planes are evaluated there. K counts the roundings
// in the longest chain: at most 4 for an edge and a cross product, 4 for the scale, 3 for the offset, 4 for a value, 4
// for the combination of two ends: about 20, were all of one sign and size. They are not; the test is run with 8, and
// the largest that is seen is below half of that. `triangle_fan` multiplies by the normal once more: on other pairs
// (good triangles of size 1 far from the origin) up to 1.43 of this band has been seen from it. Its own, for fans of
// several triangles too, is in fan_agreement_test.cpp.
#include <cstdio>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include <kernels/all_kernels.h>

namespace pierce::test {
namespace {

constexpr long double k_roundings = 8;

/// Whether everything is computed from differences of coordinates.
template <class Kernel>
constexpr bool k_is_local = std::is_same_v<typename Kernel::template Stored<float>, kernels::Vertices<float>>;

struct Tally {
    std::int64_t pairs = 0;
    std::int64_t hits = 0;
    std::int64_t different = 0;
    long double largest = 0;  // the largest error of a decision or a value, of the band it is allowed
};

template <class Kernel, class Scalar>
void judge(const char* name, const Kernel& kernel, const std::array<Vec3<Scalar>, 3>& t, const Vec3<Scalar>& from,
           const Vec3<Scalar>& to, const std::optional<kernels::Answer<Scalar>>& truth, const Margins& m,
           Tally& tally) {
    const auto answer = tested(kernel, t, from, to);
    const long double u = std::numeric_limits<Scalar>::epsilon() / 2;
    const long double height_band = k_roundings * u * (k_is_local<Kernel> ? m.local : m.far) * m.aspect;
    const long double shift = height_band * m.grazing;
    ++tally.pairs;
    tally.hits += truth ? 1 : 0;
    long double used = 0;
    if (answer && truth) {
        used = std::max({std::abs(answer->fraction - m.fraction) * m.length / shift,
                         std::abs(answer->u - m.weight[1]) * m.altitude / shift,
                         std::abs(answer->v - m.weight[2]) * m.altitude / shift});
        EXPECT_TRUE(answer->fraction >= 0 && answer->fraction <= 1) << name;
    } else if (answer || truth) {
        ++tally.different;
        // How far inside the pair is by each condition, in bands; outside is negative. A hit is lost where one of them
        // is small; a miss becomes a hit where all those that fail do so by little.
        const std::array<long double, 5> inside = {m.height_from / height_band, -m.height_to / height_band,
                                                   m.weight[0] * m.altitude / shift, m.weight[1] * m.altitude / shift,
                                                   m.weight[2] * m.altitude / shift};
        const long double least = *std::min_element(inside.begin(), inside.end());
        used = truth ? least : -least;
    }
    tally.largest = std::max(tally.largest, used);
    EXPECT_LE(used, 1) << name << (truth ? ": hit" : ": miss") << " taken for the other, or values off; "
                       << describe({{detail::to_point(from), detail::to_point(to)},
                                    {detail::to_point(t[0]), detail::to_point(t[1]), detail::to_point(t[2])}});
}

/// Triangles of all shapes in the unit cube; seven in ten segments aimed from the front at a point of the triangle, or
/// of its edge bc; the others anywhere.
template <class Scalar>
void pairs_at(double scale, double offset, bool at_edges, int count, std::map<std::string, Tally>& tallies,
              std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        std::array<Vec3<double>, 3> p = {random.in_cube(), random.in_cube(), random.in_cube()};
        Vec3<double> from = random.in_cube();
        Vec3<double> to = random.in_cube();
        if (random.chance(0.7)) {
            Vec3<double> w = random.weights();
            if (at_edges) w = Vec3<double>(0, w[1], 1 - w[1]);
            const Vec3<double> target = w[0] * p[0] + w[1] * p[1] + w[2] * p[2];
            to = target + random.between(0, 1) * (target - from);
            if ((p[1] - p[0]).cross(p[2] - p[0]).dot(from - p[0]) < 0) std::swap(p[1], p[2]);
        }
        const Vec3<double> shift = offset * random.direction();
        const auto placed = [&](const Vec3<double>& x) -> Vec3<Scalar> {
            return (scale * (x + shift)).template cast<Scalar>();
        };
        const std::array<Vec3<Scalar>, 3> t = {placed(p[0]), placed(p[1]), placed(p[2])};
        const Vec3<Scalar> a = placed(from);
        const Vec3<Scalar> b = placed(to);
        const auto truth = tested(kernels::exact, t, a, b);
        const Margins margins(t, a, b);
        for_each_kernel(
            [&](const char* name, const auto& kernel) { judge(name, kernel, t, a, b, truth, margins, tallies[name]); });
    }
}

template <class Scalar>
void run() {
    const char* type = sizeof(Scalar) == 4 ? "float" : "double";
    struct Placement {
        const char* name;
        double scale;
        double offset;
        bool at_edges = false;
    };
    std::uint64_t seed = 0;
    for (const Placement& place : {Placement{"origin", 1, 0},
                                   {"offset", 1, 100},
                                   {"large", 0x1p20, 0},
                                   {"small", 0x1p-20, 0},
                                   {"edges", 1, 100, true}}) {
        std::map<std::string, Tally> tallies;
        pairs_at<Scalar>(place.scale, place.offset, place.at_edges, 260'000, tallies, ++seed);
        for (const auto& [name, tally] : tallies) {
            std::printf("%-6s %-7s %-17s %lld pairs, %lld hits, %lld different, largest error %.3Lf of the band\n",
                        type, place.name, name.c_str(), static_cast<long long>(tally.pairs),
                        static_cast<long long>(tally.hits), static_cast<long long>(tally.different), tally.largest);
            EXPECT_GT(tally.hits, tally.pairs / (place.at_edges ? 4 : 2));
            EXPECT_TRUE(!place.at_edges || tally.different > 0);
            EXPECT_GT(tally.largest, 1e-4L) << "the band is so wide that nothing could fail";
        }
    }
}

TEST(KernelAgreement, InFloatOutsideOfTheBand) { run<float>(); }
TEST(KernelAgreement, InDoubleOutsideOfTheBand) { run<double>(); }

}  // namespace
}  // namespace pierce::test
