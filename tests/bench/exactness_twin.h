// The narrow phase of the inexact twin in exactness_bench.cpp: signs of doubles are final, nothing has an error.
#pragma once

#include <kernel/narrow.h>

namespace pierce::detail {

extern const Narrow k_trusting;
extern const Narrow k_trusting_fused;

}  // namespace pierce::detail
