// The report names what keeps a mesh from keeping its promise, and finds nothing in a mesh that has nothing.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/real_meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

TriangleSoup<double> tetrahedron(const V& a, const V& b, const V& c, const V& d) {
    return {{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
}

template <class Scalar>
MeshReport report(const TriangleSoup<Scalar>& soup) {
    return CollisionMesh<Scalar>(soup.view()).mesh_report();
}

TEST(MeshReport, finds_nothing_in_a_closed_surface) {
    for (const MeshReport& r : {report(bumpy_sphere(8)), report(moved<float>(bowl(8), 1, V(0, 0, 0)))}) {
        EXPECT_TRUE(r.closed());
        EXPECT_EQ(r.components, 1U);
        EXPECT_EQ(r.border_edges + r.non_manifold_edges + r.misoriented_edges + r.non_manifold_vertices +
                      r.t_junctions + r.zero_area + r.duplicates,
                  0U);
        EXPECT_EQ(r.to_string(), "closed: nothing gets through; 1 component\n");
    }
}

TEST(MeshReport, counts_borders_and_components) {
    TriangleSoup<double> soup = terrain(3, 0.1, 1);
    for (const V& p : {V(9, 0, 0), V(9, 1, 0), V(9, 0, 1)}) soup.positions.push_back(p);
    soup.triangles.push_back({16, 17, 18});
    const MeshReport r = report(soup);
    EXPECT_FALSE(r.closed());
    EXPECT_EQ(r.components, 2U);
    EXPECT_EQ(r.border_edges, 15U);
    EXPECT_EQ(r.border_edge_list.size(), MeshReport::k_examples);
    EXPECT_EQ(r.border_edge_list[0], (MeshReport::Edge{0, 1}));
    EXPECT_EQ(r.t_junctions, 0U);
}

TEST(MeshReport, sees_a_seam_of_equal_coordinates_as_closed) {
    EXPECT_TRUE(report(apart(moved<double>(bumpy_sphere(4), 1, V(0.0, -0.0, 0.0)))).closed());
}

TEST(MeshReport, names_a_turned_face_a_third_wing_and_a_double) {
    TriangleSoup<double> soup = bumpy_sphere(2);
    std::swap(soup.triangles[5][0], soup.triangles[5][1]);
    MeshReport r = report(soup);
    EXPECT_FALSE(r.closed());
    EXPECT_EQ(r.misoriented_edges, 3U);
    EXPECT_EQ(r.border_edges, 0U);

    soup = bumpy_sphere(2);
    soup.positions.push_back(V(5, 5, 5));
    soup.triangles.push_back(
        {soup.triangles[0][0], soup.triangles[0][1], static_cast<std::uint32_t>(soup.positions.size() - 1)});
    r = report(soup);
    EXPECT_EQ(r.non_manifold_edges, 1U);
    EXPECT_EQ(r.misoriented_edges, 1U);
    EXPECT_EQ(r.border_edges, 2U);

    soup = bumpy_sphere(2);
    IndexTriple again = soup.triangles[7];
    std::swap(again[0], again[2]);
    soup.triangles.push_back(again);
    r = report(soup);
    EXPECT_EQ(r.duplicates, 1U);
    EXPECT_EQ(r.duplicate_triangles, std::vector<std::uint32_t>{static_cast<std::uint32_t>(soup.triangles.size() - 1)});
    EXPECT_FALSE(r.closed());
}

TEST(MeshReport, counts_the_triangles_of_each_edge) {
    // Walls that meet in a pillar are as they should be, and none of them is a fault to be found: half a sphere's worth
    // of wings around one edge, of each number, far apart from one another.
    TriangleSoup<double> soup;
    for (std::uint32_t wings = 1; wings <= 11; ++wings) {
        const auto low = static_cast<std::uint32_t>(soup.positions.size());
        const double x = 10.0 * wings;
        soup.positions.insert(soup.positions.end(), {V(x, 0, 0), V(x, 0, 1)});
        for (std::uint32_t i = 0; i < wings; ++i) {
            soup.positions.push_back(V(x + std::cos(0.25 * i), std::sin(0.25 * i), 0));
            soup.triangles.push_back(i % 2 == 0 ? IndexTriple{low, low + 1, low + 2 + i}
                                                : IndexTriple{low + 1, low, low + 2 + i});
        }
    }
    const MeshReport r = report(soup);
    EXPECT_EQ(r.edges_with, (std::array<std::size_t, 9>{0, 133, 1, 1, 1, 1, 1, 1, 4}));
    EXPECT_EQ(r.non_manifold_edges, 9U);
    EXPECT_NE(r.to_string().find("  edges by their number of triangles:  1: 133  2: 1  3: 1  4: 1  5: 1  6: 1  7: 1"
                                 "  8 or more: 4\n"),
              std::string::npos)
        << r.to_string();

    // Two boxes that share an edge: closed, as from each side of it as many come as go.
    soup = polycube(2, 1, 1, 1);
    EXPECT_EQ(report(soup).edges_with[2], 3 * soup.triangles.size() / 2);
    soup = tetrahedron(V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(0, 0, 1));
    append(soup, tetrahedron(V(0, 0, 0), V(-1, 0, 0), V(0, -1, 0), V(0, 0, 1)));
    const MeshReport two = report(soup);
    EXPECT_TRUE(two.closed());
    EXPECT_EQ(two.edges_with, (std::array<std::size_t, 9>{0, 0, 10, 0, 1, 0, 0, 0, 0}));
    EXPECT_EQ(two.to_string(),
              "closed: nothing gets through; 1 component\n  1 edges of more than two triangles: 0-3\n"
              "  edges by their number of triangles:  2: 10  4: 1\n");
}

TEST(MeshReport, names_a_vertex_where_fans_touch) {
    // Two tetrahedra that share one vertex, by coordinates.
    TriangleSoup<double> soup;
    for (double s : {1.0, -1.0}) {
        const auto one = tetrahedron(V(0, 0, 0), V(s, 0, 0), V(0, s, 0), V(0, 0, s));
        append(soup, s < 0 ? turned_inside_out(one) : one);
    }
    const MeshReport r = report(soup);
    EXPECT_TRUE(r.closed());
    EXPECT_EQ(r.components, 2U);
    EXPECT_EQ(r.non_manifold_vertices, 1U);
    EXPECT_EQ(r.non_manifold_vertex_list, std::vector<std::uint32_t>{0});
}

TEST(MeshReport, finds_t_junctions_also_where_they_were_rounded) {
    //   d-------c
    //   |  /  \ |      Below, one long edge a-b; above it the vertex m was put on that edge, at a third.
    //   a---m---b
    for (const double scale : {1.0, 1e-30, 1e30})
        for (const V& direction : {V(4, 0, 0), V(1, 2, 3), V(0.1, -0.7, 1e-3)}) {
            const V a = V(7, 1, -2) * scale;
            const V b = a + direction * scale;
            const V up = V(0, 1, 5) * scale;
            const V m = a + (b - a) / 3;
            const TriangleSoup<double> soup{
                {a, b, m, b + up, a + up, a - up}, {{0, 2, 4}, {2, 3, 4}, {2, 1, 3}, {1, 0, 5}}, {}};
            const MeshReport r = report(moved<float>(soup, 1, V(0, 0, 0)));
            EXPECT_EQ(r.t_junctions, 1U) << scale << ' ' << direction.transpose();
            EXPECT_EQ(r.t_junction_list, std::vector<std::uint32_t>{2});
            EXPECT_EQ(r.components, 2U);
            TriangleSoup<double> beside = soup;
            beside.positions[2] += 0.01 * up;
            EXPECT_EQ(report(moved<float>(beside, 1, V(0, 0, 0))).t_junctions, 0U);
        }
}

TEST(MeshReport, counts_a_vertex_with_three_fans_once) {
    // Three tetrahedra that touch in the origin only.
    TriangleSoup<double> soup;
    for (const double turn : {0.0, 2.0, 4.0}) {
        const auto arm = [&](double angle, double z) { return V(std::cos(turn + angle), std::sin(turn + angle), z); };
        append(soup, tetrahedron(V(0, 0, 0), arm(0, 0), arm(1, 0), arm(0.5, 1)));
    }
    const MeshReport r = report(soup);
    EXPECT_EQ(r.components, 3U);
    EXPECT_EQ(r.non_manifold_vertices, 1U);
    EXPECT_EQ(r.non_manifold_vertex_list, std::vector<std::uint32_t>{0});
}

TEST(MeshReport, counts_zero_area_and_leaves_it_out) {
    TriangleSoup<double> soup = bumpy_sphere(2);
    soup.triangles.push_back({0, 0, 1});
    const MeshReport r = report(soup);
    EXPECT_EQ(r.zero_area, 1U);
    EXPECT_TRUE(r.closed());
}

TEST(MeshReport, reads_real_meshes) {
    EXPECT_TRUE(report(real_mesh<double>("elephant")).closed());
    const MeshReport boeing = report(real_mesh<double>("boeing"));
    EXPECT_FALSE(boeing.closed());
    EXPECT_GT(boeing.misoriented_edges, 0U) << boeing.to_string();
    EXPECT_GT(report(real_mesh<double>("blobby_3cc")).components, 2U);
}

TEST(MeshReport, names_no_vertex_that_no_triangle_has) {
    // The first one counted as the corner of the mesh's box, and was named in place of the vertex that lies there.
    const TriangleSoup<double> soup{{V(9, 9, 9), V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)}, {{1, 2, 3}}, {}};
    EXPECT_EQ(report(soup).border_edge_list, (std::vector<MeshReport::Edge>{{1, 2}, {1, 3}, {2, 3}}));
}

TEST(MeshReport, says_what_an_empty_mesh_is) {
    EXPECT_EQ(report(TriangleSoup<double>{}).to_string(), "empty: no triangle that could be hit\n");
    const TriangleSoup<double> flat{{V(0, 0, 0), V(1, 0, 0), V(2, 0, 0)}, {{0, 1, 2}}, {}};
    EXPECT_EQ(report(flat).to_string(), "empty: no triangle that could be hit\n  1 triangles of zero area: 0\n");
}

}  // namespace
}  // namespace pierce::test
