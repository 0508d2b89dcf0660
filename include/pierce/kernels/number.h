// The arithmetic that the single-triangle kernels are written in: once, over any type of number. float and double, a
// number that counts its operations (tests), and several numbers in step (lib/kernel/wide.h) all run the same formula.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <pierce/types.h>

namespace pierce::kernels {

// A number has + - * / and the comparisons; what these yield is its mask: bool, or one truth value for each lane. A
// type with lanes brings `none`, `select` and the other functions of this page along, in its own namespace.

/// What a comparison of two numbers gives: bool, or one truth value for each lane.
template <class Number>
using Mask = decltype(std::declval<const Number&>() < std::declval<const Number&>());

/// No lane is true: nothing is left to do. For one lane that is the plain negation, and so the plain early-out.
[[nodiscard]] constexpr bool none(bool mask) { return !mask; }

/// `yes` where the mask is true, else `no`.
template <class Number>
[[nodiscard]] constexpr Number select(bool mask, const Number& yes, const Number& no) {
    return mask ? yes : no;
}

/// Three numbers: a point or a vector.
template <class Number>
using Triple = std::array<Number, 3>;

/// A vector of Eigen's as three numbers.
template <class Scalar>
[[nodiscard]] Triple<Scalar> triple(const Vec3<Scalar>& v) {
    return {v[0], v[1], v[2]};
}

/// The difference of two vectors.
template <class Number>
[[nodiscard]] constexpr Triple<Number> operator-(const Triple<Number>& p, const Triple<Number>& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
/// A vector times a number.
template <class Number>
[[nodiscard]] constexpr Triple<Number> operator*(const Number& s, const Triple<Number>& p) {
    return {s * p[0], s * p[1], s * p[2]};
}
/// The dot product.
template <class Number>
[[nodiscard]] constexpr Number dot(const Triple<Number>& p, const Triple<Number>& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
/// The cross product.
template <class Number>
[[nodiscard]] constexpr Triple<Number> cross(const Triple<Number>& p, const Triple<Number>& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// The place of the largest component, the first of equals; for NaN any.
template <class Scalar>
[[nodiscard]] constexpr std::size_t largest(const Triple<Scalar>& p) {
    const auto size = [&p](std::size_t k) { return p[k] < 0 ? -p[k] : p[k]; };
    const std::size_t xy = size(1) > size(0) ? 1 : 0;
    return size(2) > size(xy) ? 2 : xy;
}

/// An affine function of a point: a row of an affine map, or a plane scaled to measure what is wanted.
template <class Number>
struct Plane {
    Triple<Number> normal;  ///< the gradient
    Number offset;          ///< the value at the origin

    /// The value at p: dot(normal, p) + offset.
    [[nodiscard]] constexpr Number operator()(const Triple<Number>& p) const { return dot(normal, p) + offset; }
};

/// The function `normal . (p - through)`.
template <class Number>
[[nodiscard]] constexpr Plane<Number> plane(const Triple<Number>& normal, const Triple<Number>& through) {
    return {normal, -dot(normal, through)};
}

/// What is stored where nothing is computed beforehand.
template <class Number>
struct Vertices {
    Triple<Number> a;  ///< a corner
    Triple<Number> b;  ///< a corner
    Triple<Number> c;  ///< a corner
};

/// The outcome of a test in the numbers it was made in. The values mean something where `hit` is true.
template <class Number>
struct Tested {
    Mask<Number> hit;   ///< whether there is a hit
    Number fraction{};  ///< of the segment
    Number u{};         ///< weight of b
    Number v{};         ///< weight of c
};

/// Late division (Bloom 2002, addendum): everything has been decided on multiples by d > 0, and only a hit pays for
/// quotients. With 0 <= part <= d each of them is in [0, 1] after rounding too, which a product by 1/d would not be.
template <class Number>
[[nodiscard]] constexpr Tested<Number> divided(const Mask<Number>& hit, const Number& fraction, const Number& u,
                                               const Number& v, const Number& d) {
    return {hit, fraction / d, u / d, v / d};
}

/// The heights of a segment's ends over a plane, turned so that an accepted segment comes from above: from >= 0 >= to,
/// from > to.
template <class Number>
struct Passage {
    Mask<Number> hit;  ///< whether the plane is passed from a side that counts
    Number from;       ///< the start's height, turned
    Number to;         ///< the end's height, turned
};

/// Bloom's rule for the plane: the start on it counts as in front of it, the end has to be behind. For the back the
/// same, mirrored; for both a change of side, where on the plane counts as in front (`Sides`).
template <class Number>
[[nodiscard]] constexpr Passage<Number> passage(const Number& from, const Number& to, Sides sides) {
    const Number zero{};
    const Mask<Number> front = (from >= zero) & (to < zero);
    if (sides == Sides::front) return {front, from, to};
    const bool mirrored = sides == Sides::back;
    const Mask<Number> back = mirrored ? (from <= zero) & (to > zero) : (from < zero) & (to >= zero);
    if (mirrored) return {back, -from, -to};
    const Mask<Number> either = front | back;
    return {either, select(back, -from, from), select(back, -to, to)};
}

/// The same for kernels whose quotients are over a determinant that is positive for a segment from the front: turns it,
/// and what is divided by it, so that it is positive for each side that counts.
template <class Number>
class Turning {
  public:
    /// `determinant`: positive for a segment from the front.
    Turning(const Number& determinant, Sides sides)
        : sides_(sides), positive_(determinant > Number{}), negative_(determinant < Number{}) {}

    /// x, turned as the determinant is.
    [[nodiscard]] Number operator()(const Number& x) const {
        return sides_ == Sides::front ? x : sides_ == Sides::back ? -x : select(negative_, -x, x);
    }

    /// Whether a fraction is that of a passage: 0 <= t < 1, both sides of it turned and times the determinant. For a
    /// passage from the back where both sides count, 0 < t <= 1: its start on the plane is in front already, and its
    /// end on the plane is in front.
    [[nodiscard]] Mask<Number> passes(const Number& t, const Number& determinant) const {
        const Mask<Number> hit = (t >= Number{}) & (t < determinant);
        if (sides_ != Sides::both) return hit;
        return (positive_ & hit) | (negative_ & (t > Number{}) & (t <= determinant));
    }

  private:
    Sides sides_;
    Mask<Number> positive_;
    Mask<Number> negative_;
};

}  // namespace pierce::kernels
