// Crossings judged by really moving the ends: not by an infinitesimal (e, e^2, e^3) but by the one with e = 2^-14,
// which for small integer coordinates is small enough to act the same. Plain signs of determinants in 128 bits; a tie
// is an error.
//
// Coordinates up to 32 in magnitude; lengths are in units of 2^-42, so that the move is (2^28, 2^14, 1). A determinant
// is its value V for the ends as they are, times 2^42, plus w . (2^28, 2^14, 1), where w is a cross product of two
// differences: whole numbers of magnitude at most 2 * 64^2 = 2^13. So 2^14 of the next component can't outweigh one of
// this, nor the rest V: the sign is that of the first that is not zero, as for the infinitesimal move.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>

namespace pierce::test {

using LatticePoint = std::array<int, 3>;

class MovedOracle {
  public:
    using Triangle = std::array<LatticePoint, 3>;

    static bool zero_area(const Triangle& t) {
        const Vector n = cross(minus(at(t[1]), at(t[0])), minus(at(t[2]), at(t[0])));
        return n[0] == 0 && n[1] == 0 && n[2] == 0;
    }

    /// The side that the moved point is on: +1 in front, -1 behind. For a triangle with an area.
    static int side(const Triangle& t, const LatticePoint& p) {
        return sign(volume(at(t[0]), at(t[1]), at(t[2]), moved(p)));
    }

    /// +1 if the moved segment passes from front to back, -1 if from back to front, 0 if not at all.
    static int crossing(const Triangle& t, const LatticePoint& p, const LatticePoint& q) {
        if (zero_area(t)) return 0;
        const int from = side(t, p);
        if (from == side(t, q)) return 0;
        // Seen along the segment, it passes inside of each edge or outside of it: the tetrahedra are turned one way or
        // the other.
        for (std::size_t k = 0; k < 3; ++k)
            if (sign(volume(moved(p), moved(q), at(t[k]), at(t[(k + 1) % 3]))) == from) return 0;
        return from;
    }

  private:
    __extension__ using Wide = __int128;
    using Vector = std::array<Wide, 3>;

    static Vector at(const LatticePoint& p) {
        Vector v{};
        for (std::size_t k = 0; k < 3; ++k) {
            if (p[k] < -32 || p[k] > 32) throw std::out_of_range("MovedOracle: coordinates up to 32 only");
            v[k] = Wide{p[k]} << 42;
        }
        return v;
    }
    static Vector moved(const LatticePoint& p) {
        Vector v = at(p);
        v[0] += Wide{1} << 28;
        v[1] += Wide{1} << 14;
        v[2] += 1;
        return v;
    }
    static Vector minus(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
    static Vector cross(const Vector& x, const Vector& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    // Of a, b, c, d; positive with d in front of a, b, c. b - a, of two points that are both moved or both not, is
    // taken in whole units: below 2^7 x 2^98 x 3, which fits.
    static Wide volume(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
        Vector unit = minus(b, a);
        for (Wide& x : unit) x /= Wide{1} << 42;
        const Vector u = minus(c, a);
        const Vector v = minus(d, a);
        const Vector n = cross(u, v);
        return unit[0] * n[0] + unit[1] * n[1] + unit[2] * n[2];
    }
    static int sign(const Wide& x) {
        if (x == 0) throw std::logic_error("MovedOracle: a tie is left");
        return x > 0 ? 1 : -1;
    }
};

}  // namespace pierce::test
