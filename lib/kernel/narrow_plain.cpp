// The narrow phase of any machine.
#include <kernel/narrow_table.h>

namespace pierce::detail {

constinit const Narrow k_narrow = narrow_of<TwoPairs>();

}  // namespace pierce::detail
