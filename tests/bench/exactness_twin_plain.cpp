// The inexact twin's narrow phase of any machine.
#include <bench/exactness_twin.h>
#include <bench/exactness_twin_table.h>

namespace pierce::detail {

constinit const Narrow k_trusting = trusting_of<TwoPairs>();

}  // namespace pierce::detail
