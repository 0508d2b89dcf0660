// A triangle that is certainly hit, and the order of two of them.
#pragma once

#include <exact/decide.h>
#include <exact/fraction.h>
#include <kernel/filter.h>
#include <query/scene.h>

namespace pierce::detail {

struct Candidate : Filtered {
    TriangleRef triangle;
    Measured measured;  ///< by the path that hits it
};

/// The order of two triangles that a path meets, whose intervals overlap: as `compare_fractions`. Duplicates and hits
/// in one place, common in what people model, take no exact arithmetic.
[[nodiscard]] inline int order_of_places(const Path& path, const Corners& x, const Decision& one, const Corners& y,
                                         const Decision& two, QueryCounters& counters) {
    if (x == y || same_place(x, one, y, two) || in_one_axis_plane(x, y)) return 0;
    ++counters.exact_orders;
    return compare_fractions(path, x, y);
}

/// The order of the exact fractions of two hits: -1, 0 or 1.
template <class Scalar>
[[nodiscard]] int compare_exactly(const Scene<Scalar>& scene, const Path& path, const Candidate& x, const Candidate& y,
                                  QueryCounters& counters) {
    if (x.latest < y.earliest) return -1;
    if (y.latest < x.earliest) return 1;
    return order_of_places(path, scene.corners(x.triangle), x.decision, scene.corners(y.triangle), y.decision,
                           counters);
}

/// Whether x comes before y: by the exact fraction, then the caller's face number, then the triangle.
template <class Scalar>
[[nodiscard]] bool comes_before(const Scene<Scalar>& scene, const Path& path, const Candidate& x, const Candidate& y,
                                QueryCounters& counters) {
    if (x.latest < y.earliest) return true;
    if (y.latest < x.earliest || x.triangle == y.triangle) return false;
    const int order = compare_exactly(scene, path, x, y, counters);
    if (order != 0) return order < 0;
    const std::uint32_t face_x = scene.face_of(x.triangle);
    const std::uint32_t face_y = scene.face_of(y.triangle);
    return face_x != face_y ? face_x < face_y : scene.number_of(x.triangle) < scene.number_of(y.triangle);
}

}  // namespace pierce::detail
