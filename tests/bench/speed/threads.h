// Threads for pierce: an executor that uses a given number of them, started anew for each call, and builds with it.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include <pierce/collision_mesh.h>

namespace pierce::bench {

/// Parts go to whichever thread is free.
class Threads {
  public:
    explicit Threads(unsigned count) : count_(count) {}
    void operator()(std::size_t parts, Task task) const {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < parts; i = next++) task(i);
        };
        std::vector<std::thread> others;
        for (unsigned t = 1; t < count_; ++t) others.emplace_back(work);
        work();
        for (std::thread& other : others) other.join();
    }

  private:
    unsigned count_;
};

template <class Scalar>
CollisionMesh<Scalar> build(const MeshView<Scalar>& mesh, unsigned threads) {
    const Threads executor(threads);
    return CollisionMesh<Scalar>(mesh, {.executor = threads > 1 ? Executor(executor) : Executor()});
}

}  // namespace pierce::bench
