// The library's own answer for one triangle: decided as in exact arithmetic, with values rounded once.
#pragma once

#include <pierce/export.h>
#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// What `CollisionMesh` would say of a mesh of this one triangle, and what the other kernels are judged by. Total: a
/// triangle of area zero and a coordinate that is not finite give no hit. fraction, u and v are within 1 ulp. Takes
/// about a microsecond (it does not filter).
struct Exact {
    Sides sides = Sides::front;  ///< the side that a segment must come from

    /// What is stored: the corners.
    template <class Number>
    using Stored = Vertices<Number>;

    /// The stored form of a triangle.
    template <class Scalar>
    [[nodiscard]] Vertices<Scalar> prepare(const Vec3<Scalar>& a, const PointOf<Scalar>& b,
                                           const PointOf<Scalar>& c) const {
        return {triple<Scalar>(a), triple<Scalar>(b), triple<Scalar>(c)};
    }

    /// Whether and where the segment from -> to hits the triangle.
    [[nodiscard]] PIERCE_EXPORT std::optional<Answer<float>> test(const Vertices<float>& stored,
                                                                  const Vec3<float>& from,
                                                                  const Vec3<float>& to) const noexcept;
    /// Whether and where the segment from -> to hits the triangle.
    [[nodiscard]] PIERCE_EXPORT std::optional<Answer<double>> test(const Vertices<double>& stored,
                                                                   const Vec3<double>& from,
                                                                   const Vec3<double>& to) const noexcept;
};

/// `Exact` with its defaults.
inline constexpr Exact exact{};

}  // namespace pierce::kernels
