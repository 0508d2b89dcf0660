// How work is spread over threads: by whoever the caller says. The library starts no thread of its own.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#include <pierce/small_callable.h>

namespace pierce {

/// A reference to work in numbered parts: `task(i)` does part i. Not owned. Parts may run at the same time; none
/// throws.
class Task {
  public:
    /// Refers to a callable that takes the number of a part, and has to outlive the task.
    template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, Task>) Task(Callable&& callable)
        : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
          call_([](void* c, std::size_t part) { (*static_cast<std::remove_reference_t<Callable>*>(c))(part); }) {}

    /// Does one part.
    void operator()(std::size_t part) const { call_(callable_, part); }

  private:
    void* callable_;
    void (*call_)(void*, std::size_t);
};

/// Something that runs a task: `executor(parts, task)` calls `task(i)` once for each i below `parts`, in any order and
/// on any threads, and returns when all are done. One that is empty runs the parts one after another. Answers don't
/// depend on it, not in one bit. `pierce/tbb.h` has one for oneTBB.
///
/// It keeps what it is made of: a function pointer, or a lambda or other object of up to four pointers that is copied
/// byte by byte and does not change when it is called. What is larger, owns memory or changes is refused by the
/// compiler unless it is wrapped in `std::ref`; then it has to live as long as the executor is used.
class Executor {
    using Kept = detail::SmallCallable<void(std::size_t, Task)>;

  public:
    Executor() = default;
    /// Keeps a copy of a callable.
    template <class Callable>
    requires(Kept::keeps<Callable>) Executor(const Callable& callable) : kept_(callable) {}
    /// Refuses what can't be kept, and says what to do.
    template <class Callable>
    requires(!Kept::keeps<Callable> && std::is_invocable_v<Callable&, std::size_t, Task>) Executor(const Callable&) {
        static_assert(Kept::template keeps<Callable>, PIERCE_REFUSED_CALLABLE);
    }

    /// Whether there is one: without one the caller's thread does all parts.
    explicit operator bool() const { return static_cast<bool>(kept_); }
    /// Does all parts of a task, and returns when they are done.
    void operator()(std::size_t parts, Task task) const {
        if (kept_ && parts > 1) return kept_(parts, task);
        for (std::size_t i = 0; i < parts; ++i) task(i);
    }

  private:
    Kept kept_;
};

}  // namespace pierce
