// CGAL: an AABB_tree of triangles with exact predicates and inexact constructions, in double.
#include "cgal_tree.h"
#include "peers.h"

namespace pierce::bench {
namespace {

using Kernel = CgalTree::Kernel;

Kernel::Segment_3 to_cgal(const Point& from, const Point& to) { return {CgalTree::point(from), CgalTree::point(to)}; }
Point from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

Point normal_of(const Kernel::Triangle_3& triangle) {
    const Kernel::Vector_3 v = triangle.supporting_plane().orthogonal_vector();
    return Point(v.x(), v.y(), v.z()).normalized();
}

class Cgal : public Peer {
  public:
    Cgal(const TriangleSoup<float>& soup, Backs backs) : tree_(soup.view()), cull_backs_(backs == Backs::culled) {}

    [[nodiscard]] Point rounded(const Point& p) const override { return p; }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        if (from == to) return std::nullopt;  // it must not be asked about segments of length zero
        const auto nearest = tree_.nearest(to_cgal(from, to), [&](const Kernel::Triangle_3& triangle) {
            return !cull_backs_ || normal_of(triangle).dot(to - from) < 0;
        });
        if (!nearest) return std::nullopt;
        return Stop{from_cgal(nearest->point), normal_of(*nearest->triangle)};
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override {
        return tree_.get().number_of_intersected_primitives(to_cgal(from, to));
    }

  private:
    CgalTree tree_;
    bool cull_backs_;
};

}  // namespace

std::unique_ptr<Peer> make_cgal(const TriangleSoup<float>& soup, Backs backs) {
    return std::make_unique<Cgal>(soup, backs);
}
std::string cgal_version() { return CGAL_STR(CGAL_VERSION); }

}  // namespace pierce::bench
