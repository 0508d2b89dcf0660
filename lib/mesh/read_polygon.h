// Cuts a polygon of a mesh file, of any number of corners, convex or not, flat or not, into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pierce/types.h>

#include "mesh/read_ear_clipper.h"
#include "mesh/read_orient2d.h"

namespace pierce::detail {

/// Cuts one polygon after another, keeping its buffers between them.
template <class Scalar>
class PolygonCutter {
  public:
    explicit PolygonCutter(std::span<const Vec3<Scalar>> positions) : positions_(positions) {}

    /// Takes a polygon of n corners as the n-2 triangles of the fan around its first corner, and leaves n-2 triangles
    /// of the same orientation that cover it without overlap, seen along the axis that it faces most. A fan that does
    /// so is left as it is, in linear time: every strictly convex polygon. Others go to the `EarClipper`. A polygon
    /// that crosses itself, or has no area, is cut in some way, always into n-2 triangles.
    void cut(std::span<IndexTriple> triangles);

  private:
    void collect_corners(std::span<const IndexTriple> fan);
    void project();
    [[nodiscard]] int turn_at_lowest_corner() const;
    [[nodiscard]] bool fan_covers() const;

    std::span<const Vec3<Scalar>> positions_;
    std::vector<std::uint32_t> corners_;
    std::vector<Vec3<double>> points_;
    std::vector<Point2> flat_;
    EarClipper clipper_;
};

extern template class PolygonCutter<float>;
extern template class PolygonCutter<double>;

}  // namespace pierce::detail
