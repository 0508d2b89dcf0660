// What Accept and Executor keep. They were references once: `options.accept = [&](...) {...};`, the way everyone fills
// an options struct, left one to a lambda that was gone, and the next query crashed.
#include <array>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/executors.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

const Segment<double> k_down{V(1, 1, 3.5), V(1, 1, -0.5)};

CollisionMesh<double> three_floors() {
    TriangleSoup<double> soup;
    for (int i = 0; i < 3; ++i) add_triangle(soup, V(0, 0, i), V(4, 0, i), V(0, 4, i));
    return CollisionMesh<double>(soup.view());
}

// In a frame of its own, as a function that fills options for its callers has.
[[gnu::noinline]] QueryOptions only_if(const std::vector<int>& opaque, int& asked) {
    QueryOptions options{.sides = Sides::both};
    const int wanted = asked + 1;
    options.accept = [&opaque, &asked, wanted](const Contact& contact) {
        ++asked;
        return opaque[contact.face] == wanted;
    };
    return options;
}

[[gnu::noinline]] Executor backwards(std::vector<std::size_t>& order) {
    const auto run = [&order](std::size_t parts, Task task) {
        while (parts > 0) {
            order.push_back(--parts);
            task(parts);
        }
    };
    return run;
}

// What was on the stack is something else now.
[[gnu::noinline]] int overwrite_stack() {
    std::array<volatile unsigned char, 4096> bytes;
    for (auto& b : bytes) b = 0x5a;
    return bytes[77];
}

TEST(Callables, a_lambda_given_to_options_may_be_gone) {
    const CollisionMesh<double> mesh = three_floors();
    const std::vector<int> opaque = {1, 1, 0};
    int asked = 0;
    const QueryOptions options = only_if(opaque, asked);
    EXPECT_EQ(overwrite_stack(), 0x5a);
    EXPECT_EQ(mesh.first_hit(k_down, options).value().face, 1U);
    EXPECT_GT(asked, 0);
    const QueryOptions copy = options;
    EXPECT_EQ(mesh.first_hit(k_down, copy).value().face, 1U);
}

TEST(Callables, a_lambda_given_to_an_executor_may_be_gone) {
    std::vector<std::size_t> order;
    const Executor executor = backwards(order);
    EXPECT_EQ(overwrite_stack(), 0x5a);
    std::vector<int> runs(3, 0);
    executor(runs.size(), [&](std::size_t part) { ++runs[part]; });
    EXPECT_EQ(runs, std::vector<int>(3, 1));
    EXPECT_EQ(order, (std::vector<std::size_t>{2, 1, 0}));
}

bool none(const Contact&) { return false; }

TEST(Callables, functions_are_taken_and_an_empty_accept_takes_all) {
    const CollisionMesh<double> mesh = three_floors();
    EXPECT_FALSE(mesh.any_hit(k_down, {.accept = none}));
    EXPECT_FALSE(mesh.any_hit(k_down, {.accept = &none}));
    EXPECT_TRUE(mesh.any_hit(k_down, {.accept = {}}));
    EXPECT_FALSE(static_cast<bool>(Accept()));
    EXPECT_TRUE(static_cast<bool>(Accept(none)));
}

struct FourPointers {
    std::array<const void*, 4> pointers;
    bool operator()(const Contact&) const { return pointers[3] == this; }
    void operator()(std::size_t, Task) const {}
};
struct FivePointers {
    std::array<const void*, 5> pointers;
    bool operator()(const Contact&) const { return false; }
    void operator()(std::size_t, Task) const {}
};
struct Owner {
    std::vector<int> refused;
    bool operator()(const Contact& contact) const { return refused[contact.face] == 0; }
    void operator()(std::size_t, Task) const {}
};
struct Counting {
    std::size_t count = 0;
    bool operator()(const Contact&) { return ++count > 1; }
    void operator()(std::size_t parts, Task) { count += parts; }
};

template <class Kept>
constexpr void expect_kept_or_refused() {
    static_assert(std::is_trivially_copyable_v<Kept>);
    static_assert(std::is_constructible_v<Kept, FourPointers>);
    static_assert(std::is_constructible_v<Kept, std::reference_wrapper<FivePointers>>);
    static_assert(std::is_constructible_v<Kept, std::reference_wrapper<const Owner>>);
    static_assert(std::is_constructible_v<Kept, std::reference_wrapper<Counting>>);
}

// It was kept, said that it was there, and was called.
TEST(Callables, a_null_function_pointer_is_none) {
    const CollisionMesh<double> mesh = three_floors();
    bool (*const no_accept)(const Contact&) = nullptr;
    void (*const no_executor)(std::size_t, Task) = nullptr;
    EXPECT_FALSE(Accept(no_accept));
    EXPECT_FALSE(Executor(no_executor));
    EXPECT_EQ(mesh.first_hit(k_down, {.accept = no_accept}).value().face, mesh.first_hit(k_down).value().face);
    const std::vector<Segment<double>> segments(3000, k_down);
    std::vector<std::uint8_t> out(segments.size());
    EXPECT_EQ(mesh.any_hits(segments, out, {}, no_executor), segments.size());
}

// That the others are refused, and why, is for the compiler to say: callables_refused.sh.
TEST(Callables, what_is_large_owns_or_changes_is_kept_by_reference) {
    expect_kept_or_refused<Accept>();
    expect_kept_or_refused<Executor>();
    const CollisionMesh<double> mesh = three_floors();
    const Owner owner{{0, 0, 1}};
    EXPECT_EQ(mesh.first_hit(k_down, {.accept = std::ref(owner)}).value().face, 1U);
    Counting counting;
    EXPECT_TRUE(mesh.first_hit(k_down, {.accept = std::ref(counting)}));
    EXPECT_GT(counting.count, 1U);
}

}  // namespace
}  // namespace pierce::test
