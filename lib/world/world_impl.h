// What is behind the façade of worlds.
#pragma once

#include <atomic>

#include <pierce/world.h>
#include <world/instances.h>

namespace pierce {

template <class Scalar>
struct World<Scalar>::Impl {
    detail::WorldScene<Scalar> scene;
    mutable std::atomic<std::uint64_t> invalid_queries = 0;

    template <class Asked>
    bool valid(const Asked& asked) const {
        if (detail::is_valid(asked)) return true;
        count_invalid(1);
        return false;
    }
    void count_invalid(std::uint64_t count) const {
        if (count > 0) invalid_queries.fetch_add(count, std::memory_order_relaxed);
    }
};

}  // namespace pierce
