// The decision contract for one segment and one triangle, in exact arithmetic.
#include <exact/decide.h>

#include <exact/volumes.h>

namespace pierce::detail {

Decision decide(const Path& path, const Corners& corners, Sides sides) {
    return with_volumes(path, corners, [sides](const auto& volumes) {
        Decision decision;
        const int from = volumes.from_side().sign();
        const int to = volumes.to_side().sign();
        const bool front = passes_front(from, to) && sides != Sides::back;
        const bool back = passes_back(from, to, sides) && sides != Sides::front;
        if (!front && !back) return decision;

        // The sides differ, so the line pierces the plane in one point, and the three weights, which add up to
        // from_side - to_side, have the sign of that sum inside and zero on an edge.
        int zeros = 0;
        int last_zero = 0;
        int last_nonzero = 0;
        for (int k = 0; k < 3; ++k) {
            const int weight = volumes.weight(k).sign();
            if (weight == (front ? -1 : 1)) return decision;
            if (weight == 0) {
                ++zeros;
                last_zero = k;
            } else {
                last_nonzero = k;
            }
        }
        decision.hit = true;
        decision.side = front ? Sides::front : Sides::back;
        decision.at_start = from == 0;
        if (zeros == 1) {
            decision.feature = Feature::edge;  // the edge opposite to the corner without weight
            decision.feature_index = static_cast<std::uint8_t>((last_zero + 1) % 3);
        } else if (zeros == 2) {
            decision.feature = Feature::vertex;
            decision.feature_index = static_cast<std::uint8_t>(last_nonzero);
        }
        return decision;
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
