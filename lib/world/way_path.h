// What a world's query goes along, as a path in the world.
#pragma once

#include <query/ray_path.h>
#include <world/instances.h>

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] bool set_path(const WorldScene<Scalar>&, const Segment<Scalar>& segment, double most, Path& path) {
    path = to_path(segment, most);
    return true;
}

/// A ray's path has one length for all meshes, so that fractions of it can be compared: it ends beyond the box of all.
///
/// Images must end beyond each mesh's own box as well. The way's end is past the box by `m` along an axis. Along each
/// axis the way is at most four times what is from the origin to the box's far side (ray_path.cpp), so P <= 9 largest,
/// with the largest sum of |coordinates| of origin and box, bounds origin and way, and images are off by less than the
/// noise's part of that (placement.h): 16 are allowed.
template <class Scalar>
[[nodiscard]] bool set_path(const WorldScene<Scalar>& world, const Ray<Scalar>& ray, double most, Path& path) {
    if (world.tree.root() == BoxTree::k_none) return false;
    const BoxTree::Node& all = world.tree.node(world.tree.root());
    const Point origin = to_point(ray.origin);
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max(
            {largest, std::abs(origin[k]) + std::abs(all.low[k]), std::abs(origin[k]) + std::abs(all.high[k])});
    const double m = static_cast<double>(all.slack) + 16 * (world.noise() + k_box_slack) * largest;
    Box bounds{all.low, all.high};
    for (std::size_t k = 0; k < 3; ++k) {
        bounds.low[k] = std::max(bounds.low[k] - m, -std::numeric_limits<double>::max());
        bounds.high[k] = std::min(bounds.high[k] + m, std::numeric_limits<double>::max());
    }
    return set_ray_path(bounds, origin, to_point(ray.direction), static_cast<double>(ray.limit), most,
                        sizeof(Scalar) == sizeof(float), path);
}

}  // namespace pierce::detail
