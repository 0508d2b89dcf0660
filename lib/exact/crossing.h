// The second rule, for counting: each crossing of a surface belongs to exactly one face, on exactly one side.
#pragma once

#include <point.h>

namespace pierce::detail {

/// +1 if the path passes through the triangle from front to back, -1 if from back to front, 0 if not.
///
/// Both ends are taken as moved by the infinitesimal vector (e, e^2, e^3), e -> 0+ (simulation of simplicity,
/// Edelsbrunner and Muecke 1990, applied to the query alone). Then no end lies on a plane and no path meets an edge or
/// a vertex, so two triangles that share an edge, by number or by coordinates, never both count a crossing of it, and
/// never neither. On a closed, consistently oriented surface the sum over its triangles is the winding number at `to`
/// less that at `from`, always. A triangle of area zero is never crossed.
[[nodiscard]] int crossing(const Path& path, const Corners& corners);

}  // namespace pierce::detail
