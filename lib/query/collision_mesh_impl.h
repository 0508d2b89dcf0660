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

    // Whether a query has a meaning; one with a coordinate that is not finite is counted.
    template <class... Points>
    bool finite(const Points&... points) const {
        // x - x is 0 for a number and NaN for what is none; one branch for all of them.
        const auto zero = [](const auto& p) { return (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]); };
        if ((zero(points) + ...) == 0) return true;
        invalid_queries.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    bool valid(const Ray<Scalar>& ray) const {
        if (!finite(ray.origin, ray.direction)) return false;
        if (ray.limit >= 0) return true;
        invalid_queries.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
};

}  // namespace pierce
