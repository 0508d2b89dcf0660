// A scene with labels: what the queries of regions read.
#pragma once

#include <pierce/label_report.h>
#include <query/scene.h>

namespace pierce::detail {

/// No triangle: a record has eight lanes at most.
inline constexpr TriangleRef k_nowhere{0, 255};

template <class Scalar>
struct RegionScene {
    const Scene<Scalar>& scene;
    std::vector<FaceRegions> labels;  ///< of the caller's faces
    RawArray<TriangleRef> where;      ///< of each triangle; `k_nowhere` for those of area zero
    std::uint32_t outside = 0;

    /// On the side that a path comes from which crosses the triangle with this sign (crossing.h).
    [[nodiscard]] std::uint32_t near(TriangleRef triangle, int sign) const {
        const FaceRegions& label = labels[scene.face_of(triangle)];
        return sign > 0 ? label.front : label.behind;
    }
    [[nodiscard]] std::uint32_t far(TriangleRef triangle, int sign) const { return near(triangle, -sign); }
};

}  // namespace pierce::detail
