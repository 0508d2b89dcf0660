// The inexact twin's narrow phase with AVX2, compiled with the flags of the library's narrow_fused.cpp.
#include <bench/exactness_twin.h>
#include <kernel/fused.h>
// fused.h first: the table is of its vectors.
#include <bench/exactness_twin_table.h>

namespace pierce::detail {

constinit const Narrow k_trusting_fused = trusting_of<OneRegister>();

}  // namespace pierce::detail
