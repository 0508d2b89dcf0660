// Meshes from buffers as they lie in memory give the bits of meshes from vectors. Only spans of Vec3 and IndexTriple
// were taken once: whoever had a vertex buffer had to copy it first.
#include <cstring>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

/// As games have them.
struct Vertex {
    float uv[2];
    float x, y, z;
    std::uint8_t colour[4];
    float normal[3];
};

struct GameBuffers {
    explicit GameBuffers(const TriangleSoup<float>& soup) {
        for (const Vec3<float>& p : soup.positions)
            vertices.push_back({{1, 2}, p[0], p[1], p[2], {9, 9, 9, 9}, {0, 0, 1}});
        for (const IndexTriple& t : soup.triangles)
            for (const std::uint32_t v : t) {
                indices.push_back(v);
                short_indices.push_back(static_cast<std::uint16_t>(v));
            }
    }
    [[nodiscard]] PointsView<float> positions() const { return {&vertices[0].x, vertices.size(), sizeof(Vertex)}; }
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint16_t> short_indices;
};

template <class Scalar>
void expect_same(const CollisionMesh<Scalar>& x, const CollisionMesh<Scalar>& y, const MeshView<Scalar>& view) {
    EXPECT_EQ(x.statistics().bytes, y.statistics().bytes);
    EXPECT_EQ(x.statistics().vertices, y.statistics().vertices);
    EXPECT_EQ(x.mesh_report().to_string(), y.mesh_report().to_string());
    const Extent<Scalar> extent(view);
    Random random(3);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const Segment<Scalar> s = mixed_segment(view, extent, random);
        const auto hit = y.first_hit(s);
        ASSERT_TRUE(same_answer(x.first_hit(s), hit)) << to_text(s);
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(hits, 50);
}

TEST(Buffers, of_a_game_are_taken_as_they_are) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(20), 1, {0, 0, 0});
    const CollisionMesh<float> expected(soup.view());
    const GameBuffers buffers(soup);
    expect_same(CollisionMesh<float>({buffers.positions(), buffers.short_indices}), expected, soup.view());
    expect_same(CollisionMesh<float>({buffers.positions(), buffers.indices}), expected, soup.view());
    expect_same(CollisionMesh<float>({soup.positions, buffers.indices}), expected, soup.view());
    expect_same(CollisionMesh<float>({buffers.positions(), soup.triangles}), expected, soup.view());
    const MeshView<float> view{buffers.positions(), buffers.short_indices};
    expect_same(CollisionMesh<float>(soup.view()), expected, view);
}

TEST(Buffers, keep_the_callers_face_numbers) {
    TriangleSoup<float> soup = moved<float>(polycube(3, 0.5, 2, 3), 1, {0, 0, 0});
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) soup.faces.push_back(i / 2 + 7);
    const GameBuffers buffers(soup);
    expect_same(CollisionMesh<float>({buffers.positions(), buffers.short_indices, soup.faces}),
                CollisionMesh<float>({soup.positions, soup.triangles, soup.faces}), soup.view());
}

// Nothing but the numbers' size lies between them, and no alignment helps.
TEST(Buffers, need_no_alignment) {
    const TriangleSoup<double> soup = bumpy_sphere(8);
    constexpr std::size_t k_point = 3 * sizeof(double) + 1;
    constexpr std::size_t k_triangle = 3 * sizeof(std::uint32_t) + 5;
    std::vector<unsigned char> points(k_point * soup.positions.size() + 1);
    std::vector<unsigned char> triangles(k_triangle * soup.triangles.size() + 3);
    for (std::size_t i = 0; i < soup.positions.size(); ++i)
        std::memcpy(&points[1 + k_point * i], soup.positions[i].data(), 3 * sizeof(double));
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
        std::memcpy(&triangles[3 + k_triangle * i], soup.triangles[i].data(), 3 * sizeof(std::uint32_t));
    const void* first_point = &points[1];
    const void* first_triangle = &triangles[3];
    const MeshView<double> view{
        PointsView<double>(static_cast<const double*>(first_point), soup.positions.size(), k_point),
        TrianglesView(static_cast<const std::uint32_t*>(first_triangle), soup.triangles.size(), k_triangle)};
    expect_same(CollisionMesh<double>(view), CollisionMesh<double>(soup.view()), soup.view());
}

