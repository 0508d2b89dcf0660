// A judge for millions of decisions: the rule by determinants of exact integers in GMP. Rational arithmetic on
// coordinates that are all multiples of one power of two, with that power divided out.
#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>

#include <gmp.h>

#include <point.h>

namespace pierce::test {

class GmpOracle {
  public:
    GmpOracle() {
        for (auto* z : all()) mpz_init(*z);
    }
    ~GmpOracle() {
        for (auto* z : all()) mpz_clear(*z);
    }
    GmpOracle(const GmpOracle&) = delete;
    GmpOracle& operator=(const GmpOracle&) = delete;

    /// +1 for a hit from the front, -1 for one from the back, 0 for none, where both sides count.
    int hit_side(const detail::Path& path, const detail::Corners& corners) {
        load({path.from, path.to, corners[0], corners[1], corners[2]});
        const int from = -orientation(k_from, k_a, k_b, k_c);
        const int to = -orientation(k_to, k_a, k_b, k_c);
        if (!(from >= 0 && to < 0) && !(from < 0 && to >= 0)) return 0;
        const int side = from >= 0 ? 1 : -1;
        // The line from -> to passes an edge on its inner side if the tetrahedron of the four points is turned that
        // way.
        for (const auto& [u, v] : {std::array{k_a, k_b}, {k_b, k_c}, {k_c, k_a}})
            if (-orientation(k_from, k_to, u, v) * side < 0) return 0;
        return side;
    }

  private:
    // value = mantissa * 2^exponent, the mantissa odd or 0.
    struct Parts {
        Parts() = default;
        explicit Parts(double x) : mantissa(static_cast<long>(std::ldexp(std::frexp(x, &exponent), 53))) {
            exponent -= 53;
            if (mantissa == 0) return;
            const int zeros = __builtin_ctzl(static_cast<unsigned long>(mantissa));
            mantissa >>= zeros;
            exponent += zeros;
        }
        int exponent = 0;
        long mantissa = 0;
    };

    enum Index : std::size_t { k_from, k_to, k_a, k_b, k_c };

    // The sign of the determinant of (u - o, v - o, w - o).
    int orientation(Index o, Index u, Index v, Index w) {
        const std::array<Index, 3> rows = {u, v, w};
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t k = 0; k < 3; ++k) mpz_sub(row_[r][k], point_[rows[r]][k], point_[o][k]);
        mpz_set_ui(sum_, 0);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            mpz_mul(minor_, row_[1][i], row_[2][j]);
            mpz_submul(minor_, row_[1][j], row_[2][i]);
            mpz_addmul(sum_, row_[0][k], minor_);
        }
        return mpz_sgn(sum_);
    }

    void load(const std::array<detail::Point, 5>& points) {
        int lowest = INT_MAX;  // exponent of the last bit that any coordinate has
        std::array<std::array<Parts, 3>, 5> parts{};
        for (std::size_t i = 0; i < 5; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                parts[i][k] = Parts(points[i][k]);
                if (parts[i][k].mantissa != 0) lowest = std::min(lowest, parts[i][k].exponent);
            }
        for (std::size_t i = 0; i < 5; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                mpz_set_si(point_[i][k], parts[i][k].mantissa);
                if (parts[i][k].mantissa != 0)
                    mpz_mul_2exp(point_[i][k], point_[i][k], static_cast<mp_bitcnt_t>(parts[i][k].exponent - lowest));
            }
    }

    std::array<mpz_t*, 26> all() {
        std::array<mpz_t*, 26> out{};
        std::size_t n = 0;
        for (auto& p : point_)
            for (auto& x : p) out[n++] = &x;
        for (auto& r : row_)
            for (auto& x : r) out[n++] = &x;
        out[n++] = &minor_;
        out[n++] = &sum_;
        return out;
    }

    mpz_t point_[5][3];
    mpz_t row_[3][3];
    mpz_t minor_;
    mpz_t sum_;
};

}  // namespace pierce::test
