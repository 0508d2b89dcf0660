// Contacts and their times in exact arithmetic: how long the numbers may get.
#include <motion/decide.h>

#include <motion/first.h>

namespace pierce::detail {

namespace {

// Limbs of the corners seen from the point, and of all else: for coordinates of 124 bits, of 300, which all floats
// are, and for any. The longest numbers are coefficients of cubics halved 18 L + 90 times (root.h): 3 L + 9 bits and
// three a halving, 57 L + 279 in all. Common divisors take less, at most 36 L + 168 bits, and values at fractions 39 L
// + 182.
template <class F>
[[gnu::always_inline]] inline decltype(auto) with_room(int bits, F&& f) {
    constexpr int k_short = 124;
    constexpr int k_floats = 300;
    constexpr int k_all = 1024 + 1074;
    constexpr auto limbs = [](int of) { return (57 * of + 279) / 64 + 2; };
    if (bits <= k_short) return f(std::integral_constant<int, 2>{}, std::integral_constant<int, limbs(k_short)>{});
    if (bits <= k_floats)
        return f(std::integral_constant<int, (k_floats + 1) / 64 + 1>{},
                 std::integral_constant<int, limbs(k_floats)>{});
    return f(std::integral_constant<int, (k_all + 1) / 64 + 1>{}, std::integral_constant<int, limbs(k_all)>{});
}

// Functions of their own, so that what is decided with short numbers needs no large stack.
template <int S, int C>
[[gnu::noinline]] Impact contact_of(const MovingPoint& point, const MovingTriangle& triangle, const Lattice& lattice,
                                    ContactRule contact) {
    FirstContact<S, C> first(point, triangle, lattice, contact);
    Impact impact = first.impact();
    if (!impact.hit) return impact;
    const Enclosure enclosure = first.enclosure();
    impact.earliest = enclosure.earliest;
    impact.latest = enclosure.latest;
    return impact;
}

template <int S, int C>
[[gnu::noinline]] int order_of(const MovingPoint& point, ContactRule contact, const MovingTriangle& first,
                               const Lattice& a, const MovingTriangle& second, const Lattice& b) {
    FirstContact<S, C> x(point, first, a, contact);
    FirstContact<S, C> y(point, second, b, contact);
    return compare_times(x, y);
}

template <int S, int C>
[[gnu::noinline]] int order_of(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle,
                               const Lattice& lattice, double time) {
    return FirstContact<S, C>(point, triangle, lattice, contact).compare_with(time);
}

template <int N>
using Limbs = std::integral_constant<int, N>;

}  // namespace

Impact decide_contact(const MovingPoint& point, const MovingTriangle& triangle, ContactRule contact) {
    const Lattice lattice = lattice_of(point, triangle);
    return with_room(lattice.bits(), [&]<int S, int C>(Limbs<S>, Limbs<C>) {
        return contact_of<S, C>(point, triangle, lattice, contact);
    });
}

int decide_order(const MovingPoint& point, ContactRule contact, const MovingTriangle& first,
                 const MovingTriangle& second) {
    const Lattice a = lattice_of(point, first);
    const Lattice b = lattice_of(point, second);
    return with_room(std::max(a.bits(), b.bits()), [&]<int S, int C>(Limbs<S>, Limbs<C>) {
        return order_of<S, C>(point, contact, first, a, second, b);
    });
}

int decide_order(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle, double time) {
    const Lattice lattice = lattice_of(point, triangle);
    return with_room(lattice.bits(), [&]<int S, int C>(Limbs<S>, Limbs<C>) {
        return order_of<S, C>(point, contact, triangle, lattice, time);
    });
}

}  // namespace pierce::detail
