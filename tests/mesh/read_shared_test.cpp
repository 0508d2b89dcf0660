// Meshes that are not part of the project: real ones, which must keep all of their faces, and bad ones. The folder is
// named by the environment variable PIERCE_SHARED.
#include "read_test_support.h"

#include <cstdlib>
#include <map>
#include <set>

namespace pierce {
namespace {

std::filesystem::path shared_meshes() {
    const char* folder = std::getenv("PIERCE_SHARED");
    const std::filesystem::path meshes = folder == nullptr ? "" : std::filesystem::path(folder) / "meshes";
    return std::filesystem::is_directory(meshes) ? meshes : "";
}

TEST(ReadShared, RealMeshesKeepAllFaces) {
    const std::filesystem::path folder = shared_meshes();
    if (folder.empty()) {
        GTEST_SKIP() << "PIERCE_SHARED names no folder with meshes in it: the six real meshes were not read";
    }
    const std::map<std::string, std::pair<std::size_t, std::size_t>> counts = {
        {"dragon.ply", {64909, 126060}},         {"dungeon.obj", {5101, 10133}},
        {"jacksboro_dem.ply", {138632, 275772}}, {"kitchen_merged.ply", {208353, 247265}},
        {"stanford-bunny.obj", {35947, 69451}},  {"teapot_in_stadium.ply", {89676, 155062}}};
    for (const auto& [name, count] : counts) {
        const auto mesh = read_mesh<double>(folder / name);
        EXPECT_EQ(mesh.positions.size(), count.first) << name;
        EXPECT_EQ(mesh.triangles.size(), count.second) << name;
        EXPECT_TRUE(mesh.faces.empty()) << name << " is all triangles";
        test::expect_valid(mesh);
        EXPECT_EQ(read_mesh<float>(folder / name).triangles, mesh.triangles) << name;
    }
}

/// What becomes of a file: as many triangles, or a refusal.
struct Outcome {
    std::size_t triangles = 0;
    std::string refusal = "read";
};

TEST(ReadShared, BadMeshesAreReadWholeOrRefused) {
    const std::filesystem::path folder = shared_meshes() / "bad";
    if (!std::filesystem::is_directory(folder)) {
        GTEST_SKIP() << "PIERCE_SHARED names no folder with meshes/bad in it: the files there were not read";
    }
    const std::map<std::string, Outcome> outcomes = {
        {"denormal_1e-310.obj", {12}},
        {"duplicate_faces.obj", {24}},
        {"duplicate_flipped_faces.obj", {24}},
        {"empty.obj", {0, ": is empty"}},
        {"far_from_origin.obj", {12}},
        {"huge_1e200.obj", {12}},
        {"huge_1e30.obj", {12}},
        {"index_huge.obj", {0, ":9: face 0: vertex index 4294967297 is out of range (8 vertices)"}},
        {"index_negative_bad.obj", {0, ":9: face 0: vertex index -9 is out of range (8 vertices before it)"}},
        {"index_negative_ok.obj", {2}},
        {"index_out_of_range.obj", {0, ":21: face 12: vertex index 9 is out of range (8 vertices)"}},
        {"index_zero.obj", {0, ":21: face 12: vertex index 0 is out of range (vertices are counted from 1)"}},
        {"inf_vertex.obj", {0, ":7: coordinate 'inf' is not finite"}},
        {"nan_unused_vertex.obj", {0, ":9: coordinate 'nan' is not finite"}},
        {"nan_vertex.obj", {0, ":7: coordinate 'nan' is not finite"}},
        {"no_faces.obj", {0, ": holds no face"}},
        {"off_count_absurd.off",
         {0, ":2: 4000000000 vertices and 4000000000 faces do not fit in the 6 bytes that are left"}},
        {"off_count_negative.off", {0, ":2: '-1' is not a number of vertices"}},
        {"off_count_too_big.off", {0, ":2: 8 vertices and 12 faces do not fit in the 12 bytes that are left"}},
        {"off_index_out_of_range.off", {0, ":6: face 0: vertex index 3 is out of range (3 vertices, counted from 0)"}},
        {"ply_face_count_absurd.ply",
         {0, ":8: 95856 rows of element 'face', of at least 13 bytes each, do not fit in the 76128 that are left"}},
        {"ply_ok.ply", {5856}},
        {"ply_trailing.ply", {5856}},
        {"ply_truncated_faces.ply",
         {0, ":8: 5856 rows of element 'face', of at least 13 bytes each, do not fit in the 75125 that are left"}},
        {"ply_truncated_header.ply", {0, ":9: the line ends where a type is expected"}},
        {"ply_truncated_vertices.ply",
         {0, ":4: 2930 rows of element 'vertex', of at least 12 bytes each, do not fit in the 1000 that are left"}},
        {"repeated_index_face.obj", {14}},
        {"single_point.obj", {1}},
        {"stl_binary_starts_solid.stl", {1}},
        {"stl_count_mismatch.stl", {0, ": byte 80: 1000 triangles make a file of 50084 bytes: this one has 234"}},
        {"stl_nan.stl", {0, ": byte 96: a coordinate is not a number (NaN)"}},
        {"text_garbage.obj", {0, ":1: unknown statement 'hello'"}},
        {"tiny_1e-30.obj", {12}},
        {"two_vertex_face.obj", {0, ":21: the face has 2 corners: at least 3 are needed"}},
        {"zero_area.obj", {14}},
    };
    for (const auto& [name, outcome] : outcomes) {
        EXPECT_EQ(test::refusal_of(folder / name), outcome.refusal) << name;
        if (outcome.triangles > 0) {
            const auto mesh = read_mesh<double>(folder / name);
            EXPECT_EQ(mesh.triangles.size(), outcome.triangles) << name;
            test::expect_valid(mesh);
        }
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        EXPECT_TRUE(outcomes.contains(entry.path().filename().string()))
            << entry.path() << " is new, and not in the table";
    }
    EXPECT_EQ(test::refusal_of<float>(folder / "huge_1e200.obj"), ":2: coordinate '1e200' does not fit in float");
    EXPECT_EQ(read_mesh<double>(folder / "denormal_1e-310.obj").positions[1][0], 1e-310);
    EXPECT_EQ(read_mesh<float>(folder / "denormal_1e-310.obj").positions[1][0], 0.0F);
}

}  // namespace
}  // namespace pierce
