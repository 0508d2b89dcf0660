// A segment or ray much longer than the scene, cut down to what may touch it.
#pragma once

#include <node.h>

namespace pierce::detail {

struct Clipped {
    // The parameter t, from 0 to 1 over what is left, is the fraction begin + t * length of the whole.
    double begin;
    double length;
    // In scene units, relative to Frame::low, and how far off these may be.
    double origin[3];
    double direction[3];
    double noise;
    // The same in the caller's units.
    double start[3];
    double way[3];
};

/// False: nothing is left. `ray`: `to` is the way from `from` to the end.
[[nodiscard]] bool clip(const Frame& frame, const double* from, const double* to, bool ray, Clipped& clipped);

}  // namespace pierce::detail
