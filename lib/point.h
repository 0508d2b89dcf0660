// From the caller's points to the core's.
#pragma once

#include <path.h>
#include <pierce/types.h>

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] Point to_point(const Vec3<Scalar>& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

template <class Scalar>
[[nodiscard]] Path to_path(const Segment<Scalar>& segment) {
    return {.from = to_point(segment.from), .to = to_point(segment.to)};
}
template <class Scalar>
[[nodiscard]] Path to_path(const Segment<Scalar>& segment, double max_fraction) {
    Path path = to_path(segment);
    path.most = max_fraction;
    return path;
}

}  // namespace pierce::detail
