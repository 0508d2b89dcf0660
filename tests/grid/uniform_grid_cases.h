// Boxes and segments that a uniform grid is tried with, and the judge of what it must find.
#pragma once

#include <CGAL/Gmpq.h>

#include <grid/uniform_grid.h>
#include <support/random.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace pierce::test {

using namespace detail;
using Q = CGAL::Gmpq;
template <class Scalar>
using Boxes = std::vector<ClusterBox<Scalar>>;
using Triple = std::array<double, 3>;

struct Segment {
    Triple origin;
    Triple direction;
    double noise = 0;
    double limit = 1;
};

/// Where the segment first comes within the noise of the box, if it does: clipping in rational numbers, behind a
/// generous look in double.
template <class Scalar>
bool meets(const Segment& s, const ClusterBox<Scalar>& box, const Frame& frame, Q& enter) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double from = s.origin[k] + frame.low[k];
        const double to = from + s.direction[k];
        const double slack = s.noise + 1e-9 * (1 + std::abs(from) + std::abs(to));
        if (std::min(from, to) - slack > box.high[k] || std::max(from, to) + slack < box.low[k]) return false;
    }
    enter = 0;
    Q leave = s.limit;
    for (std::size_t k = 0; k < 3; ++k) {
        const Q low = Q(static_cast<double>(box.low[k])) - Q(frame.low[k]) - Q(s.noise) - Q(s.origin[k]);
        const Q high = Q(static_cast<double>(box.high[k])) - Q(frame.low[k]) + Q(s.noise) - Q(s.origin[k]);
        if (s.direction[k] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        const Q d = s.direction[k];
        enter = std::max(enter, std::min(Q(low / d), Q(high / d)));
        leave = std::min(leave, std::max(Q(low / d), Q(high / d)));
        if (enter > leave) return false;
    }
    return true;
}

struct Found {
    std::vector<int> times;
    std::size_t visits = 0;
    std::uint64_t cells = 0;
};

/// The clusters shown, by their places, as `cluster_ref(place, 1)` names them.
template <class Visit>
Found find(const UniformGrid& grid, std::size_t count, const Segment& s, Visit&& visit) {
    Found found{std::vector<int>(count), 0, 0};
    grid.visit(s.origin.data(), s.direction.data(), s.noise, s.limit, found.cells, [&](ClusterRef ref, double limit) {
        ++found.visits;
        ++found.times[first_of(ref)];
        return visit(first_of(ref), limit);
    });
    return found;
}
inline Found find(const UniformGrid& grid, std::size_t count, const Segment& s) {
    return find(grid, count, s, [](std::size_t, double limit) { return limit; });
}

template <class Scalar>
UniformGrid grid_of(const Boxes<Scalar>& boxes, const Frame& frame, double cell = 0, std::size_t most = 0,
                    const Executor& executor = {}) {
    return UniformGrid::make(std::span<const ClusterBox<Scalar>>(boxes), frame, cell, most, executor);
}

enum class Kind { sphere, lattice, mixture, flat, line, one, same, scattered };
constexpr std::array k_kinds = {Kind::sphere, Kind::lattice, Kind::mixture, Kind::flat,
                                Kind::line,   Kind::one,     Kind::same,    Kind::scattered};

