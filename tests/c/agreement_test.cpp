// Every function of the C interface says what the C++ one says, in float and in double, to the last bit. (The programs
// story*.c are what a C compiler makes of it.)
#include <algorithm>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <pierce/pierce_c.h>

#include "cubes.h"

namespace pierce {
namespace {

constexpr std::size_t k_segments = 400;

/// Ends on a lattice of halves: many lie on faces, edges and corners of the cubes.
template <class Scalar>
std::vector<Segment<Scalar>> random_segments(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> half(-2, 10);
    const auto point = [&] {
        const auto next = [&] { return static_cast<Scalar>(half(random)) / 2; };
        const Scalar x = next(), y = next();
        return Vec3<Scalar>(x, y, next());
    };
    std::vector<Segment<Scalar>> segments;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3<Scalar> from = point();
        segments.push_back({from, point()});
    }
    return segments;
}

struct Buffers {
    vertex vertices[CUBE_CORNERS];
    std::uint16_t indices[3 * CUBE_FACES];
    Buffers() { fill_cubes(vertices, indices); }
};

template <class Scalar>
struct Cubes {
    const Buffers buffers;
    const CollisionMesh<Scalar> mesh{
        {{buffers.vertices[0].position, CUBE_CORNERS, sizeof(vertex)}, TrianglesView(buffers.indices, CUBE_FACES)}};
};

/// The same cubes in C, where floats are all that the buffers hold.
void fill(pierce_points_f& points, const float* first) { points.first = first; }
void fill(pierce_points_d& points, const float* first) { points.floats = first; }
template <class Mesh, class Points>
Mesh* make(pierce_status (*create)(const Points*, const pierce_triangles*, const pierce_build_options*, Mesh**),
           Points points) {
    const Buffers buffers;
    fill(points, buffers.vertices[0].position);
    points.count = CUBE_CORNERS;
    points.stride = sizeof(vertex);
    pierce_triangles triangles{};
    triangles.shorts = buffers.indices;
    triangles.count = CUBE_FACES;
    Mesh* mesh = nullptr;
    EXPECT_EQ(PIERCE_OK, create(&points, &triangles, nullptr, &mesh)) << pierce_last_message();
    return mesh;
}

template <class Object, void (*destroy)(Object*)>
class Handle {
  public:
    explicit Handle(Object* object) : object_(object) {}
    ~Handle() { destroy(object_); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator const Object*() const { return object_; }

  private:
    Object* object_;
};

template <class One, class Other>
bool same_memory(const One& one, const Other& other) {
    static_assert(sizeof(One) == sizeof(Other));
    return std::memcmp(&one, &other, sizeof one) == 0;
}

template <class One, class Other>
bool same_arrays(const std::vector<One>& one, const std::vector<Other>& other) {
    static_assert(sizeof(One) == sizeof(Other));
    return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof(One)) == 0;
}

template <class Scalar>
Vec3<Scalar> vec(const Scalar (&numbers)[3]) {
    return {numbers[0], numbers[1], numbers[2]};
}

#define SCALAR float
#define SUITE AgreementInFloat
#define C(name) pierce_##name##_f
#include "agreement.h"
#undef SCALAR
#undef SUITE
#undef C

#define SCALAR double
#define SUITE AgreementInDouble
#define C(name) pierce_##name##_d
#include "agreement.h"

// What is thrown below a function of C ends there, as a status and a message of this thread alone.
TEST(CErrors, NoExceptionComesOut) {
    const Handle<pierce_mesh_d, pierce_mesh_destroy_d> mesh(make(pierce_mesh_create_d, pierce_points_d{}));
    const pierce_executor throwing{
        [](size_t, pierce_task, void*, void*) { throw std::runtime_error("there are no threads"); }, nullptr};
    std::vector<double> points(3 * 5000);
    std::vector<std::uint8_t> answers(5000);
    pierce_points_d view{};
    view.first = points.data();
    view.count = answers.size();
    EXPECT_EQ(PIERCE_FAILED, pierce_contains_points_d(mesh, &view, answers.data(), nullptr, nullptr, &throwing));
    EXPECT_STREQ("there are no threads", pierce_last_message());
    std::string of_another = "none";
    std::thread([&] { of_another = pierce_last_message(); }).join();
    EXPECT_EQ("", of_another);
    // A success leaves it as it is.
    EXPECT_EQ(PIERCE_OK, pierce_contains_points_d(mesh, &view, answers.data(), nullptr, nullptr, nullptr));
    EXPECT_STREQ("there are no threads", pierce_last_message());
}

}  // namespace
}  // namespace pierce
