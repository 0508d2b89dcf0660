// Comparing answers to the last bit.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>
#include <pierce/hit.h>

namespace pierce::test {

inline std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
inline std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

template <class Scalar>
bool same_bits(const Coordinates<Scalar>& x, const Coordinates<Scalar>& y) {
    return bits(x[0]) == bits(y[0]) && bits(x[1]) == bits(y[1]) && bits(x[2]) == bits(y[2]);
}

template <class Scalar>
bool same_bits(const Hit<Scalar>& x, const Hit<Scalar>& y) {
    return bits(x.fraction) == bits(y.fraction) && same_bits(x.point, y.point) && same_bits(x.position, y.position) &&
           same_bits(x.normal, y.normal) && same_bits(x.barycentric, y.barycentric) &&
           bits(x.exact_fraction) == bits(y.exact_fraction) && x.face == y.face && x.triangle == y.triangle &&
           x.side == y.side && x.feature == y.feature && x.feature_index == y.feature_index && x.at_start == y.at_start;
}

template <class Scalar>
std::string to_text(const std::optional<Hit<Scalar>>& hit) {
    std::ostringstream out;
    if (!hit) return "no hit";
    out << std::hexfloat << "face " << hit->face << " triangle " << hit->triangle << " side " << int(hit->side)
        << " feature " << int(hit->feature) << ' ' << int(hit->feature_index) << " start " << hit->at_start
        << " fraction " << hit->fraction << " exact " << hit->exact_fraction << " point " << hit->point[0] << ' '
        << hit->point[1] << ' ' << hit->point[2];
    return out.str();
}

template <class Scalar>
std::string to_text(const Segment<Scalar>& s) {
    std::ostringstream out;
    out << std::hexfloat << s.from[0] << ' ' << s.from[1] << ' ' << s.from[2] << " -> " << s.to[0] << ' ' << s.to[1]
        << ' ' << s.to[2];
    return out.str();
}

template <class Scalar>
::testing::AssertionResult same_answer(const std::optional<Hit<Scalar>>& x, const std::optional<Hit<Scalar>>& y) {
    if (x.has_value() == y.has_value() && (!x || same_bits(*x, *y))) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "\n  " << to_text(x) << "\n  " << to_text(y);
}

}  // namespace pierce::test
