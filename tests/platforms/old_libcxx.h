// What the library uses of C++20 and libc++ 13 lacks, which is the one of Debian's Emscripten. Included before all else
// there, and nowhere else.
#pragma once

#ifdef __cplusplus
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>
#include <type_traits>
#include <version>

namespace std {
#if !defined(__cpp_lib_bit_cast)
template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}
#endif

#if !defined(__cpp_lib_atomic_ref)
// With the names of the one thread that there is.
template <class T>
class atomic_ref {
  public:
    explicit atomic_ref(T& x) : x_(x) {}
    T fetch_add(T by, ...) const noexcept { return __atomic_fetch_add(&x_, by, __ATOMIC_RELAXED); }
    T fetch_sub(T by, ...) const noexcept { return __atomic_fetch_sub(&x_, by, __ATOMIC_RELAXED); }

  private:
    T& x_;
};
#endif

#if !defined(__cpp_lib_smart_ptr_for_overwrite)
template <class T>
[[nodiscard]] unique_ptr<T> make_unique_for_overwrite(size_t size) {
    return unique_ptr<T>(new remove_extent_t<T>[size]);
}
#endif

#if !defined(__cpp_lib_jthread)
class jthread : public thread {
  public:
    using thread::thread;
    jthread(jthread&&) = default;
    ~jthread() {
        if (joinable()) join();
    }
};
#endif

// libc++ 13 writes whole numbers only: the fewest digits that read back the same.
inline to_chars_result to_chars(char* first, char* last, double x) {
    for (int digits = 1;; ++digits) {
        const int length = snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, x);
        if (digits == 17 || strtod(first, nullptr) == x) return {first + length, errc()};
    }
}
}  // namespace std
#endif
