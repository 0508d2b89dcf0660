// CGAL's judgement of a point and a closed mesh, by exact predicates.
#pragma once

#include <optional>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>
#include <pierce/triangle_soup.h>

namespace pierce::test {

template <class Scalar>
class InsideOracle {
  public:
    explicit InsideOracle(const TriangleSoup<Scalar>& soup) {
        std::vector<Mesh::Vertex_index> vertices;
        for (const Vec3<Scalar>& p : soup.positions)
            vertices.push_back(mesh_.add_vertex({double(p[0]), double(p[1]), double(p[2])}));
        for (const IndexTriple& t : soup.triangles)
            EXPECT_NE(mesh_.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]), Mesh::null_face());
        EXPECT_TRUE(CGAL::is_closed(mesh_));
        side_.emplace(mesh_);
    }
    [[nodiscard]] CGAL::Bounded_side side(const Vec3<Scalar>& p) const {
        return (*side_)({double(p[0]), double(p[1]), double(p[2])});
    }
    [[nodiscard]] bool outside(const Vec3<Scalar>& p) const { return side(p) == CGAL::ON_UNBOUNDED_SIDE; }

  private:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    Mesh mesh_;
    std::optional<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side_;
};

}  // namespace pierce::test
