// Without exceptions: the same mesh, or a status and the text that the exception has.
#include <fstream>

#include <gtest/gtest.h>
#include <pierce/pierce.h>
#include <support/executors.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

std::string thrown_by(const MeshView<double>& view, const BuildOptions& options = {}) {
    try {
        const CollisionMesh<double> mesh(view, options);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "nothing";
}

const TriangleSoup<double> k_triangle{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}, {}};

TEST(Result, is_the_mesh) {
    static_assert(noexcept(CollisionMesh<double>::try_make(std::declval<const MeshView<double>&>())));
    const auto made = CollisionMesh<double>::try_make(k_triangle.view(), {.executor = Reversed()});
    ASSERT_TRUE(static_cast<bool>(made));
    EXPECT_EQ(made.status, Status::ok);
    EXPECT_EQ(made.message, "");
    EXPECT_TRUE(made.value.any_hit({{1, 1, 1}, {1, 1, -1}}));
}

TEST(Result, says_what_the_exception_says) {
    TriangleSoup<double> soup = k_triangle;
    soup.triangles[0][1] = 9;
    const auto regions = Regions<double>::try_make(CollisionMesh<double>(k_triangle.view()), {});
    EXPECT_EQ(regions.status, Status::bad_argument);
    EXPECT_EQ(regions.message, "labels: face 0 has none (there are 0)");
    EXPECT_FALSE(regions.value.has_value());
    const auto wrong_index = CollisionMesh<double>::try_make(soup.view());
    EXPECT_FALSE(static_cast<bool>(wrong_index));
    EXPECT_EQ(wrong_index.status, Status::bad_mesh);
    EXPECT_EQ(wrong_index.message, thrown_by(soup.view()));
    EXPECT_FALSE(wrong_index.value.any_hit({{1, 1, 1}, {1, 1, -1}}));
    const auto wrong_backend = CollisionMesh<double>::try_make(k_triangle.view(), {.backend = "abacus"});
    EXPECT_EQ(wrong_backend.status, Status::bad_argument);
    EXPECT_EQ(wrong_backend.message, thrown_by(k_triangle.view(), {.backend = "abacus"}));
    const auto wrong_size = CollisionMesh<double>::try_make(k_triangle.view(), {.cell_size = -1});
    EXPECT_EQ(wrong_size.status, Status::bad_argument);
    EXPECT_NE(wrong_size.message.find("cell_size"), std::string::npos);
}

TEST(Result, says_what_the_callers_executor_throws) {
    const auto throws = [](std::size_t, Task) { throw std::runtime_error("no threads left"); };
    TriangleSoup<double> soup = terrain(60, 0.1, 1);
    const auto made = CollisionMesh<double>::try_make(soup.view(), {.executor = throws});
    EXPECT_EQ(made.status, Status::failed);
    EXPECT_EQ(made.message, "no threads left");
    EXPECT_EQ(made.value.statistics().triangles, 0U);
    const auto throws_a_number = [](std::size_t, Task) { throw 7; };
    EXPECT_EQ(CollisionMesh<double>::try_make(soup.view(), {.executor = throws_a_number}).status, Status::failed);
}

TEST(Result, of_a_file_is_its_mesh_or_why_there_is_none) {
    const auto none = try_read_mesh<float>("no_such_file.obj");
    EXPECT_EQ(none.status, Status::bad_file);
    EXPECT_NE(none.message.find("no_such_file.obj"), std::string::npos) << none.message;
    EXPECT_TRUE(none.value.triangles.empty());
    const std::string path = ::testing::TempDir() + "result_test.obj";
    std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const auto read = try_read_mesh<float>(path);
    EXPECT_TRUE(static_cast<bool>(read)) << read.message;
    EXPECT_EQ(read.value.triangles.size(), 1U);
    std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
    const auto wrong = try_read_mesh<float>(path);
    EXPECT_EQ(wrong.status, Status::bad_file);
    try {
        std::ignore = read_mesh<float>(path);
        ADD_FAILURE() << "not refused";
    } catch (const MeshError& error) {
        EXPECT_EQ(wrong.message, error.what());
    }
    std::remove(path.c_str());
}

TEST(Result, each_status_has_its_number_and_words) {
    EXPECT_EQ(to_string(Status::ok), "ok");
    const std::array<Status, 6> all = {Status::ok,           Status::bad_mesh,      Status::bad_file,
                                       Status::bad_argument, Status::out_of_memory, Status::failed};
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(all[i]), i);
        EXPECT_FALSE(to_string(all[i]).empty());
    }
}

}  // namespace
}  // namespace pierce::test
