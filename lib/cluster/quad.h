// Four numbers in step, for points and boxes of the build: plain vectors of GCC and Clang, for whatever the processor
// has.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

namespace pierce::detail {

template <class Scalar>
struct QuadOf;
template <>
struct QuadOf<float> {
    typedef float type __attribute__((vector_size(16)));
    typedef std::uint32_t mask __attribute__((vector_size(16)));
    static constexpr mask xyz = {0xffffffffU, 0xffffffffU, 0xffffffffU, 0};
};
template <>
struct QuadOf<double> {
    typedef double type __attribute__((vector_size(32)));
    typedef std::uint64_t mask __attribute__((vector_size(32)));
    static constexpr mask xyz = {~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0}, 0};
};
/// x, y, z and a fourth that nothing depends on.
template <class Scalar>
using Quad = typename QuadOf<Scalar>::type;
typedef std::int32_t IntQuad __attribute__((vector_size(16)));

template <class Scalar>
[[gnu::always_inline]] inline Quad<Scalar> all_of(Scalar x) {
    return Quad<Scalar>{x, x, x, x};
}

/// Three numbers with a fourth place behind them, which is anybody's: it is set to zero, since sums with what may be a
/// subnormal there are slow.
template <class Scalar>
[[gnu::always_inline]] inline Quad<Scalar> load_quad(const Scalar* from) {
    typename QuadOf<Scalar>::mask bits;
    std::memcpy(&bits, from, sizeof bits);
    bits &= QuadOf<Scalar>::xyz;
    Quad<Scalar> quad;
    std::memcpy(&quad, &bits, sizeof quad);
    return quad;
}
template <class Q>
[[gnu::always_inline]] inline Q least(Q a, Q b) {
    return a < b ? a : b;
}
template <class Q>
[[gnu::always_inline]] inline Q most(Q a, Q b) {
    return a > b ? a : b;
}
template <class Scalar>
[[gnu::always_inline]] inline Scalar largest_of(const Quad<Scalar>& q) {
    const Scalar xy = q[0] > q[1] ? q[0] : q[1];
    return xy > q[2] ? xy : q[2];
}

/// x, y and z of four points as three rows of four.
template <class Q>
[[gnu::always_inline]] inline void transpose(const Q (&points)[4], Q* rows) {
    const Q xy01 = __builtin_shufflevector(points[0], points[1], 0, 4, 1, 5);
    const Q xy23 = __builtin_shufflevector(points[2], points[3], 0, 4, 1, 5);
    const Q z01 = __builtin_shufflevector(points[0], points[1], 2, 6, 3, 7);
    const Q z23 = __builtin_shufflevector(points[2], points[3], 2, 6, 3, 7);
    rows[0] = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
    rows[1] = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
    rows[2] = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
}

template <class Scalar>
struct QuadBox {
    static constexpr Scalar k_far = std::numeric_limits<Scalar>::infinity();
    Quad<Scalar> low = {k_far, k_far, k_far, k_far};
    Quad<Scalar> high = {-k_far, -k_far, -k_far, -k_far};

    [[gnu::always_inline]] void add(const QuadBox& box) {
        low = least(low, box.low);
        high = most(high, box.high);
    }
    /// Half of its surface.
    [[nodiscard, gnu::always_inline]] Scalar area() const {
        const Quad<Scalar> d = high - low;
        return d[0] * d[1] + (d[1] * d[2] + d[2] * d[0]);
    }
};

/// Of anything with three low and three high bounds, each with something of four bytes behind it.
template <class Scalar, class Item>
[[gnu::always_inline]] inline QuadBox<Scalar> box_of(const Item& item) {
    return {load_quad<Scalar>(item.low), load_quad<Scalar>(item.high)};
}
template <class Scalar, class Item>
[[gnu::always_inline]] inline void set_box(Item& item, const QuadBox<Scalar>& box) {
    for (int k = 0; k < 3; ++k) {
        item.low[k] = box.low[k];
        item.high[k] = box.high[k];
    }
}

}  // namespace pierce::detail
