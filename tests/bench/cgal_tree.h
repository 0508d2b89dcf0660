// CGAL's AABB_tree over the triangles of a mesh, in double with exact predicates, and the nearest hit of a segment.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <pierce/triangle_soup.h>

namespace pierce::bench {

/// Triangles of area zero are left out: CGAL must not be asked about them.
class CgalTree {
  public:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Tree =
        CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

    struct Nearest {
        Kernel::Point_3 point;
        Triangles::const_iterator triangle;
    };

    explicit CgalTree(const MeshView<float>& mesh) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const IndexTriple t = mesh.triangles[i];
            const auto corner = [&](std::size_t k) { return point(mesh.positions[t[k]].cast<double>()); };
            triangles_.emplace_back(corner(0), corner(1), corner(2));
            if (triangles_.back().is_degenerate()) triangles_.pop_back();
        }
        tree_.rebuild(triangles_.begin(), triangles_.end());
        tree_.build();
    }

    [[nodiscard]] const Tree& get() const { return tree_; }

    static Kernel::Point_3 point(const Vec3<double>& p) { return {p[0], p[1], p[2]}; }

    /// It has no first hit of a segment: the nearest of all intersections that `counts(triangle)`.
    template <class Counts>
    [[nodiscard]] std::optional<Nearest> nearest(const Kernel::Segment_3& segment, Counts&& counts) const {
        std::vector<Tree::Intersection_and_primitive_id<Kernel::Segment_3>::Type> all;
        tree_.all_intersections(segment, std::back_inserter(all));
        std::optional<Nearest> nearest;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [place, triangle] : all) {
            if (!counts(*triangle)) continue;
            const auto consider = [&, triangle = triangle](const Kernel::Point_3& p) {
                const double square = (p - segment.source()).squared_length();
                if (square >= least) return;
                least = square;
                nearest = Nearest{p, triangle};
            };
            if (const auto* single = boost::get<Kernel::Point_3>(&place)) consider(*single);
            if (const auto* shared = boost::get<Kernel::Segment_3>(&place)) {  // it lies in the triangle's plane
                consider(shared->source());
                consider(shared->target());
            }
        }
        return nearest;
    }

  private:
    Triangles triangles_;
    Tree tree_;
};

}  // namespace pierce::bench