TEST(Buffers, of_floats_make_a_mesh_in_double_and_not_the_other_way_round) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(8), 1, {0, 0, 0});
    TriangleSoup<double> widened{{}, soup.triangles, {}};
    for (const Vec3<float>& p : soup.positions) widened.positions.push_back(p.cast<double>());
    const CollisionMesh<double> expected(widened.view());
    expect_same(CollisionMesh<double>({soup.positions, soup.triangles}), expected, widened.view());
    const GameBuffers buffers(soup);
    const PointsView<double> interleaved(&buffers.vertices[0].x, buffers.vertices.size(), sizeof(Vertex));
    expect_same(CollisionMesh<double>({interleaved, buffers.short_indices}), expected, widened.view());
    static_assert(!std::is_constructible_v<PointsView<float>, const std::vector<Vec3<double>>&>);
    static_assert(!std::is_constructible_v<PointsView<float>, const double*, std::size_t>);
}

TEST(Buffers, of_signed_indices_are_taken_and_negative_ones_are_out_of_range) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(8), 1, {0, 0, 0});
    std::vector<std::int32_t> indices;
    for (const IndexTriple& triangle : soup.triangles)
        for (const std::uint32_t index : triangle) indices.push_back(static_cast<std::int32_t>(index));
    expect_same(CollisionMesh<float>({soup.positions, indices}), CollisionMesh<float>(soup.view()), soup.view());
    const TrianglesView by_pointer(indices.data(), soup.triangles.size());
    expect_same(CollisionMesh<float>({soup.positions, by_pointer}), CollisionMesh<float>(soup.view()), soup.view());
    indices[4] = -1;
    EXPECT_THROW(CollisionMesh<float>({soup.positions, indices}), MeshError);
}

// A part of a buffer that serves several meshes: more vertices than 16 bits can name.
TEST(Buffers, of_16_bit_indices_may_have_more_vertices_than_these_reach) {
    TriangleSoup<float> soup = moved<float>(bumpy_sphere(8), 1, {0, 0, 0});
    soup.positions.resize(70'000, Vec3<float>(100, 100, 100));
    const GameBuffers buffers(soup);
    expect_same(CollisionMesh<float>({soup.positions, buffers.short_indices}), CollisionMesh<float>(soup.view()),
                soup.view());
}

TEST(Buffers, the_columns_of_a_matrix_are_positions) {
    const TriangleSoup<double> soup = bumpy_sphere(8);
    Eigen::MatrixXd state(7, static_cast<Eigen::Index>(soup.positions.size()));
    for (Eigen::Index i = 0; i < state.cols(); ++i)
        state.col(i) << 1, 1, soup.positions[static_cast<std::size_t>(i)], 1, 1;
    expect_same(CollisionMesh<double>({state.middleRows(2, 3), soup.triangles}), CollisionMesh<double>(soup.view()),
                soup.view());
}

TEST(Buffers, that_end_within_a_triangle_are_refused) {
    const std::vector<Vec3<double>> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 1};
    try {
        const CollisionMesh<double> mesh({positions, indices});
        ADD_FAILURE() << "not refused";
    } catch (const MeshError& error) {
        EXPECT_STREQ(error.what(), "the mesh has 5 indices, which is no multiple of three");
    }
    const std::vector<std::uint16_t> wrong = {0, 1, 3};
    EXPECT_THROW(CollisionMesh<double>({positions, wrong}), MeshError);
}

}  // namespace
}  // namespace pierce::test
