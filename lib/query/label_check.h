// Whether the labels of faces agree.
#pragma once

#include <query/region_scene.h>

namespace pierce::detail {

/// Not inlined: see engine.h.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] LabelReport check_labels(const RegionScene<Scalar>& regions);

}  // namespace pierce::detail
