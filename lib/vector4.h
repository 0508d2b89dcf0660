// Four numbers in step for the builders: boxes' corners, with a fourth lane that is kept at 0.
#pragma once

#include <cstdint>
#include <cstring>

namespace pierce::detail {

template <class Scalar>
struct Vector4Of;
template <>
struct Vector4Of<float> {
    using type = float __attribute__((vector_size(16)));
};
template <>
struct Vector4Of<double> {
    using type = double __attribute__((vector_size(32)));
};
template <class Scalar>
using Vector4 = typename Vector4Of<Scalar>::type;

template <class V>
[[gnu::always_inline]] inline V least(const V& x, const V& y) {
    return x < y ? x : y;
}
template <class V>
[[gnu::always_inline]] inline V greatest(const V& x, const V& y) {
    return x > y ? x : y;
}

/// The three numbers at `x`.
template <class Scalar>
[[gnu::always_inline]] inline Vector4<Scalar> three(const Scalar* x) {
    return Vector4<Scalar>{x[0], x[1], x[2], 0};
}

/// An axis-parallel box.
template <class Scalar>
struct Box4 {
    Vector4<Scalar> low;
    Vector4<Scalar> high;

    [[nodiscard]] static Box4 none() {
        constexpr auto inf = static_cast<Scalar>(__builtin_inff());
        return {Vector4<Scalar>{inf, inf, inf, 0}, Vector4<Scalar>{-inf, -inf, -inf, 0}};
    }
    void add(const Box4& box) {
        low = least(low, box.low);
        high = greatest(high, box.high);
    }
    void add(const Vector4<Scalar>& point) {
        low = least(low, point);
        high = greatest(high, point);
    }
    /// Half of its surface; that of an empty box is not a number that anything is less than.
    [[nodiscard]] Scalar half_area() const {
        const Vector4<Scalar> d = high - low;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
};

}  // namespace pierce::detail
