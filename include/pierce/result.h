// For programs without exceptions, and for interfaces that none may cross: what could not be done, as a number and a
// line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <pierce/export.h>

namespace pierce {

/// Why something could not be done. The numbers stay what they are.
enum class Status : std::uint8_t {
    ok = 0,             ///< it was done
    bad_mesh = 1,       ///< where `MeshError` is thrown otherwise: the mesh can't be used
    bad_file = 2,       ///< the same for a file: it can't be read, or holds no mesh that can be used
    bad_argument = 3,   ///< where std::invalid_argument is thrown: an option without a meaning, sizes that don't fit
    out_of_memory = 4,  ///< where std::bad_alloc is thrown
    failed = 5,         ///< anything else, from the caller's executor or the system
};

/// A few words for people.
[[nodiscard]] PIERCE_EXPORT std::string_view to_string(Status status) noexcept;

/// What was asked for, or why there is none: `value` is empty then, and `message` what the exception would have said.
template <class Value>
struct [[nodiscard]] Result {
    Value value;                 ///< what was asked for; empty, as default-made, where there is none
    Status status = Status::ok;  ///< whether there is one, and why not
    std::string message = {};    ///< one line; empty where all is well

    /// Whether `value` is what was asked for.
    [[nodiscard]] explicit operator bool() const noexcept { return status == Status::ok; }
};

}  // namespace pierce
