// The caller's executor for work of the library: its threads have floating-point environments of their own, and no use
// for what is thrown when memory runs out.
#pragma once

#include <atomic>
#include <exception>
#include <functional>

#include <environment.h>
#include <pierce/executor.h>

namespace pierce::detail {

/// Has to live as long as `executor()` is used.
class StandardExecutor {
  public:
    explicit StandardExecutor(const Executor& given) : given_(given) {}
    StandardExecutor(const StandardExecutor&) = delete;
    StandardExecutor& operator=(const StandardExecutor&) = delete;

    /// Empty where the caller's is.
    [[nodiscard]] Executor executor() const { return given_ ? Executor(std::cref(*this)) : Executor(); }

    /// What a task throws is thrown again when all are done.
    void operator()(std::size_t parts, Task task) const {
        std::atomic_flag failed;
        std::exception_ptr failure;
        given_(parts, [&](std::size_t part) {
            const StandardArithmetic standard;
            try {
                task(part);
            } catch (...) {
                if (!failed.test_and_set()) failure = std::current_exception();
            }
        });
        if (failure) std::rethrow_exception(failure);
    }

  private:
    const Executor& given_;
};

}  // namespace pierce::detail
