// Which wide kernels there are, and which of them this machine runs.
#pragma once

#include <string_view>
#include <vector>

#include <kernel/backend.h>

namespace pierce::detail {

#if defined(__x86_64__)
extern const Backend k_sse2;
extern const Backend k_avx2;
extern const Backend k_avx512;
#elif defined(__aarch64__)
extern const Backend k_neon;
#endif
extern const Backend k_plain;

/// Those that this machine runs, the fastest first. Never empty.
[[nodiscard]] const std::vector<const Backend*>& backends();

/// The one of that name; for an empty name what the environment variable PIERCE_BACKEND says, and without that the fastest. Throws
/// std::invalid_argument, naming those there are, when this machine has none of the name.
[[nodiscard]] const Backend& choose_backend(std::string_view name);

}  // namespace pierce::detail
