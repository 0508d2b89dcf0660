// Distances of a point and of a segment from a triangle, compared with a radius, in integers.
//
// All of it is relative to the path's start. With coordinates and the radius below 2^b on the lattice, b <= 64 N - 4,
// differences are below 2^(b+1), cross products 2^(2b+3), their squares 2^(4b+8), times the radius's 2^(6b+8), a volume
// 2^(3b+6), its square 2^(6b+12): all fit N, 2N, 4N, 6N, 3N and 6N limbs with their sign bit.
#include <exact/sphere.h>

#include <exact/lattice.h>
#include <pierce/sides.h>

namespace pierce::detail {

namespace {

template <int N>
Vector<N> shifted(const Vector<N>& x, int shift) {
    return {x[0] << shift, x[1] << shift, x[2] << shift};
}

template <int N>
struct Triangle {
    Vector<N> corner[3];
    [[nodiscard]] Vector<N> edge(std::size_t k) const { return corner[(k + 1) % 3] - corner[k]; }
    [[nodiscard]] Vector<2 * N> normal() const { return cross(edge(0), corner[2] - corner[0]); }
};

struct Part {
    Feature feature;
    std::size_t index;
};

/// What of the triangle is nearest to x: Ericson 2005, "Real-Time Collision Detection", 5.1.5. Exact signs, so the
/// regions leave nothing out; on the border of two it is the part of the lower dimension.
template <int N>
Part nearest_part(const Vector<N>& x, const Triangle<N>& triangle) {
    const auto& [a, b, c] = triangle.corner;
    const Vector<N> ab = b - a;
    const Vector<N> ac = c - a;
    const auto along_ab = [&](const Vector<N>& from) { return dot(ab, x - from); };
    const auto along_ac = [&](const Vector<N>& from) { return dot(ac, x - from); };
    const auto at_most = [](const auto& p, const auto& q) { return compare(p, q) <= 0; };
    const Integer<2 * N> zero;
    const Integer<2 * N> a_b = along_ab(a);
    const Integer<2 * N> a_c = along_ac(a);
    if (at_most(a_b, zero) && at_most(a_c, zero)) return {Feature::vertex, 0};
    const Integer<2 * N> b_b = along_ab(b);
    const Integer<2 * N> b_c = along_ac(b);
    if (at_most(zero, b_b) && at_most(b_c, b_b)) return {Feature::vertex, 1};
    const Integer<2 * N> c_b = along_ab(c);
    const Integer<2 * N> c_c = along_ac(c);
    if (at_most(zero, c_c) && at_most(c_b, c_c)) return {Feature::vertex, 2};
    const auto beyond = [](const auto& p, const auto& q, const auto& r, const auto& s) {
        return compare(p * q, r * s) <= 0;
    };
    if (beyond(a_b, b_c, b_b, a_c) && at_most(zero, a_b) && at_most(b_b, zero)) return {Feature::edge, 0};
    if (beyond(c_b, a_c, a_b, c_c) && at_most(zero, a_c) && at_most(c_c, zero)) return {Feature::edge, 2};
    if (beyond(b_b, c_c, c_b, b_c) && at_most(b_b, b_c) && at_most(c_c, c_b)) return {Feature::edge, 1};
    return {Feature::face, 0};
}

/// The sign of the distance of x from that part, less the radius.
template <int N>
int compare_distance(const Vector<N>& x, const Part& part, const Triangle<N>& triangle, const Integer<2 * N>& square) {
    const Vector<N> w = x - triangle.corner[part.index];
    if (part.feature == Feature::vertex) return compare(dot(w, w), square);
    if (part.feature == Feature::edge) {
        const Vector<N> u = triangle.edge(part.index);
        const Vector<2 * N> area = cross(w, u);
        return compare(dot(area, area), square * dot(u, u));
    }
    const Vector<2 * N> n = triangle.normal();
    const Integer<3 * N> volume = dot(w, n);
    return compare(volume * volume, square * dot(n, n));
}

/// The sign of (x - the nearest point) . way.
template <int N>
int approach_of(const Vector<N>& x, const Part& part, const Triangle<N>& triangle, const Vector<N>& way) {
    const Vector<N> w = x - triangle.corner[part.index];
    if (part.feature == Feature::vertex) return dot(w, way).sign();
    if (part.feature == Feature::edge) {
        // The nearest point is that corner + u (w . u) / (u . u).
        const Vector<N> u = triangle.edge(part.index);
        return compare(dot(w, way) * dot(u, u), dot(w, u) * dot(u, way));
    }
    // It is x - n (w . n) / (n . n).
    const Vector<2 * N> n = triangle.normal();
    return dot(w, n).sign() * dot(way, n).sign();
}

/// Whether a corner is nearer to a place strictly between the ends of the segment from the origin to `end`.
template <int N>
bool passes_corner(const Vector<N>& end, const Vector<N>& corner, const Integer<2 * N>& square) {
    const Integer<2 * N> along = dot(corner, end);
    const Integer<2 * N> length = dot(end, end);
    if (along.sign() <= 0 || compare(along, length) >= 0) return false;
    const Vector<2 * N> area = cross(corner, end);
    return compare(dot(area, area), square * length) < 0;
}

/// Whether the segment from the origin to `end` is nearer to an edge, both at places that the common perpendicular of
/// their lines leads to. Lines that are parallel have none: then an end or a corner is as near.
template <int N>
bool passes_edge(const Vector<N>& end, const Vector<N>& corner, const Vector<N>& edge, const Integer<2 * N>& square) {
    // s end = corner + t edge + l n  for  n = end x edge:  s n.n = (corner x edge) . n,  t n.n = (corner x end) . n
    const Vector<2 * N> n = cross(end, edge);
    const Integer<4 * N> whole = dot(n, n);
    if (whole.zero()) return false;
    const Integer<4 * N> s = dot(cross(corner, edge), n);
    if (s.negative() || compare(s, whole) > 0) return false;
    const Integer<4 * N> t = dot(cross(corner, end), n);
    if (t.negative() || compare(t, whole) > 0) return false;
    const Integer<3 * N> volume = dot(corner, n);
    return compare(volume * volume, square * whole) < 0;
}

/// Whether the segment from the origin to `end` leads from one side of the triangle strictly to the other, through it.
template <int N>
bool passes_face(const Vector<N>& end, const Triangle<N>& triangle) {
    const Vector<2 * N> n = triangle.normal();
    const int from = -dot(triangle.corner[0], n).sign();
    const int to = dot(end - triangle.corner[0], n).sign();
    if (from * to >= 0) return false;
    int least = 1;
    int most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const int sign = dot(end, cross(triangle.corner[k], triangle.corner[(k + 1) % 3])).sign();
        least = std::min(least, sign);
        most = std::max(most, sign);
    }
    return least >= 0 || most <= 0;
}

/// A path as far as a fraction, a triangle and a radius, as integers: of the fraction m / 2^shift everything is taken
/// 2^shift times as large.
struct Integers {
    Lattice lattice;
    Bits fraction{1.0};
    int shift = 0;

