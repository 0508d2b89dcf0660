// A segment on its way through the rooms: what the grid and the kernels need of it, computed once.
#pragma once

#include <cmath>
#include <limits>

#include <grid/grid.h>
#include <query/scene.h>

namespace pierce::detail {

/// Room behind a list of ids that the kernels may write to.
constexpr unsigned k_beyond_ids = 8;

/// Ids that a few cells leave. In whole cache lines, as the first few are written many at a time and read one by one at once.
constexpr unsigned k_room = 256;
struct alignas(64) Ids : std::array<std::uint32_t, k_room + k_beyond_ids> {};

/// What the wide kernels left of the triangles that a query came near: if `complete`, all that could stop a point on its way to a point of
/// the path, rounded. So the verified point needs no second way through the grid and the kernels.
struct Shortlist {
    void add(const std::uint32_t* some, unsigned number) {
        complete = complete && count + number <= ids.size();
        if (!complete) return;
        for (unsigned i = 0; i < number; ++i) ids[count + i] = some[i];
        count += number;
    }

    std::array<std::uint32_t, 64> ids;
    unsigned count = 0;
    bool complete = true;
};

/// How far a point of the path may be off in each coordinate when it is rounded to the scalar: computed in double it is within 2^-50 of
/// the largest coordinate of the exact one; rounded it moves by at most half a unit of that, or by half of the least denormal number,
/// which is half a unit of the least normal one.
template <class Scalar>
[[nodiscard]] double rounding(const Path& path) {
    double furthest = static_cast<double>(std::numeric_limits<Scalar>::min());
    for (std::size_t k = 0; k < 3; ++k) furthest = std::max({furthest, std::abs(path.from[k]), std::abs(path.to[k])});
    return furthest * (0x1p-50 + 0.5 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
}

/// As the kernels take it: twice, as the origin of a ray may be off as well; the last factor is for what rounds here.
template <class Scalar>
[[nodiscard]] float noise_of(const Path& path, float scale) {
    return static_cast<float>(rounding<Scalar>(path) * (static_cast<double>(scale) * 2.0002));
}

/// What the wide kernels ask of a segment around its start, but for the ray.
template <class Scalar>
[[nodiscard]] Probe<Scalar> make_probe(float scale, Sides sides, float unit) {
    Probe<Scalar> probe;
    probe.scale = scale;
    probe.ends = 1;
    probe.unit = unit;
    probe.front = sides != Sides::back ? ~0U : 0U;
    probe.back = sides != Sides::front ? ~0U : 0U;
    return probe;
}

/// Around its start.
template <class Scalar>
void set_ray(const Path& path, float scale, Ray<Scalar>& ray) {
    for (std::size_t k = 0; k < 3; ++k) {
        ray.origin[k] = static_cast<Scalar>(path.from[k]);
        ray.direction[k] = static_cast<float>((path.to[k] - path.from[k]) * static_cast<double>(scale));
    }
    ray.origin[3] = 0;
    ray.direction[3] = noise_of<Scalar>(path, scale);
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
        const float* d = probe_.ray.direction;
        if (std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > k_far) move_to(fraction);
    }

    void move_to(double fraction) {
        prepare();
        for (std::size_t k = 0; k < 3; ++k)
            probe_.ray.origin[k] = static_cast<Scalar>(path.from[k] + fraction * (path.to[k] - path.from[k]));
        probe_.ends = 0;
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
