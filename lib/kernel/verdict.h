// What the filter says of a triangle and a path.
#pragma once

#include <decision.h>

namespace pierce::detail {

enum class Verdict : std::uint8_t { miss, doubtful, hit };

struct Filtered {
    Verdict verdict;
    /// For a hit.
    Decision decision = {};
    /// An interval that contains the exact fraction of the line, for a hit and for what is doubtful.
    double earliest = 0;
    double latest = 1;
};

}  // namespace pierce::detail
