// The order of hits in several meshes: by the exact fractions of their own local paths, then mesh, face, triangle.
#pragma once

#include <query/candidate.h>
#include <world/instances.h>

namespace pierce::detail {

/// A hit in a mesh of a world, or another meeting (query/meets.h).
struct Found {
    template <class Met>
    Found(std::uint32_t in, const Met& met) : index(in), filtered(met), triangle(met.triangle) {}

    std::uint32_t index;
    const Filtered& filtered;
    TriangleRef triangle;
};

/// -1, 0 or 1. `path`: in the world.
template <class Scalar>
[[nodiscard]] int compare_exactly(const WorldScene<Scalar>& world, const Path& path, const Found& x, const Found& y,
                                  QueryCounters& counters) {
    if (x.filtered.latest < y.filtered.earliest) return -1;
    if (y.filtered.latest < x.filtered.earliest) return 1;
    const Instance<Scalar>& one = world.instances[x.index];
    const Instance<Scalar>& other = world.instances[y.index];
    const Corners first = one.scene->corners(x.triangle);
    const Corners second = other.scene->corners(y.triangle);
    Path local;
    if (!set_local_path(one, path, local)) return 0;  // not where a hit was found
    if (x.index == y.index || (one.still() && other.still()))
        return order_of_places(local, first, x.filtered.decision, second, y.filtered.decision, counters);
    Path local_of_other;
    if (!set_local_path(other, path, local_of_other)) return 0;
    ++counters.exact_orders;
    return compare_fractions(local, first, local_of_other, second);
}

template <class Scalar>
[[nodiscard]] bool comes_before(const WorldScene<Scalar>& world, const Path& path, const Found& x, const Found& y,
                                QueryCounters& counters) {
    const int order = compare_exactly(world, path, x, y, counters);
    if (order != 0) return order < 0;
    if (x.index != y.index) return x.index < y.index;
    const Scene<Scalar>& scene = *world.instances[x.index].scene;
    const std::uint32_t face_x = scene.face_of(x.triangle);
    const std::uint32_t face_y = scene.face_of(y.triangle);
    if (face_x != face_y) return face_x < face_y;
    return scene.number_of(x.triangle) < scene.number_of(y.triangle);
}

}  // namespace pierce::detail
