// Tells packed files by their first bytes, so that a reader says so instead of what it failed to read there.
#pragma once

#include "mesh/read_source.h"

namespace pierce::detail {

/// Refuses a file that begins like a packed one. A binary STL may begin with any bytes: its size is looked at first.
void refuse_packed(const SourceFile& file);

}  // namespace pierce::detail
