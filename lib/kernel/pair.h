// Two doubles in one register of any machine: what is the same for two numbers is computed once. Made of the vector
// types of GCC and Clang, so that it says nothing of an instruction set: the flags of the file that includes it do.
#pragma once

namespace pierce::detail {

typedef double Pair __attribute__((vector_size(16)));
typedef long long PairMask __attribute__((vector_size(16)));

[[nodiscard]] [[gnu::always_inline]] inline Pair both(double x) { return Pair{x, x}; }
[[nodiscard]] [[gnu::always_inline]] inline Pair swapped(Pair x) { return __builtin_shufflevector(x, x, 1, 0); }
[[nodiscard]] [[gnu::always_inline]] inline Pair magnitude_of(Pair x) {
    return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(x) & PairMask{0x7fffffffffffffff, 0x7fffffffffffffff});
}
[[nodiscard]] [[gnu::always_inline]] inline double magnitude_of(double x) { return __builtin_fabs(x); }

}  // namespace pierce::detail
