// Which closed triangles a point lies in, and which ones a segment meets.
#include <exact/touch.h>

#include <exact/volumes.h>

namespace pierce::detail {

namespace {

/// Decides for a point of the plane. `normal(axis)`: the sign of that component of the triangle's normal;
/// `edge(k, axis)`: of the normal of the edge opposite to corner k and the point.
template <class Normal, class Edge>
Decision touch_in_plane(Normal&& normal, Edge&& edge) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int front = normal(axis);
        if (front == 0) continue;
        // Seen along that axis the triangle keeps its shape, but for a mirror image. As a path that comes from the
        // front: its weights are positive on the inner sides of the edges.
        return closed_rule(0, -1, Sides::front, [&](int k) { return front * edge(k, axis); });
    }
    return {};
}

template <int N>
int component_of_normal(const Vector<N>& a, const Vector<N>& b, const Vector<N>& c, std::size_t axis) {
    const std::size_t i = (axis + 1) % 3;
    const std::size_t j = (axis + 2) % 3;
    return ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])).sign();
}

}  // namespace

Decision touch(const Point& point, const Corners& corners) {
    const Path path{point, point};
    const Lattice lattice = lattice_of(path, corners);
    const auto narrow = [&]<int N>(std::integral_constant<int, N>) {
        if (!Volumes<N>(path, corners, lattice).from_side().zero()) return Decision{};
        const Vector<N> p = on_lattice<N>(point, lattice);
        Vector<N> c[3];
        for (std::size_t k = 0; k < 3; ++k) c[k] = on_lattice<N>(corners[k], lattice);
        return touch_in_plane(
            [&](std::size_t axis) { return component_of_normal(c[0], c[1], c[2], axis); },
            [&](int k, std::size_t axis) { return component_of_normal(c[(k + 1) % 3], c[(k + 2) % 3], p, axis); });
    };
    const auto wide = [&] {
        if (WideVolumes(path, corners, lattice).from_side().sign() != 0) return Decision{};
        const OddPoint p = odd(point);
        const OddPoint c[3] = {odd(corners[0]), odd(corners[1]), odd(corners[2])};
        const auto component = [&](const OddPoint& x, const OddPoint& y, const OddPoint& z, std::size_t axis) {
            return WideVolumes::wide_normal(x, y, z, axis, lattice).sign();
        };
        return touch_in_plane(
            [&](std::size_t axis) { return component(c[0], c[1], c[2], axis); },
            [&](int k, std::size_t axis) { return component(c[(k + 1) % 3], c[(k + 2) % 3], p, axis); });
    };
    return with_limbs(lattice.bits(), narrow, wide);
}

PathTouch touch(const Path& path, const Corners& corners) {
    return with_volumes(path, corners, [](const auto& volumes) {
        const int from = volumes.from_side().sign();
        const int to = volumes.to_side().sign();
        if (from == to) return PathTouch{};
        // An end on the plane counts as beyond it.
        const bool front = from > to;
        const Decision decision = closed_rule(from, front ? -1 : 1, front ? Sides::front : Sides::back,
                                              [&volumes](int k) { return volumes.weight(k).sign(); });
        return PathTouch{decision, to == 0};
    });
}

}  // namespace pierce::detail
