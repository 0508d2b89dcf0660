// The triangles that a point or a passage lies on, as the caller gets them.
#pragma once

#include <decision.h>
#include <pierce/location.h>
#include <query/scene.h>

namespace pierce::detail {

[[nodiscard]] inline bool comes_before(const FaceTouch& x, const FaceTouch& y) {
    return x.face != y.face ? x.face < y.face : x.triangle < y.triangle;
}

template <class Scalar>
[[nodiscard]] FaceTouch touch_of(const Scene<Scalar>& scene, TriangleRef triangle, const Decision& decision,
                                 int crossing) {
    const std::uint32_t number = scene.number_of(triangle);
    return {scene.face_of_number(number), number, decision.feature, decision.feature_index,
            static_cast<std::int8_t>(crossing)};
}

}  // namespace pierce::detail
