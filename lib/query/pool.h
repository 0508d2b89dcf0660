// Objects that are used again once nobody holds them: what takes the memory of a mesh is not asked of the system for
// each step.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace pierce::detail {

/// Thread-safe. An object goes back when the last holder lets go of it, on that one's thread, and to the system where
/// the pool is gone or has enough.
template <class T>
class Pool {
  public:
    /// One as its last holder left it, or a new one.
    [[nodiscard]] std::shared_ptr<T> take() {
        std::unique_ptr<T> object = spare_->take();
        if (!object) object = std::make_unique<T>();
        return std::shared_ptr<T>(object.release(), [spare = spare_](T* p) { spare->give(std::unique_ptr<T>(p)); });
    }

  private:
    struct Spare {
        static constexpr std::size_t k_most = 3;
        std::mutex mutex;
        std::unique_ptr<T> objects[k_most];

        std::unique_ptr<T> take() {
            const std::lock_guard lock(mutex);
            for (std::unique_ptr<T>& object : objects)
                if (object) return std::move(object);
            return nullptr;
        }
        void give(std::unique_ptr<T> given) {
            const std::lock_guard lock(mutex);
            for (std::unique_ptr<T>& object : objects)
                if (!object) {
                    object = std::move(given);
                    return;
                }
        }
    };
    std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
};

}  // namespace pierce::detail
