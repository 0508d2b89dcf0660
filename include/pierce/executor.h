// How work is spread over threads: by whoever the caller says. The library starts no thread of its own.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace pierce {

/// A reference to work in numbered parts: `task(i)` does part i. Not owned. Parts may run at the same time; none
/// throws.
class Task {
  public:
    template <class Callable>
        requires(!std::is_same_v<std::remove_cvref_t<Callable>, Task>)
    Task(Callable&& callable)
        : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
          call_([](void* c, std::size_t part) { (*static_cast<std::remove_reference_t<Callable>*>(c))(part); }) {}

    void operator()(std::size_t part) const { call_(callable_, part); }

  private:
    void* callable_;
    void (*call_)(void*, std::size_t);
};

/// A reference to something that runs a task: `executor(parts, task)` calls `task(i)` once for each i below `parts`, in
/// any order and on any threads, and returns when all are done. Not owned. One that is empty runs the parts one after
/// another.
/// Answers don't depend on it, not in one bit. `pierce/tbb.h` has one for oneTBB.
class Executor {
  public:
    Executor() = default;
    template <class Callable>
        requires(!std::is_same_v<std::remove_cvref_t<Callable>, Executor> &&
                 std::is_invocable_v<Callable&, std::size_t, Task>)
    Executor(Callable&& callable)
        : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
          call_([](void* c, std::size_t parts, Task task) {
              (*static_cast<std::remove_reference_t<Callable>*>(c))(parts, task);
          }) {}

    explicit operator bool() const { return call_ != nullptr; }
    void operator()(std::size_t parts, Task task) const {
        if (call_ != nullptr && parts > 1) return call_(callable_, parts, task);
        for (std::size_t i = 0; i < parts; ++i) task(i);
    }

  private:
    void* callable_ = nullptr;
    void (*call_)(void*, std::size_t, Task) = nullptr;
};

}  // namespace pierce
