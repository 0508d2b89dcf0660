// Values in twice the precision on any machine.
#include <kernel/refine.h>

namespace pierce::detail {

namespace {

void refine(const Measured& bars, Values& values) { refine_with<Dekker>(bars, values); }

}  // namespace

constinit const Refine k_refine = refine;

}  // namespace pierce::detail
