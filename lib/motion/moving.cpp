// Moving points and triangles: the filter first, exact arithmetic where it can't tell.
#include <motion/moving.h>

#include <cmath>

#include <motion/decide.h>
#include <motion/filter.h>

namespace pierce::detail {

namespace {

[[nodiscard]] bool is_finite(const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

[[nodiscard]] bool is_finite(const MovingPoint& point, const MovingTriangle& triangle) {
    for (int i = 0; i < 2; ++i) {
        if (!is_finite(point.at[i])) return false;
        for (const Point& corner : triangle.at[i])
            if (!is_finite(corner)) return false;
    }
    return true;
}

}  // namespace

Impact first_contact(const MovingPoint& point, const MovingTriangle& triangle, ContactRule contact) noexcept {
    Impact impact;
    const Certainty certainty = filter(point, triangle, contact, impact);
    if (certainty == Certainty::hit) return impact;
    if (certainty == Certainty::miss || !is_finite(point, triangle)) return {};
    return decide_contact(point, triangle, contact);
}

int compare_impacts(const MovingPoint& point, ContactRule contact, const MovingTriangle& first, const Impact& one,
                    const MovingTriangle& second, const Impact& two) noexcept {
    if (one.latest < two.earliest) return -1;
    if (two.latest < one.earliest) return 1;
    if (one.earliest == one.latest && two.earliest == two.latest) return 0;
    return decide_order(point, contact, first, second);
}

int compare_time(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle, const Impact& impact,
                 double time) noexcept {
    if (impact.latest < time) return -1;
    if (time < impact.earliest) return 1;
    if (impact.earliest == impact.latest) return 0;
    return decide_order(point, contact, triangle, time);
}

Impact sharpened(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle,
                 const Impact& impact) noexcept {
    return impact.earliest == impact.latest ? impact : decide_contact(point, triangle, contact);
}

bool certainly_apart(const MovingPoint& point, const MovingTriangle& triangle) noexcept {
    Impact impact;
    return filter(point, triangle, ContactRule::closed, impact) == Certainty::miss;
}

}  // namespace pierce::detail
