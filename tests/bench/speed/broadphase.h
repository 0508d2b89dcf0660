// The second broadphase, the uniform grid, for the columns beside the default.
#pragma once

#include <optional>

#include <pierce/options.h>

namespace pierce::bench {

/// Nothing, as long as the library has only one broadphase. A template, so that what is not there need not compile.
template <class Options = BuildOptions>
std::optional<Options> grid_options() {
    if constexpr (requires(Options options) { options.broadphase; }) {
        Options options;
        options.broadphase = decltype(options.broadphase)::grid;
        return options;
    } else {
        return std::nullopt;
    }
}

}  // namespace pierce::bench
