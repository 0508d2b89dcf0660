// A segment on its way through the rooms: what the grid and the kernels need of it, computed once.
#pragma once

#include <cmath>
#include <limits>

#include <grid/grid.h>
#include <query/scene.h>

namespace pierce::detail {

/// Room behind a list of ids that the kernels may write to.
constexpr unsigned k_beyond_ids = 8;

/// What the culling left of the cells that a query visited: all triangles that could stop a point on its way to the hit, if
/// `complete`. So the verified point needs no second way through the grid.
struct Shortlist {
    static constexpr unsigned k_room = 256;
    /// With room for this many ids.
    static constexpr unsigned k_most = 2 * k_room + k_beyond_ids;

    explicit Shortlist(std::uint32_t* room) : ids(room) {}

    /// For the next `k_room` ids, and for what kernels write beyond them.
    [[nodiscard]] std::uint32_t* room() {
        if (count > k_room) {
            count = 0;
            complete = false;
        }
        return ids + count;
    }
    /// That many have been written.
    void take(unsigned some) { count += some; }

    std::uint32_t* ids = nullptr;
    unsigned count = 0;
    bool complete = true;
};
/// In whole cache lines, as the first few ids are written many at a time and read one by one at once.
struct alignas(64) Ids : std::array<std::uint32_t, Shortlist::k_most> {};

/// What the wide kernels ask of a segment around its start, but for the ray.
template <class Scalar>
[[nodiscard]] Probe<Scalar> make_probe(float scale, Sides sides, float unit) {
    Probe<Scalar> probe;
    probe.scale = scale;
    probe.noise = 0;
    probe.ends = 1;
    probe.unit = unit;
    probe.front = sides != Sides::back ? ~0U : 0U;
    probe.back = sides != Sides::front ? ~0U : 0U;
    return probe;
}

/// Around its start.
template <class Scalar>
void set_ray(const Path& path, float scale, Ray<Scalar>& ray) {
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = (path.to[k] - path.from[k]) * static_cast<double>(scale);
        ray.origin[k] = static_cast<Scalar>(path.from[k]);
        ray.direction[k] = static_cast<float>(d);
        reach = std::max(reach, std::abs(d));
    }
    ray.origin[3] = 0;
    ray.direction[3] = static_cast<float>(reach);
}

template <class Scalar>
class Search {
  public:
    /// `path_` must live as long. (A copy of what was just written would wait for memory.)
    Search(const Scene<Scalar>& scene_, const Path& path_, Sides sides) : scene(scene_), path(path_), sides_(sides) {}
    Search(const Scene<Scalar>&, Path&&, Sides) = delete;

    const Scene<Scalar>& scene;
    const Path& path;

    /// What the wide kernels ask with, in bounds of this unit. Made when it is first asked for: most short segments never come near a
    /// triangle.
    const Probe<Scalar>& probe(float unit) {
        prepare();
        probe_.unit = unit;
        return probe_;
    }

    /// The walk has come to this fraction of the path: if that is long, the kernels work around its point there from here on, so that
    /// errors are those of the cells' size and not of the path's length.
    void come_to(double fraction) {
        prepare();
        if (probe_.ray.direction[3] > k_far) move_to(fraction);
    }

    void move_to(double fraction) {
        prepare();
        for (std::size_t k = 0; k < 3; ++k)
            probe_.ray.origin[k] = static_cast<Scalar>(path.from[k] + fraction * (path.to[k] - path.from[k]));
        probe_.noise = static_cast<float>(rounding() * static_cast<double>(scene.scale) * 1.0001);
        probe_.ends = 0;
    }

    /// How far a point of the path may be off in each coordinate when it is rounded to the scalar: computed in double it is within 2^-50 of
    /// the largest coordinate of the exact one; rounded it moves by at most half a unit of that, or by half of the least
    /// denormal number.
    [[nodiscard]] double rounding() const {
        double furthest = 0;
        for (std::size_t k = 0; k < 3; ++k) furthest = std::max({furthest, std::abs(path.from[k]), std::abs(path.to[k])});
        return furthest * (0x1p-50 + 0.5 * static_cast<double>(std::numeric_limits<Scalar>::epsilon())) +
               static_cast<double>(std::numeric_limits<Scalar>::denorm_min());
    }

  private:
    // In units of cells. Up to here the start itself is near enough: 48 * 2^-24 * 32^2 is a few thousandths of a cell.
    static constexpr float k_far = 32;

    void prepare() {
        if (prepared_) return;
        prepared_ = true;
        probe_ = make_probe<Scalar>(scene.scale, sides_, 0);
        set_ray(path, scene.scale, probe_.ray);
    }

    Probe<Scalar> probe_;
    Sides sides_;
    bool prepared_ = false;
};

}  // namespace pierce::detail
