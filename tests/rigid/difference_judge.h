// A judge of ways between differences: whole numbers in GMP on a lattice that holds all coordinates, every triangle
// looked at, nothing rounded. It shares no code with the library.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <pierce/motion.h>
#include <pierce/options.h>
#include <pierce/triangle_soup.h>

namespace pierce::test {

using Whole3 = std::array<mpz_class, 3>;

inline Whole3 operator-(const Whole3& x, const Whole3& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
inline Whole3 cross(const Whole3& x, const Whole3& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
inline mpz_class dot(const Whole3& x, const Whole3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

struct Judged {
    mpq_class fraction;
    std::uint32_t triangle = 0;
    Sides side = Sides::front;
    Feature feature = Feature::face;
    int feature_index = 0;
    bool at_start = false;
};

template <class Scalar>
class DifferenceJudge {
  public:
    DifferenceJudge(const TriangleSoup<Scalar>& soup, const Segment<Scalar>& way, const Translation<Scalar>& motion)
        : soup_(soup) {
        for (const auto* v : {&way.from, &way.to, &motion.from, &motion.to}) add(*v);
        for (const auto& p : soup.positions) add(p);
        from_ = whole(way.from) - whole(motion.from);
        to_ = whole(way.to) - whole(motion.to);
        for (const auto& p : soup.positions) corners_.push_back(whole(p));
    }

    [[nodiscard]] std::optional<Judged> first(Sides sides) const {
        std::optional<Judged> best;
        for (std::uint32_t i = 0; i < soup_.triangles.size(); ++i) {
            const auto judged = judge(i, sides);
            if (judged && (!best || judged->fraction < best->fraction)) best = judged;
        }
        return best;
    }

  private:
    void add(const Vec3<Scalar>& p) {
        for (int k = 0; k < 3; ++k) {
            const auto x = static_cast<double>(p[k]);
            if (x == 0) continue;
            int exponent = 0;
            std::frexp(x, &exponent);
            lowest_ = std::min(lowest_, exponent - 53);
        }
    }
    [[nodiscard]] Whole3 whole(const Vec3<Scalar>& p) const {
        Whole3 out;
        for (int k = 0; k < 3; ++k) {
            int exponent = 0;
            const double mantissa = std::ldexp(std::frexp(static_cast<double>(p[k]), &exponent), 53);
            if (mantissa == 0) continue;
            mpz_class& x = out[static_cast<std::size_t>(k)];
            x = mantissa;
            x <<= static_cast<mp_bitcnt_t>(exponent - 53 - lowest_);
        }
        return out;
    }

    [[nodiscard]] std::optional<Judged> judge(std::uint32_t i, Sides sides) const {
        const IndexTriple& t = soup_.triangles[i];
        const Whole3 corner[3] = {corners_[t[0]], corners_[t[1]], corners_[t[2]]};
        const Whole3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
        const mpz_class f = dot(normal, from_ - corner[0]);
        const mpz_class e = dot(normal, to_ - corner[0]);
        const bool front = f >= 0 && e < 0 && sides != Sides::back;
        const bool back = sides == Sides::both ? f < 0 && e >= 0 : sides == Sides::back && f <= 0 && e > 0;
        if (!front && !back) return std::nullopt;
        // The point is (F to - T from) / (F - T); inside where the volume with each edge has the normal's side.
        Judged out;
        int zeros = 0;
        int last_zero = 0;
        int last_other = 0;
        for (int k = 0; k < 3; ++k) {
            const Whole3 a = corner[(k + 1) % 3];
            const Whole3 b = corner[(k + 2) % 3];
            // Of the scaled point P (F - T) - a (F - T), against the edge: ((b - a) x (P - a)) . normal >= 0.
            Whole3 p;
            for (std::size_t c = 0; c < 3; ++c) p[c] = (f * to_[c] - e * from_[c]) - a[c] * (f - e);
            const int sign = sgn(dot(cross(b - a, p), normal)) * (front ? 1 : -1);
            if (sign < 0) return std::nullopt;
            if (sign == 0)
                ++zeros, last_zero = k;
            else
                last_other = k;
        }
        out.triangle = i;
        out.side = front ? Sides::front : Sides::back;
        out.at_start = f == 0;
        out.fraction = mpq_class(f, f - e);
        out.fraction.canonicalize();
        if (zeros == 1) out.feature = Feature::edge, out.feature_index = (last_zero + 1) % 3;
        if (zeros == 2) out.feature = Feature::vertex, out.feature_index = last_other;
        return out;
    }

    const TriangleSoup<Scalar>& soup_;
    int lowest_ = 2000;
    Whole3 from_;
    Whole3 to_;
    std::vector<Whole3> corners_;
};

}  // namespace pierce::test
