// Something to call, kept by value without an allocation: what `Accept` and `Executor` hold.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

/// What the compiler says of one that is not kept.
#define PIERCE_REFUSED_CALLABLE                                                                                       \
    "pierce keeps callables of up to four pointers that are trivially copyable and can be called as constants: this " \
    "one is larger, owns memory or changes; wrap it in std::ref, and keep it alive"

namespace pierce::detail {

/// Room for a lambda that captures four pointers, or references.
inline constexpr std::size_t k_callable_room = 4 * sizeof(void*);

/// Whether a callable can be copied byte by byte to that room. If not, wrap it in std::ref: then it is a reference, and
/// the object has to outlive its use.
template <class Callable>
inline constexpr bool is_small_v = sizeof(Callable) <= k_callable_room && alignof(Callable) <= alignof(void*) &&
                                   std::is_trivially_copyable_v<Callable>&& std::is_trivially_destructible_v<Callable>;

template <class Signature>
class SmallCallable;

/// Holds a copy of a small callable. It is called as a constant: copies could not agree on a state that it changes.
template <class Result, class... Arguments>
class SmallCallable<Result(Arguments...)> {
  public:
    template <class Callable>
    static constexpr bool takes = std::is_invocable_r_v<Result, const std::decay_t<Callable>&, Arguments...>;
    template <class Callable>
    static constexpr bool keeps = takes<Callable>&& is_small_v<std::decay_t<Callable>>;

    SmallCallable() = default;
    template <class Callable>
    requires keeps<Callable>
    explicit SmallCallable(const Callable& callable) {
        if constexpr (std::is_pointer_v<Callable>)
            if (callable == nullptr) return;  // a null pointer is none, as for std::function
        call_ = [](const void* room, Arguments... arguments) -> Result {
            return (*std::launder(static_cast<const std::decay_t<Callable>*>(room)))(
                static_cast<Arguments>(arguments)...);
        };
        ::new (static_cast<void*>(room_)) std::decay_t<Callable>(callable);
    }

    explicit operator bool() const { return call_ != nullptr; }
    Result operator()(Arguments... arguments) const { return call_(room_, static_cast<Arguments>(arguments)...); }

  private:
    alignas(void*) std::byte room_[k_callable_room] = {};
    Result (*call_)(const void*, Arguments...) = nullptr;
};

}  // namespace pierce::detail
