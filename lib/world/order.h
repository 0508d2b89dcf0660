// The order of hits in several meshes: by the exact fractions of their own local paths, then mesh, face, triangle.
#pragma once

#include <query/candidate.h>
#include <world/instances.h>

namespace pierce::detail {

/// A hit in a mesh of a world.
struct Found {
    std::uint32_t index;
    const Candidate& candidate;
};

/// -1, 0 or 1. `path`: in the world.
template <class Scalar>
[[nodiscard]] int compare_exactly(const WorldScene<Scalar>& world, const Path& path, const Found& x, const Found& y,
                                  QueryCounters& counters) {
    if (x.candidate.latest < y.candidate.earliest) return -1;
    if (y.candidate.latest < x.candidate.earliest) return 1;
    const Instance<Scalar>& one = world.instances[x.index];
    const Instance<Scalar>& other = world.instances[y.index];
    const Corners first = one.scene->corners(x.candidate.triangle);
    const Corners second = other.scene->corners(y.candidate.triangle);
    Path local;
    if (!set_local_path(one, path, local)) return 0;  // not where a hit was found
    if (x.index == y.index || (one.still() && other.still()))
        return order_of_places(local, first, x.candidate.decision, second, y.candidate.decision, counters);
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
    const std::uint32_t face_x = scene.face_of(x.candidate.triangle);
    const std::uint32_t face_y = scene.face_of(y.candidate.triangle);
    if (face_x != face_y) return face_x < face_y;
    return scene.number_of(x.candidate.triangle) < scene.number_of(y.candidate.triangle);
}

}  // namespace pierce::detail
