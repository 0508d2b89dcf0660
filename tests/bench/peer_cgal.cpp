// CGAL: an AABB_tree of triangles with exact predicates and inexact constructions, in double. It has no first hit of a
// segment: the nearest of all its intersections is taken.
#include <limits>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include "peers.h"

namespace pierce::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
using Tree = CGAL::AABB_tree<Traits>;

Kernel::Point_3 to_cgal(const Point& p) { return {p[0], p[1], p[2]}; }
Point from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }
Point from_cgal(const Kernel::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

class Cgal : public Peer {
  public:
    Cgal(const TriangleSoup<float>& soup, Backs backs) : cull_backs_(backs == Backs::culled) {
        for (const IndexTriple& t : soup.triangles) {
            const auto corner = [&](std::size_t k) { return to_cgal(soup.positions[t[k]].cast<double>()); };
            triangles_.emplace_back(corner(0), corner(1), corner(2));
        }
        tree_.rebuild(triangles_.begin(), triangles_.end());
        tree_.build();
    }

    [[nodiscard]] Point rounded(const Point& p) const override { return p; }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        if (from == to) return std::nullopt;  // it must not be asked about segments of length zero
        std::vector<Tree::Intersection_and_primitive_id<Kernel::Segment_3>::Type> all;
        tree_.all_intersections(Kernel::Segment_3(to_cgal(from), to_cgal(to)), std::back_inserter(all));
        std::optional<Stop> nearest;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [place, triangle] : all) {
            const Point normal = from_cgal(triangle->supporting_plane().orthogonal_vector()).normalized();
            if (cull_backs_ && normal.dot(to - from) >= 0) continue;
            const auto consider = [&](const Kernel::Point_3& p) {
                const double square = (from_cgal(p) - from).squaredNorm();
                if (square >= least) return;
                least = square;
                nearest = Stop{from_cgal(p), normal};
            };
            if (const auto* point = boost::get<Kernel::Point_3>(&place)) consider(*point);
            if (const auto* shared = boost::get<Kernel::Segment_3>(&place)) {  // it lies in the triangle's plane
                consider(shared->source());
                consider(shared->target());
            }
        }
        return nearest;
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override {
        return tree_.number_of_intersected_primitives(Kernel::Segment_3(to_cgal(from), to_cgal(to)));
    }

  private:
    Triangles triangles_;
    Tree tree_;
    bool cull_backs_;
};

}  // namespace

std::unique_ptr<Peer> make_cgal(const TriangleSoup<float>& soup, Backs backs) {
    return std::make_unique<Cgal>(soup, backs);
}
std::string cgal_version() { return CGAL_STR(CGAL_VERSION); }

}  // namespace pierce::bench
