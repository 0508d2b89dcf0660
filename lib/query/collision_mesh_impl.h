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
        const auto all = [](const auto& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); };
        if ((all(points) && ...)) return true;
        invalid_queries.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
};

}  // namespace pierce
