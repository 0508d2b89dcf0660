// The version of these headers, in C and C++. CMakeLists.txt reads it here, so that there is only one.
#pragma once

/// A new one may break programs.
#define PIERCE_VERSION_MAJOR 0
/// A new one adds; before 1.0 it may break programs too.
#define PIERCE_VERSION_MINOR 2
/// A new one mends.
#define PIERCE_VERSION_PATCH 0

/// One number to compare with: 1.2.3 is 10203.
#define PIERCE_VERSION (PIERCE_VERSION_MAJOR * 10000 + PIERCE_VERSION_MINOR * 100 + PIERCE_VERSION_PATCH)

// A macro's value as text takes two steps.
#define PIERCE_TEXT_OF(value) #value
#define PIERCE_TEXT(value) PIERCE_TEXT_OF(value)

#if defined(__cplusplus) && __cplusplus >= 201703L
#include <string_view>

namespace pierce {

/// "major.minor.patch".
inline constexpr std::string_view version =
    PIERCE_TEXT(PIERCE_VERSION_MAJOR) "." PIERCE_TEXT(PIERCE_VERSION_MINOR) "." PIERCE_TEXT(PIERCE_VERSION_PATCH);

}  // namespace pierce
#endif
