// The decision contract for one segment and one triangle, in exact arithmetic.
#include <exact/decide.h>

#include <exact/volumes.h>

namespace pierce::detail {

Decision decide(const Path& path, const Corners& corners, Sides sides) {
    return with_volumes(path, corners, [sides](const auto& volumes) {
        return closed_rule(volumes.from_side().sign(), volumes.to_side().sign(), sides,
                           [&volumes](int k) { return volumes.weight(k).sign(); });
    });
}

int side_of(const Corners& corners, const Point& point) {
    return with_volumes({point, point}, corners, [](const auto& volumes) { return volumes.from_side().sign(); });
}

bool has_zero_area(const Corners& corners) {
    Lattice lattice;
    for (const Point& corner : corners) lattice.add(corner);
    const auto narrow = [&]<int N>(std::integral_constant<int, N>) {
        const Vector<N> a = on_lattice<N>(corners[0], lattice);
        const Vector<2 * N> normal =
            cross(on_lattice<N>(corners[1], lattice) - a, on_lattice<N>(corners[2], lattice) - a);
        return normal[0].zero() && normal[1].zero() && normal[2].zero();
    };
    const auto wide = [&] { return WideVolumes({corners[0], corners[0]}, corners, lattice).normal_shift() == 0; };
    return with_limbs(lattice.bits(), narrow, wide);
}

}  // namespace pierce::detail
