// Where points are: each mesh is asked about the point's image.
#include <world/places.h>

#include <query/engine.h>
#include <query/kept.h>
#include <query/touches_at.h>
#include <world/ways.h>

namespace pierce::detail {

namespace {

/// Calls `use(index, scene, image)` for each mesh that counts, has a box near the point and a finite image of it.
template <class Scalar, class Use>
void each_around(const WorldScene<Scalar>& world, const Point& point, std::uint32_t mask, QueryCounters& counters,
                 Use&& use) {
    each_image(world, Path{point, point}, mask, 1, counters,
               [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& local, double limit) {
                   use(index, *instance.scene, local.from);
                   return limit;
               });
}

// By the index alone: generations follow from it.
bool is_lower(const MeshId& x, const MeshId& y) { return x.index < y.index; }
bool is_first(const WorldTouch& x, const WorldTouch& y) {
    return x.mesh != y.mesh ? is_lower(x.mesh, y.mesh) : comes_before(x.touch, y.touch);
}

}  // namespace

template <class Scalar>
int winding_number(const WorldScene<Scalar>& world, const Vec3<Scalar>& point, std::uint32_t mask,
                   QueryCounters& counters) {
    int sum = 0;
    each_around(world, to_point(point), mask, counters,
                [&](std::uint32_t, const Scene<Scalar>& scene, const Point& image) {
                    sum += winding_number(scene, to_vector<Scalar>(image), counters);
                });
    return sum;
}

template <class Scalar>
std::size_t containing(const WorldScene<Scalar>& world, const Vec3<Scalar>& point, std::span<MeshId> out,
                       std::uint32_t mask, QueryCounters& counters) {
    Kept meshes(out, is_lower);
    each_around(world, to_point(point), mask, counters,
                [&](std::uint32_t index, const Scene<Scalar>& scene, const Point& image) {
                    if (winding_number(scene, to_vector<Scalar>(image), counters) != 0) meshes.add(world.id_of(index));
                });
    return meshes.sort();
}

template <class Scalar>
Location locate(const WorldScene<Scalar>& world, const Vec3<Scalar>& point, std::span<WorldTouch> out,
                std::uint32_t mask, QueryCounters& counters) {
    Kept touches(out, is_first);
    int sum = 0;
    each_around(world, to_point(point), mask, counters,
                [&](std::uint32_t index, const Scene<Scalar>& scene, const Point& image) {
                    if (!holds(scene.bounds, image)) return;
                    sum += winding_number(scene, to_vector<Scalar>(image), counters);
                    each_touch(scene, image, counters, [&](const FaceTouch& touch) {
                        touches.add({touch, world.id_of(index)});
                    });
                });
    return located(sum, touches.sort());
}

#define PIERCE_PLACES(Scalar)                                                                                         \
    template int winding_number(const WorldScene<Scalar>&, const Vec3<Scalar>&, std::uint32_t, QueryCounters&);       \
    template std::size_t containing(const WorldScene<Scalar>&, const Vec3<Scalar>&, std::span<MeshId>, std::uint32_t, \
                                    QueryCounters&);                                                                  \
    template Location locate(const WorldScene<Scalar>&, const Vec3<Scalar>&, std::span<WorldTouch>, std::uint32_t,    \
                             QueryCounters&)
PIERCE_PLACES(float);
PIERCE_PLACES(double);
#undef PIERCE_PLACES

}  // namespace pierce::detail
