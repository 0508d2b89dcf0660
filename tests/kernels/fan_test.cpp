// Barnes' fans: the changes of basis, their range, and answers.
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <kernels/all_kernels.h>
#include <kernels/stair.h>

namespace pierce::test {
namespace {

using kernels::TriangleFan;
using D = Vec3<double>;

TEST(TriangleFan, EachChangeOfBasisTakesItsTriangleToTheUnitTriangle) {
    Random random(1);
    for (int i = 0; i < 2'000; ++i) {
        const FanGeometry fan = stair(2 + random.below(7), random);
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
                // The basis has n at this scale, for units' sake.
                const double height = std::exp2(std::ilogb(size.maxCoeff()));
                EXPECT_NEAR(x[0], p == 1 ? 1 : 0, 1e-9);
                EXPECT_NEAR(x[1], p == 2 ? 1 : 0, 1e-9);
                EXPECT_NEAR(x[2], p == 3 ? height : 0, 1e-9);
            }
        }
    }
}

/// have another answer.
template <class Scalar>
std::pair<double, int> at_scale(int exponent, std::size_t n) {
    Random random(7);
    double worst = 0;
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
        const FanGeometry fan = stair(n, random);
        const auto placed = [exponent](const D& x) -> Vec3<Scalar> {
            return (std::ldexp(1.0, exponent) * x).cast<Scalar>();
        };
        std::vector<Vec3<Scalar>> ring;
        for (const D& p : fan.ring) ring.push_back(placed(p));
        const auto stored = kernels::triangle_fan.prepare<Scalar>(placed(fan.apex), ring);
        const std::size_t k = random.below(n);
        const D w = D(0.2, 0.2, 0.2) + 0.4 * random.weights();
        const D x = w[0] * fan.apex + w[1] * fan.ring[k] + w[2] * fan.ring[k + 1];
        const D normal = (fan.ring[k] - fan.apex).cross(fan.ring[k + 1] - fan.apex).normalized();
        const auto answer = kernels::triangle_fan.test(stored, placed(x + 0.01 * normal), placed(x - 0.01 * normal));
        if (answer && answer->triangle == k)
            worst = std::max({worst, std::abs(double{answer->fraction} - 0.5), std::abs(double{answer->u} - w[1]),
                              std::abs(double{answer->v} - w[2])});
        else ++wrong;
    }
    return {worst, wrong};
}

// Powers of two change nothing: each error is that of 2^0, to the bit, and all answers are right. Edges are 0.5 to 1.1
// long, so the exponents of the documented range are those with one to spare.
template <class Scalar>
void expect_range() {
    constexpr int range = kernels::k_fan_range<Scalar>;
    static_assert(range == (sizeof(Scalar) == 4 ? 40 : 320));  // as has_basis documents it
    for (const std::size_t n : {1U, 4U}) {
        const auto plain = at_scale<Scalar>(0, n);
        std::printf("%zu bytes, n = %zu: largest error %.2g\n", sizeof(Scalar), n, plain.first);
        EXPECT_EQ(plain.second, 0);
        // Of 1 / 0.01 in fractions; a sanity check.
        EXPECT_LT(plain.first, 3e3 * std::numeric_limits<Scalar>::epsilon());
        for (const int exponent : {1 - range, -26, -28, -30, 26, 30, range - 1})
            EXPECT_EQ(at_scale<Scalar>(exponent, n), plain) << exponent;
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
    // Neighbours that share a short edge, one as large and as thin as is allowed, the other as small: the turns'
    // largest numbers, and finite.
    std::vector<V> ring = {{large, 0, 0}, {0, 2 * small * large, 0}, {-1, small, 0}};
    for (int turned = 0; turned < 2; ++turned) {
        const auto stored = kernels::triangle_fan.prepare<Scalar>(V(0, 0, 0), ring);
        const auto& m = stored.turns[0];
        EXPECT_TRUE(std::isfinite(m.a) && std::isfinite(m.b) && std::isfinite(m.c) && std::isfinite(m.d) &&
                    std::isfinite(m.e) && std::isfinite(m.f));
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
        const auto last = kernels::triangle_fan.test(stored, D(ring[n - 1][0] / 2, ring[n - 1][1] / 2, 1),
                                                     D(ring[n - 1][0] / 2, ring[n - 1][1] / 2, -1));
        ASSERT_TRUE(last);
        EXPECT_EQ(last->triangle, n - 2);
    }
}

// A fan that is folded: the first triangle is flat, the others stand up from it in turn.
TEST(TriangleFan, SidesAreWhatTheParameterSaysForEachTriangle) {
    Random random(3);
    for (int i = 0; i < 2'000; ++i) {
        const FanGeometry fan = stair(2 + random.below(4), random);
        const auto n = fan.ring.size() - 1;
        const auto stored = kernels::triangle_fan.prepare<double>(fan.apex, fan.ring);
        const std::size_t k = random.below(n);
        const D x = (fan.apex + fan.ring[k] + fan.ring[k + 1]) / 3;
        // So short that no other is met.
        const D out = 1e-3 * (fan.ring[k] - fan.apex).cross(fan.ring[k + 1] - fan.apex).normalized();
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

}  // namespace
}  // namespace pierce::test
