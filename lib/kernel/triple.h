// Vectors of numbers, for formulas that are written once.
#pragma once

namespace pierce::detail {

template <class Number>
struct Triple {
    Number x, y, z;
};

template <class Number>
[[nodiscard]] [[gnu::always_inline]] inline Triple<Number> cross(const Triple<Number>& p, const Triple<Number>& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
template <class Number>
[[nodiscard]] [[gnu::always_inline]] inline Number dot(const Triple<Number>& p, const Triple<Number>& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z;
}
/// The same with all signs made +.
template <class Number>
[[nodiscard]] [[gnu::always_inline]] inline Triple<Number> cross_of_magnitudes(const Triple<Number>& p,
                                                                               const Triple<Number>& q) {
    return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

}  // namespace pierce::detail
