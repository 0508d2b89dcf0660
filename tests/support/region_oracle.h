// A judge for walks through regions: each crossing of the moved flight as a polynomial in the infinitesimal e, in
// rationals of GMP, over all triangles. Nothing of the library is asked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <gmpxx.h>

#include <pierce/label_report.h>
#include <pierce/ray.h>
#include <pierce/triangle_soup.h>

namespace pierce::test {

/// A number c0 + c1 e + c2 e^2 + c3 e^3 for e -> 0+.
struct Tiny {
    std::array<mpq_class, 4> c;

    friend Tiny operator+(const Tiny& x, const Tiny& y) {
        Tiny sum;
        for (std::size_t i = 0; i < 4; ++i) sum.c[i] = x.c[i] + y.c[i];
        return sum;
    }
    friend Tiny operator*(const mpq_class& x, const Tiny& y) {
        Tiny product;
        for (std::size_t i = 0; i < 4; ++i) product.c[i] = x * y.c[i];
        return product;
    }
    friend Tiny operator-(const Tiny& x, const Tiny& y) { return x + mpq_class(-1) * y; }
    friend bool operator==(const Tiny&, const Tiny&) = default;
    [[nodiscard]] int sign() const {
        for (const mpq_class& x : c)
            if (sgn(x) != 0) return sgn(x);
        return 0;
    }
    friend bool operator<(const Tiny& x, const Tiny& y) { return (x - y).sign() < 0; }
};

struct OracleLeg {
    std::uint32_t region = 0;
    std::uint32_t next = 0;
    std::optional<std::uint32_t> triangle;
    bool from_front = false;
    bool consistent = true;
    mpq_class exit;  ///< of one with a triangle
};

template <class Scalar>
class RegionOracle {
  public:
    explicit RegionOracle(const Segment<Scalar>& way) : start_(exact(way.from)), end_(mpq_class(1)) {
        const V to = exact(way.to);
        for (std::size_t k = 0; k < 3; ++k) direction_[k] = to[k] - start_[k];
    }
    explicit RegionOracle(const Ray<Scalar>& way) : start_(exact(way.origin)), direction_(exact(way.direction)) {
        if (!std::isinf(way.limit)) end_ = static_cast<double>(way.limit);
    }

    /// The legs, but for the region of one without any face.
    [[nodiscard]] std::vector<OracleLeg> legs(const TriangleSoup<Scalar>& soup,
                                              const std::vector<FaceRegions>& labels) const {
        std::vector<Crossing> all;
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) add(soup, labels, t, all);
        std::stable_sort(all.begin(), all.end(), [](const Crossing& x, const Crossing& y) { return x.at < y.at; });
        std::vector<OracleLeg> out;
        for (auto first = all.begin(); first != all.end();) {
            const auto last = std::find_if(first, all.end(), [&](const Crossing& x) { return !(x.at == first->at); });
            std::vector<Crossing> pile(first, last);
            std::uint32_t current = out.empty() ? beginning(pile) : out.back().next;
            while (!pile.empty()) {
                auto best =
                    std::find_if(pile.begin(), pile.end(), [&](const Crossing& x) { return x.near == current; });
                if (best == pile.end()) best = pile.begin();
                const std::uint32_t region = out.empty() ? best->near : out.back().next;
                out.push_back(
                    {region, best->far, best->triangle, best->from_front, region == best->near, best->at.c[0]});
                current = best->far;
                pile.erase(best);
            }
            first = last;
        }
        OracleLeg end;
        if (!out.empty()) end.region = end.next = out.back().next;
        out.push_back(end);
        return out;
    }

  private:
    using V = std::array<mpq_class, 3>;
    using TinyV = std::array<Tiny, 3>;
    struct Crossing {
        Tiny at;
        std::uint32_t triangle;
        std::uint32_t near;
        std::uint32_t far;
        bool from_front;
    };

    static V exact(const Vec3<Scalar>& p) {
        return {mpq_class(static_cast<double>(p[0])), mpq_class(static_cast<double>(p[1])),
                mpq_class(static_cast<double>(p[2]))};
    }
    static V minus(const V& x, const V& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
    static V cross(const V& x, const V& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    static Tiny dot(const V& x, const TinyV& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

    // Of the moved flight from a corner, at no time.
    [[nodiscard]] TinyV from(const V& corner) const {
        TinyV out;
        for (std::size_t k = 0; k < 3; ++k) {
            out[k].c[0] = start_[k] - corner[k];
            out[k].c[k + 1] = 1;
        }
        return out;
    }

    void add(const TriangleSoup<Scalar>& soup, const std::vector<FaceRegions>& labels, std::uint32_t t,
             std::vector<Crossing>& out) const {
        const auto [ia, ib, ic] = soup.triangles[t];
        const std::array<V, 3> corner = {exact(soup.positions[ia]), exact(soup.positions[ib]),
                                         exact(soup.positions[ic])};
        const V n = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
        const mpq_class slope = n[0] * direction_[0] + n[1] * direction_[1] + n[2] * direction_[2];
        if (sgn(slope) == 0) return;
        const Tiny height = dot(n, from(corner[0]));
        const Tiny at = mpq_class(-1 / slope) * height;
        if (at.sign() < 0) return;
        if (end_ && (at - Tiny{{*end_, 0, 0, 0}}).sign() > 0) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const V edge = minus(corner[(k + 1) % 3], corner[k]);
            TinyV place = from(corner[k]);
            for (std::size_t i = 0; i < 3; ++i) place[i] = place[i] + direction_[i] * at;
            // n . (edge x place) = (n x edge) . place: positive inside.
            if (dot(cross(n, edge), place).sign() <= 0) return;
        }
        const bool front = height.sign() > 0;
        const std::uint32_t face = soup.faces.empty() ? t : soup.faces[t];
        const FaceRegions& label = labels[face];
        out.push_back({at, t, front ? label.front : label.behind, front ? label.behind : label.front, front});
    }
    static std::uint32_t beginning(const std::vector<Crossing>& pile) {
        for (const Crossing& x : pile)
            if (std::none_of(pile.begin(), pile.end(), [&](const Crossing& y) { return &x != &y && y.far == x.near; }))
                return x.near;
        return pile[0].near;
    }

    V start_;
    V direction_;
    std::optional<mpq_class> end_;
};

}  // namespace pierce::test
