// What is behind the façade.
#pragma once

#include <atomic>
#include <cmath>

#include <pierce/collision_mesh.h>
#include <query/scene.h>

namespace pierce {

template <class Scalar>
struct CollisionMesh<Scalar>::Impl {
    detail::Scene<Scalar> scene;
    mutable std::atomic<std::uint64_t> invalid_queries = 0;

    /// What meshes share that were not built, or are moved from. It has no triangle, and counts nothing.
    static Impl& not_built() noexcept;
    [[nodiscard]] bool built() const noexcept { return this != &not_built(); }

    // Whether a query has a meaning; one with a coordinate that is not finite is counted.
    template <class... Points>
    bool finite(const Points&... points) const {
        // x - x is 0 for a number and NaN for what is none; one branch for all of them.
        const auto zero = [](const auto& p) { return (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]); };
        if ((zero(points) + ...) == 0) return true;
        count_invalid(1);
        return false;
    }
    void count_invalid(std::uint64_t count) const {
        if (count > 0 && built()) invalid_queries.fetch_add(count, std::memory_order_relaxed);
    }
    bool valid(const Ray<Scalar>& ray) const {
        if (!finite(ray.origin, ray.direction)) return false;
        if (ray.limit >= 0) return true;
        count_invalid(1);
        return false;
    }
};

}  // namespace pierce
