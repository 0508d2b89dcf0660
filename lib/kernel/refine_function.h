// Values in twice the precision, as the table of kernels names them; refine.h says what they are.
#pragma once

namespace pierce::detail {

struct Measured;
struct Values;

/// The same bits on every machine.
using Refine = void (*)(const Measured& bars, Values& values);
// One for each file refine_*.cpp.
extern const Refine k_refine;
extern const Refine k_refine_fused;

}  // namespace pierce::detail