/// In a scene that is 1.6 wide; those of a lattice have their ends on the walls of cells of a tenth.
template <class Scalar>
Boxes<Scalar> boxes_of(Kind kind, std::size_t count, const Frame& frame, Random& random) {
    if (kind == Kind::one) count = 1;
    Boxes<Scalar> boxes(count);
    for (std::size_t i = 0; i < count; ++i) {
        ClusterBox<Scalar>& box = boxes[i];
        box.ref = cluster_ref(static_cast<std::uint32_t>(i), 1);
        box.key = 0;
        const Vec3<double> centre = kind == Kind::sphere || kind == Kind::mixture
                                        ? Vec3<double>(Vec3<double>::Constant(0.8) + 0.7 * random.direction())
                                        : Vec3<double>(Vec3<double>::Constant(0.8) + 0.7 * random.in_cube());
        double half = kind == Kind::scattered ? 0.5 * std::pow(10, random.between(-6, -0.3)) : random.between(0, 0.06);
        if (kind == Kind::mixture) half = i == 0 ? 0.79 : 1e-4 * random.unit();
        for (std::size_t k = 0; k < 3; ++k) {
            double x = centre[static_cast<Eigen::Index>(k)];
            double h = half * random.unit();
            if (kind == Kind::mixture && i > 0) x = 0.3 + 0.02 * x;
            if (kind == Kind::same) x = 0.8, h = 0.1;
            if ((kind == Kind::flat && k == 1) || (kind == Kind::line && k != 2)) x = 0.25, h = 0;
            const int steps = random.between_ints(0, 13);
            const double low = kind == Kind::lattice ? steps * 0.1 : x - h;
            const double high = kind == Kind::lattice ? (steps + random.between_ints(0, 2)) * 0.1 : x + h;
            box.low[k] = static_cast<Scalar>(low + frame.low[k]);
            box.high[k] = static_cast<Scalar>(high + frame.low[k]);
        }
    }
    return boxes;
}

/// With 40 bits behind the point, so that sums of a few are exact.
inline double short_number(double x) { return std::round(x * 0x1p40) * 0x1p-40; }

template <class Scalar>
Segment segment_for(const Boxes<Scalar>& boxes, const Frame& frame, double cell, Random& random) {
    Segment s;
    const int how = random.between_ints(0, 9);
    const double noises[] = {0, 0, 0, 0x1p-52, 1e-9, 0.01, 0.125, 0.7, 10};
    s.noise = noises[random.below(9)];
    if (random.chance(0.3)) s.limit = random.unit();
    for (std::size_t k = 0; k < 3; ++k) {
        s.origin[k] = random.between(-0.3, 1.9);
        s.direction[k] = random.between(-1, 1) * (how == 1 ? 1e-3 : 1);
    }
    if (how == 2) s.direction = {};
    if (how == 3) s.direction[random.below(3)] = s.direction[random.below(3)] = 0;
    if (how == 4) {  // both ends outside, far
        const double far = random.chance(0.5) ? 3 : 60;
        for (std::size_t k = 0; k < 3; ++k) {
            const double to = random.between(0.2, 1.4);
            s.origin[k] = to - far * 0.5 * s.direction[k];
            s.direction[k] *= far;
        }
    }
    if (how == 5 || how == 6) {  // in walls
        for (std::size_t k = 0; k < 3; ++k) {
            if (random.chance(0.6))
                s.origin[k] = static_cast<double>(boxes[0].low[k]) - frame.low[k] + random.between_ints(0, 15) * cell;
            if (random.chance(0.6)) s.direction[k] = how == 5 ? random.between_ints(-4, 4) * cell : 0;
        }
    }
    if (how >= 7) {  // through a corner, or as far from it as the noise in some axes
        const ClusterBox<Scalar>& box = boxes[random.below(boxes.size())];
        s.limit = 1;
        const double sizes[] = {1e-6, 0.1, 1, 30};
        const double size = sizes[random.below(4)];
        for (std::size_t k = 0; k < 3; ++k) {
            const bool high = random.chance(0.5);
            const double corner = static_cast<double>(high ? box.high[k] : box.low[k]) - frame.low[k];
            const double apart = random.chance(0.5) ? 0 : s.noise;
            s.direction[k] = short_number(size * s.direction[k]);
            const double at = random.chance(0.5) ? 0.5 : 1;
            s.origin[k] = corner + (high ? apart : -apart) - at * s.direction[k];
        }
    }
    return s;
}

inline std::string text(const Segment& s) {
    std::string all;
    for (const double x :
         {s.origin[0], s.origin[1], s.origin[2], s.direction[0], s.direction[1], s.direction[2], s.noise, s.limit}) {
        char one[40];
        std::snprintf(one, sizeof one, "%a ", x);
        all += one;
    }
    return all;
}

}  // namespace pierce::test
