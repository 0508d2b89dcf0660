// Which boxes of the broadphase a segment comes to: for pictures, and to see why a query takes long.
#pragma once

#include <vector>

#include <pierce/collision_mesh.h>
#include <pierce/export.h>
#include <pierce/types.h>

namespace pierce {

/// A box that a query opens: that of a node of the tree, with up to sixteen boxes in it, or that of a cluster of up to
/// eight triangles.
struct VisitedBox {
    Vec3<double> low;   ///< its least coordinates
    Vec3<double> high;  ///< its greatest
    bool is_cluster;    ///< else of a node
    double fraction;    ///< of the segment, where it comes to the box, but for rounding
};

/// The boxes that the segment meets at a fraction of at most `up_to`, in the order in which it comes to them: for what
/// `first_hit` has to open, give it the fraction of the hit. A query opens a few more, as it also looks at what is
/// within rounding of the segment, and at what lies behind a hit that it does not know yet; one that is shorter than
/// clusters are wide opens what meets the box around the segment. With the grid there are clusters only. None, if an
/// end is not finite. For debugging: it takes memory, and looks at all triangles of the clusters.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT std::vector<VisitedBox> visited_boxes(const CollisionMesh<Scalar>& mesh,
                                                                  const Segment<Scalar>& segment, double up_to = 1);

extern template PIERCE_EXPORT std::vector<VisitedBox> visited_boxes(const CollisionMesh<float>&, const Segment<float>&,
                                                                    double);
extern template PIERCE_EXPORT std::vector<VisitedBox> visited_boxes(const CollisionMesh<double>&,
                                                                    const Segment<double>&, double);

}  // namespace pierce
