// Moving points and triangles: the filter first, exact arithmetic where it can't tell.
#include <motion/moving.h>

#include <cmath>

#include <motion/filter.h>
#include <motion/first.h>

namespace pierce::detail {

namespace {

[[nodiscard]] bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

[[nodiscard]] bool is_finite(const MovingPoint& point, const MovingTriangle& triangle) {
    for (int i = 0; i < 2; ++i) {
        if (!is_finite(point.at[i])) return false;
        for (const Point& corner : triangle.at[i])
            if (!is_finite(corner)) return false;
    }
    return true;
}

// Limbs of the corners seen from the point, and of all else: of coordinates of 124 bits, and of any. The longest numbers are coefficients of cubics
// halved 18 L + 90 times (root.h): 3 L + 9 bits and three a halving, 57 L + 279 in all. Common divisors take less:
// 36 L, and values at fractions at most 39 L.
template <class F>
[[gnu::always_inline]] inline decltype(auto) with_room(int bits, F&& f) {
    constexpr int k_short = 124;
    constexpr int k_all = 1024 + 1074;
    constexpr auto limbs = [](int of) { return (57 * of + 279) / 64 + 2; };
    if (bits <= k_short) return f(std::integral_constant<int, 2>{}, std::integral_constant<int, limbs(k_short)>{});
    return f(std::integral_constant<int, (k_all + 1) / 64 + 1>{}, std::integral_constant<int, limbs(k_all)>{});
}

template <int S, int C>
[[gnu::noinline]] Impact decide(const MovingPoint& point, const MovingTriangle& triangle, const Lattice& lattice,
                                Contact contact) {
    FirstContact<S, C> first(point, triangle, lattice, contact);
    Impact impact = first.impact();
    if (!impact.hit) return impact;
    const Enclosure enclosure = first.enclosure();
    impact.earliest = enclosure.earliest;
    impact.latest = enclosure.latest;
    return impact;
}

[[nodiscard]] Impact decide(const MovingPoint& point, const MovingTriangle& triangle, Contact contact) {
    const Lattice lattice = lattice_of(point, triangle);
    return with_room(lattice.bits(), [&]<int S, int C>(std::integral_constant<int, S>, std::integral_constant<int, C>) {
        return decide<S, C>(point, triangle, lattice, contact);
    });
}

}  // namespace

Impact first_contact(const MovingPoint& point, const MovingTriangle& triangle, Contact contact) noexcept {
    Impact impact;
    const Certainty certainty = filter(point, triangle, contact, impact);
    if (certainty == Certainty::hit) return impact;
    if (certainty == Certainty::miss || !is_finite(point, triangle)) return {};
    return decide(point, triangle, contact);
}

int compare_impacts(const MovingPoint& point, Contact contact, const MovingTriangle& first, const Impact& one,
                    const MovingTriangle& second, const Impact& two) noexcept {
    if (one.latest < two.earliest) return -1;
    if (two.latest < one.earliest) return 1;
    if (one.earliest == one.latest && two.earliest == two.latest) return 0;
    const Lattice a = lattice_of(point, first);
    const Lattice b = lattice_of(point, second);
    return with_room(std::max(a.bits(), b.bits()),
                     [&]<int S, int C>(std::integral_constant<int, S>, std::integral_constant<int, C>) {
                         FirstContact<S, C> x(point, first, a, contact);
                         FirstContact<S, C> y(point, second, b, contact);
                         return compare_times(x, y);
                     });
}

int compare_time(const MovingPoint& point, Contact contact, const MovingTriangle& triangle, const Impact& impact,
                 double time) noexcept {
    if (impact.latest < time) return -1;
    if (time < impact.earliest) return 1;
    if (impact.earliest == impact.latest) return 0;
    const Lattice lattice = lattice_of(point, triangle);
    return with_room(lattice.bits(), [&]<int S, int C>(std::integral_constant<int, S>, std::integral_constant<int, C>) {
        return FirstContact<S, C>(point, triangle, lattice, contact).compare_with(time);
    });
}

Impact sharpened(const MovingPoint& point, Contact contact, const MovingTriangle& triangle,
                 const Impact& impact) noexcept {
    return impact.earliest == impact.latest ? impact : decide(point, triangle, contact);
}

}  // namespace pierce::detail
