// A closed mesh with a thin gas in it: the triangles, and where particles leave its walls.
#pragma once

#include <vector>

#include <pierce/triangle_soup.h>
#include <Eigen/Geometry>

#include "mpi_tracking/hash.h"
#include "mpi_tracking/random.h"

namespace tracking {

class Vessel {
  public:
    explicit Vessel(pierce::TriangleSoup<double> soup);

    [[nodiscard]] const pierce::TriangleSoup<double>& soup() const { return soup_; }
    /// Whether there is a volume between walls with an area, as far as doubles can tell.
    [[nodiscard]] bool has_inside() const;
    /// Of the mesh as it is, bit by bit.
    [[nodiscard]] Hash hash() const;
    /// Four times the volume by the surface: the mean way from wall to wall of a gas in equilibrium, whatever the
    /// shape.
    [[nodiscard]] double mean_chord() const;
    /// Lengths are counted in this, some 100,000th of the mesh's size: 10^13 flights fit into 64 bits. A power of two,
    /// so that a division by it is exact.
    [[nodiscard]] double length_unit() const { return length_unit_; }

    /// A place on a wall, and the direction away from it into the vessel.
    struct Place {
        Vec3 point;
        Vec3 normal;  ///< unit
    };
    /// Every place with the same probability. `point` is a hair inside, where the wall opposite is not nearer than
    /// that.
    [[nodiscard]] Place place(const Words& words) const;

  private:
    /// Twice the area, along the triangle's normal.
    [[nodiscard]] Vec3 normal_of(const pierce::IndexTriple& triangle) const;

    pierce::TriangleSoup<double> soup_;
    std::vector<double> areas_;  ///< twice those of all triangles up to this one
    double volume_ = 0;          ///< six times; below 0 where the faces look inwards
    double hair_ = 0;
    double length_unit_ = 0;
};

}  // namespace tracking