    Integers(const Path& path, double fraction_, double radius, const Corners& corners) : fraction(fraction_) {
        for (const Point& point : {path.from, path.to, corners[0], corners[1], corners[2]}) lattice.add(point);
        lattice.add(radius);
        const int zeros = std::countr_zero(fraction.mantissa);
        fraction.mantissa >>= zeros;
        shift = std::max(-(fraction.exponent + zeros), 0);
    }
    /// Calls `f(way, triangle, radius squared)`, relative to the path's start. The widest serves all doubles: 2098 bits
    /// of coordinates, and 1074 of a fraction.
    template <class F>
    auto operator()(const Path& path, double radius, const Corners& corners, F&& f) const {
        const auto with = [&]<int N>(std::integral_constant<int, N>) {
            const Vector<N> from = on_lattice<N>(path.from, lattice);
            Integer<1> m;
            m.limb[0] = fraction.mantissa;
            const Vector<N> whole = on_lattice<N>(path.to, lattice) - from;
            Vector<N> way;
            for (std::size_t k = 0; k < 3; ++k) {
                const Integer<N + 1> product = whole[k] * m;  // at most what `shift` makes of it
                std::copy(product.limb, product.limb + N, way[k].limb);
            }
            Triangle<N> triangle;
            for (std::size_t k = 0; k < 3; ++k)
                triangle.corner[k] = shifted(on_lattice<N>(corners[k], lattice) - from, shift);
            const Integer<N> r = on_lattice<N>(radius, lattice) << shift;
            return f(way, triangle, r * r);
        };
        const int bits = lattice.bits() + shift;
        if (bits <= 60) return with(std::integral_constant<int, 1>{});
        if (bits <= 124) return with(std::integral_constant<int, 2>{});
        if (bits <= 316) return with(std::integral_constant<int, 5>{});
        return with(std::integral_constant<int, 50>{});
    }
};

}  // namespace

SphereStart sphere_start(const Path& path, double radius, const Corners& corners) {
    return Integers(path, 1, radius, corners)(
        path, radius, corners,
        []<int N, int M>(const Vector<N>& way, const Triangle<N>& triangle, const Integer<M>& square) {
            const Vector<N> start;
            const Part part = nearest_part(start, triangle);
            return SphereStart{compare_distance(start, part, triangle, square),
                               approach_of(start, part, triangle, way)};
        });
}

// Of two convex sets that do not meet, a segment and a triangle, the nearest points are an end and a place of the
// triangle, or a place of the segment and one of an edge.
bool sphere_enters(const Path& path, double fraction, double radius, const Corners& corners) {
    return Integers(path, fraction, radius, corners)(
        path, radius, corners,
        []<int N, int M>(const Vector<N>& end, const Triangle<N>& triangle, const Integer<M>& square) {
            if (compare_distance(end, nearest_part(end, triangle), triangle, square) < 0) return true;
            for (std::size_t k = 0; k < 3; ++k) {
                if (passes_corner(end, triangle.corner[k], square)) return true;
                if (passes_edge(end, triangle.corner[k], triangle.edge(k), square)) return true;
            }
            return passes_face(end, triangle);
        });
}

}  // namespace pierce::detail
