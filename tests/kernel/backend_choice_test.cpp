// Which wide kernels work is for the caller to say, then for the environment; a name that the machine has no kernels
// for is refused.
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <kernel/backends.h>
#include <pierce/collision_mesh.h>
#include <support/environment_variable.h>

namespace pierce::test {
namespace {

using namespace detail;

struct Environment : EnvironmentVariable {
    explicit Environment(const char* value) : EnvironmentVariable("PIERCE_BACKEND", value) {}
};

std::string chosen(std::string_view name) {
    return std::string(CollisionMesh<float>(MeshView<float>{}, {.backend = name}).statistics().backend);
}

TEST(BackendChoice, is_the_callers_then_the_environments_then_the_fastest) {
    ASSERT_STREQ(backends().back()->name, "plain");
    {
        const Environment none(nullptr);
        EXPECT_EQ(chosen(""), backends().front()->name);
        EXPECT_EQ(chosen("plain"), "plain");
    }
    for (const Backend* backend : backends()) {
        const Environment environment(backend->name);
        EXPECT_EQ(chosen(""), backend->name);
        EXPECT_EQ(chosen(backends().front()->name), backends().front()->name);
    }
    const Environment empty("");
    EXPECT_EQ(chosen(""), backends().front()->name);
}

void expect_refused(std::string_view name, const std::string& wrong) {
    try {
        chosen(name);
        ADD_FAILURE() << wrong << " is not refused";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("'" + wrong + "'"), std::string::npos) << error.what();
        for (const Backend* backend : backends())
            EXPECT_NE(std::string(error.what()).find(backend->name), std::string::npos) << error.what();
    }
}

TEST(BackendChoice, refuses_names_that_the_machine_does_not_have) {
    {
        const Environment environment("avx1024");
        expect_refused("", "avx1024");
        EXPECT_EQ(chosen("plain"), "plain");
    }
    for (const char* wrong : {"sse", "AVX2", "plain ", "mmx"}) expect_refused(wrong, wrong);
}

}  // namespace
}  // namespace pierce::test
