// Whether a point is in a closed mesh: how often a way to a far point passes through its faces, by the signs of
// volumes, in double where a crude bound tells and in GMP's whole numbers where it does not (gmp_oracle.h).
#pragma once

#include <cmath>
#include <vector>

#include <pierce/triangle_soup.h>
#include <support/gmp_oracle.h>
#include <support/random.h>

namespace pierce::test {

template <class Scalar>
class InsideJudge {
  public:
    /// Coordinates below 8.
    explicit InsideJudge(const TriangleSoup<Scalar>& soup) {
        for (const IndexTriple& t : soup.triangles)
            triangles_.push_back({detail::to_point(soup.positions[t[0]]), detail::to_point(soup.positions[t[1]]),
                                  detail::to_point(soup.positions[t[2]])});
    }
    enum class Where { outside, inside, unknown };

    /// On the surface counts as in front of it: outside, or of a mesh turned inside out inside. Two ways that
    /// disagree, or pass through more or less than a solid: unknown.
    [[nodiscard]] Where where(const Vec3<Scalar>& point) {
        int winding[2];
        for (int& w : winding) {
            const Vec3<double> far = 7 * random_.direction();
            w = winding_number(detail::to_point(point), {far[0], far[1], far[2]});
        }
        if (winding[0] != winding[1]) return Where::unknown;
        return std::abs(winding[0]) == 1 ? Where::inside : winding[0] == 0 ? Where::outside : Where::unknown;
    }

  private:
    static int sign(const detail::Point& o, const detail::Point& u, const detail::Point& v, const detail::Point& w) {
        double m[3][3];
        for (std::size_t k = 0; k < 3; ++k) {
            m[0][k] = u[k] - o[k];
            m[1][k] = v[k] - o[k];
            m[2][k] = w[k] - o[k];
        }
        const double volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                              m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                              m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        // Entries below 16, six products of three: 10 roundings of 2^-53 each of at most 6 * 16^3.
        constexpr double k_bound = 10 * 0x1p-53 * 6 * 16 * 16 * 16;
        return volume > k_bound ? 1 : volume < -k_bound ? -1 : 0;
    }

    int winding_number(const detail::Point& p, const detail::Point& far) {
        int sum = 0;
        for (const detail::Corners& c : triangles_) {
            // Positive in front of the face.
            const int from = sign(c[0], c[1], c[2], p);
            const int to = sign(c[0], c[1], c[2], far);
            if (from * to > 0) continue;
            int edges = 0;
            bool doubtful = from == 0 || to == 0;
            bool apart = false;
            for (std::size_t k = 0; k < 3; ++k) {
                const int edge = sign(p, far, c[k], c[(k + 1) % 3]);
                doubtful = doubtful || edge == 0;
                apart = apart || (edges * edge < 0);
                edges = edge != 0 ? edge : edges;
            }
            if (apart) continue;
            // Leaving through the front is leaving the solid: a hit from the back.
            sum += doubtful ? -gmp_.hit_side({p, far}, c) : from < 0 ? 1 : -1;
        }
        return sum;
    }

    std::vector<detail::Corners> triangles_;
    GmpOracle gmp_;
    Random random_{99};
};

}  // namespace pierce::test
