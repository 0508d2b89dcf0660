// A segment on its way through the rooms: what the grid and the kernels need of it, computed once.
#pragma once

#include <grid/walk.h>
#include <query/scene.h>

namespace pierce::detail {

/// What the culling left of the cells that a query visited: all triangles that could stop a point on its way to the hit, if
/// `complete`. So the verified point needs no second way through the grid.
struct Shortlist {
    static constexpr unsigned k_most = 192;

    /// `covered`: the cells were asked for all that comes near a point of the path, rounded.
    void add(const std::uint32_t* some, unsigned number, bool covered) {
        complete = complete && covered && count + number <= k_most;
        if (!complete) return;
        std::copy_n(some, number, ids.begin() + count);
        count += number;
    }

    std::array<std::uint32_t, k_most> ids;
    unsigned count = 0;
    bool complete = true;
};

template <class Scalar>
struct Search {
    Search(const Scene<Scalar>& scene_, const Path& path_, Sides sides) : scene(scene_), path(path_) {
        const double scale = static_cast<double>(scene.scale);
        double reach = 0;
        double furthest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double d = (path.to[k] - path.from[k]) * scale;
            probe.origin[k] = static_cast<Scalar>(path.from[k]);
            probe.direction[k] = static_cast<float>(d);
            reach = std::max(reach, std::abs(d));
            furthest = std::max({furthest, std::abs(path.from[k]), std::abs(path.to[k])});
        }
        probe.origin[3] = 0;
        probe.direction[3] = 0;
        probe.scale = scene.scale;
        probe.reach = static_cast<float>(reach);
        probe.noise = 0;
        probe.ends = 1;
        probe.unit = 0x1p-24F;
        probe.front = sides != Sides::back ? ~0U : 0U;
        probe.back = sides != Sides::front ? ~0U : 0U;
        // A point of the path, computed in double, is within 2^-50 of the largest coordinate of the exact one; rounded to the
        // scalar it moves by at most half a unit of that, or by half of the least denormal number.
        rounding = (furthest * (0x1p-50 + 0.5 * static_cast<double>(std::numeric_limits<Scalar>::epsilon())) +
                    static_cast<double>(std::numeric_limits<Scalar>::denorm_min()));
        is_far = reach > k_far;
    }

    /// From here on the kernels work around the path's point at `fraction`: for a long segment, errors are those of the cell's
    /// size and not of the segment's.
    void move_to(double fraction) {
        for (std::size_t k = 0; k < 3; ++k)
            probe.origin[k] = static_cast<Scalar>(path.from[k] + fraction * (path.to[k] - path.from[k]));
        probe.noise = static_cast<float>(rounding * static_cast<double>(scene.scale) * 1.0001);
        probe.ends = 0;
    }

    /// In units of cells. Up to here the start itself is near enough: 48 * 2^-24 * 32^2 is a few thousandths of a cell.
    static constexpr double k_far = 32;

    const Scene<Scalar>& scene;
    const Path path;
    Probe<Scalar> probe;
    double rounding;  ///< how far a point of the path may be off in each coordinate when it is rounded to the scalar
    bool is_far;
};

}  // namespace pierce::detail
