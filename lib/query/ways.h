// What queries go along, as paths: a segment, a ray, or the segments or rays of a batch.
#pragma once

#include <pierce/batch.h>
#include <pierce/ray.h>
#include <point.h>
#include <query/ray_path.h>

namespace pierce::detail {

/// False: nothing can be hit. `most`: the largest parameter that counts.
template <class Scalar>
[[nodiscard]] bool set_path(const Scene<Scalar>&, const Segment<Scalar>& segment, double most, Path& path) {
    path = to_path(segment, most);
    return true;
}
template <class Scalar>
[[nodiscard]] bool set_path(const Scene<Scalar>& scene, const Ray<Scalar>& ray, double most, Path& path) {
    return set_ray_path(scene.bounds, to_point(ray.origin), to_point(ray.direction), static_cast<double>(ray.limit),
                        most, sizeof(Scalar) == sizeof(float), path);
}

/// x - x is 0 for a number and NaN for what is none; one branch for all of them.
template <class... Points>
[[nodiscard]] bool are_finite(const Points&... points) {
    const auto zero = [](const auto& p) { return (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]); };
    return (zero(points) + ...) == 0;
}

/// Where a query starts.
template <class Scalar>
[[nodiscard]] Point start_of(const Segment<Scalar>& segment) {
    return to_point(segment.from);
}
template <class Scalar>
[[nodiscard]] Point start_of(const Ray<Scalar>& ray) {
    return to_point(ray.origin);
}

/// Whether what is asked about has a meaning: a point, a segment or a ray.
template <class Scalar>
[[nodiscard]] bool is_valid(const Vec3<Scalar>& point) {
    return are_finite(point);
}
template <class Scalar>
[[nodiscard]] bool is_valid(const Segment<Scalar>& segment) {
    return are_finite(segment.from, segment.to);
}
template <class Scalar>
[[nodiscard]] bool is_valid(const Ray<Scalar>& ray) {
    return are_finite(ray.origin, ray.direction) && ray.limit >= 0;
}

/// Those of a batch; refers to the view that it is made from.
template <class Scalar>
class Ways {
  public:
    Ways(const Segments<Scalar>& segments) : segments_(&segments) {}
    Ways(const Rays<Scalar>& rays) : rays_(&rays) {}

    [[nodiscard]] std::size_t size() const { return segments_ != nullptr ? segments_->size() : rays_->size(); }
    /// Calls `use` with segment or ray number i.
    template <class Use>
    decltype(auto) with(std::size_t i, Use&& use) const {
        return segments_ != nullptr ? use((*segments_)[i]) : use((*rays_)[i]);
    }
    [[nodiscard]] bool is_valid(std::size_t i) const {
        return with(i, [](const auto& way) { return detail::is_valid(way); });
    }
    /// The path of a valid one, as above.
    [[nodiscard]] bool set_path(const Scene<Scalar>& scene, std::size_t i, double most, Path& path) const {
        return with(i, [&](const auto& way) { return detail::set_path(scene, way, most, path); });
    }

  private:
    const Segments<Scalar>* segments_ = nullptr;
    const Rays<Scalar>* rays_ = nullptr;
};

}  // namespace pierce::detail
