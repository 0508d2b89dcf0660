// Which wide kernels there are, and which of them this machine runs.
#pragma once

#include <string_view>
#include <vector>

#include <kernel/backend.h>

namespace pierce::detail {

/// Those that this machine runs, the fastest first. Never empty.
[[nodiscard]] const std::vector<const Backend*>& backends();

/// The backend of that name; for an empty name the one that the environment variable PIERCE_BACKEND names, and without
/// that the fastest. Throws std::invalid_argument, naming those there are, when this machine has none of that name.
[[nodiscard]] const Backend& choose_backend(std::string_view name);

}  // namespace pierce::detail
