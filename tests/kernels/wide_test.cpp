// Several lanes at once give each lane the bits that the scalar form gives: it is one formula, and no operation depends
// on its neighbours.
#include <gtest/gtest.h>

#include <kernel/wide.h>
#include <kernels/all_kernels.h>
#include <support/expect_hit.h>

namespace pierce::test {
namespace {

using detail::side_by_side;
using detail::Wide;

/// Generic and delicate pairs mixed, some not finite: lanes that leave early must not disturb the others.
template <class Scalar>
Pair some_pair(Random& random) {
    const auto family = static_cast<Family>(random.below(static_cast<std::size_t>(Family::count)));
    Pair pair =
        make_pair_of<Scalar>(random.chance(0.5) ? Family::at_edge : family, 1, random.chance(0.5) ? 0 : 30, random);
    if (random.chance(0.01)) pair.path.to[random.below(3)] = std::numeric_limits<double>::quiet_NaN();
    return pair;
}

template <class Scalar, std::size_t Lanes, class Kernel>
void compare(const char* name, const Kernel& kernel) {
    using Number = Wide<Scalar, Lanes>;
    using Narrow = typename Kernel::template Stored<Scalar>;
    using Broad = typename Kernel::template Stored<Number>;
    Random random(3);
    int hits = 0;
    for (int round = 0; round < 20'000; ++round) {
        std::array<Narrow, Lanes> stored;
        std::array<kernels::Triple<Scalar>, Lanes> from;
        std::array<kernels::Triple<Scalar>, Lanes> to;
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            const Pair pair = some_pair<Scalar>(random);
            const auto& c = pair.corners;
            stored[lane] = kernel.prepare(vec<Scalar>(c[0]), vec<Scalar>(c[1]), vec<Scalar>(c[2]));
            from[lane] = kernels::triple(vec<Scalar>(pair.path.from));
            to[lane] = kernels::triple(vec<Scalar>(pair.path.to));
        }
        using Ends = kernels::Triple<Number>;
        using End = kernels::Triple<Scalar>;
        const auto wide =
            kernel.evaluate(side_by_side<Broad, Narrow, Scalar, Lanes>(stored),
                            side_by_side<Ends, End, Scalar, Lanes>(from), side_by_side<Ends, End, Scalar, Lanes>(to));
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            const auto one = kernel.evaluate(stored[lane], from[lane], to[lane]);
            ASSERT_EQ(one.hit, wide.hit[lane]) << name << " lane " << lane << " round " << round;
            if (!one.hit) continue;
            ++hits;
            ASSERT_EQ(bits(one.fraction), bits(wide.fraction[lane])) << name;
            ASSERT_EQ(bits(one.u), bits(wide.u[lane])) << name;
            ASSERT_EQ(bits(one.v), bits(wide.v[lane])) << name;
        }
    }
    EXPECT_GT(hits, 2'000) << name;
}

template <class Scalar, std::size_t Lanes>
void compare_all() {
    for_each_kernel([](const char* name, const auto& kernel) {
        using Kernel = std::remove_cvref_t<decltype(kernel)>;
        // A fan has a branch for each triangle, and no wide form.
        if constexpr (std::is_same_v<Kernel, kernels::TriangleFan>) return;
        else compare<Scalar, Lanes>(name, kernel);
        if constexpr (!std::is_same_v<Kernel, kernels::TriangleFan> && requires { kernel.sides; })
            for (const Sides sides : {Sides::back, Sides::both}) compare<Scalar, Lanes>(name, Kernel{sides});
    });
}

TEST(WideKernels, FourFloatsAreFourTimesOne) { compare_all<float, 4>(); }
TEST(WideKernels, EightFloatsAreEightTimesOne) { compare_all<float, 8>(); }
TEST(WideKernels, FourDoublesAreFourTimesOne) { compare_all<double, 4>(); }

}  // namespace
}  // namespace pierce::test
