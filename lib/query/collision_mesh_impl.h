// What is behind the façade.
#pragma once

#include <atomic>
#include <memory>

#include <pierce/collision_mesh.h>
#include <query/rebuild.h>
#include <query/refit.h>
#include <query/ways.h>

namespace pierce {

template <class Scalar>
struct CollisionMesh<Scalar>::Impl {
    detail::Scene<Scalar> scene;
    /// Of what the mesh was built with: what a grid that is made again needs.
    BuildOptions options;
    /// From the first refit on, until the mesh is built anew.
    std::unique_ptr<detail::Refit<Scalar>> refit;
    /// What rebuilds know of clusters, as long as there is no refit.
    detail::KeptClusters kept;
    mutable std::atomic<std::uint64_t> invalid_queries = 0;

    /// What meshes share that were not built, or are moved from. It has no triangle, and counts nothing.
    static Impl& not_built() noexcept;
    [[nodiscard]] bool built() const noexcept { return this != &not_built(); }

    /// Whether what is asked about, a point, a segment or a ray, has a meaning; what has none is counted.
    template <class Asked>
    bool valid(const Asked& asked) const {
        if (detail::is_valid(asked)) return true;
        count_invalid(1);
        return false;
    }
    void count_invalid(std::uint64_t count) const {
        if (count > 0 && built()) invalid_queries.fetch_add(count, std::memory_order_relaxed);
    }
};

}  // namespace pierce
