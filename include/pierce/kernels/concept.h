// What all single-triangle kernels have in common: prepare a triangle once, then test segments against it.
#pragma once

#include <concepts>
#include <optional>
#include <type_traits>

#include <pierce/kernels/number.h>

namespace pierce::kernels {

/// Where a segment meets a triangle a, b, c: `from + fraction (to - from)`, which is also `(1 - u - v) a + u b + v c`.
/// So u is the weight of b and v that of c, in every kernel, whatever the source has. As computed: each is off by the
/// kernel's rounding.
template <class Scalar>
struct Answer {
    Scalar fraction;  ///< in [0, 1]
    Scalar u;         ///< weight of b
    Scalar v;         ///< weight of c
};

/// A kernel is a small value. `prepare(a, b, c)` gives the stored form of the triangle, counter-clockwise seen from its
/// front; `test(stored, from, to)` says whether and where the segment hits it. Both take constant time and no memory
/// (but for fans), throw nothing and may be called from any thread.
///
/// All follow the rule of `Hit` by default, in the scalar's arithmetic as it is: from in front of the plane or on it,
/// to strictly behind, and through the closed triangle. Only `exact` decides that as exact arithmetic would; of the
/// others each says how it errs. Where the source is two-sided, `sides` is a member:
/// `MollerTrumbore{.sides = Sides::both}`.
///
/// What holds for all: a segment with a NaN never hits, nor does one of length zero, nor a triangle with a NaN. An
/// infinite coordinate or an overflow gives some answer. A triangle of area zero never hits `exact`. Of the others,
/// those that compute a normal never hit one whose computed normal is zero, as it is where two corners are the same or
/// the products involved are exact (small integers, lines along an axis); what else has no area but is not computed so
/// is a sliver as wide as rounding, and can be hit.
///
/// A compiler that contracts a * b - c * d into a fused operation (GCC does so by default where the machine has one:
/// -march=native) changes the last bits, and takes away that zero, and what is said of shared edges. Compile with
/// -ffp-contract=off.
template <class Type, class Scalar>
concept Kernel = is_scalar_v<Scalar> && requires(const Type& kernel, const Vec3<Scalar>& p) {
    { *kernel.test(kernel.prepare(p, p, p), p, p) } -> std::convertible_to<Answer<Scalar>>;
    { kernel.test(kernel.prepare(p, p, p), p, p).has_value() } -> std::same_as<bool>;
};

/// A scalar outcome, as `test` returns it.
template <class Scalar>
[[nodiscard]] constexpr std::optional<Answer<Scalar>> answer(const Tested<Scalar>& tested) {
    if (!tested.hit) return std::nullopt;
    return Answer<Scalar>{tested.fraction, tested.u, tested.v};
}

/// A point argument that does not take part in deduction: braces and Eigen expressions will do.
template <class Scalar>
using PointOf = std::type_identity_t<Vec3<Scalar>>;

}  // namespace pierce::kernels
