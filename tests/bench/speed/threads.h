// Threads for pierce: an executor with a given number of those of oneTBB, as most users will have it, and builds with it.
#pragma once

#include <memory>

#include <tbb/task_arena.h>

#include <pierce/collision_mesh.h>
#include <pierce/tbb.h>

namespace pierce::bench {

/// They are kept from one call to the next.
class Threads {
  public:
    explicit Threads(unsigned count) : arena_(std::make_unique<tbb::task_arena>(static_cast<int>(count))) {}
    void operator()(std::size_t parts, Task task) const {
        arena_->execute([&] { tbb_executor()(parts, task); });
    }

  private:
    std::unique_ptr<tbb::task_arena> arena_;
};

template <class Scalar>
CollisionMesh<Scalar> build(const MeshView<Scalar>& mesh, unsigned threads) {
    const Threads executor(threads);
    return CollisionMesh<Scalar>(mesh, {.executor = threads > 1 ? Executor(executor) : Executor()});
}

}  // namespace pierce::bench
