// Passages by rational arithmetic, one triangle after the other: a map from exact fractions to what meets there.
#pragma once

#include <map>
#include <vector>

#include <exact/crossing.h>
#include <pierce/mesh_view.h>
#include <pierce/passage.h>
#include <point.h>
#include <support/boxes.h>
#include <support/oracles.h>

namespace pierce::test {

struct ExpectedPassage {
    int crossings = 0;
    std::vector<FaceTouch> faces;  ///< in order of (face, triangle)
    std::vector<Sides> sides;      ///< of each
};

using ExpectedPassages = std::map<RationalOracle::Q, ExpectedPassage>;

/// `crossing(triangle number)`: what the face adds by another judge.
template <class Scalar, class Crossing>
ExpectedPassages expected_passages(const MeshView<Scalar>& mesh, const Segment<Scalar>& segment,
                                   const PassageOptions& options, Crossing&& crossing) {
    using Q = RationalOracle::Q;
    ExpectedPassages expected;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        detail::Corners corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = detail::to_point(mesh.positions[mesh.triangles[i][k]]);
        const detail::Path path = detail::to_path(segment);
        if (boxes_apart(path, corners)) continue;
        const RationalOracle judge(path, corners);
        if (judge.from_side() == judge.to_side()) continue;
        if (judge.fraction() < Q(0) || judge.fraction() > Q(1) || judge.fraction() > Q(options.max_fraction)) continue;
        int zeros = 0;
        std::uint8_t zero = 0;
        std::uint8_t other = 0;
        bool inside = true;
        for (std::uint8_t k = 0; k < 3; ++k) {
            if (judge.weight(k) < Q(0)) inside = false;
            if (judge.weight(k) == Q(0))
                ++zeros, zero = k;
            else
                other = k;
        }
        if (!inside) continue;
        const Sides side = judge.from_side() > judge.to_side() ? Sides::front : Sides::back;
        if (options.sides != Sides::both && options.sides != side) continue;
        const std::uint32_t face = mesh.face_of(i);
        if (!options.face_mask.empty() && (face >= options.face_mask.size() || options.face_mask[face] == 0)) continue;
        FaceTouch touch{face, i};
        touch.feature = zeros == 0 ? Feature::face : zeros == 1 ? Feature::edge : Feature::vertex;
        touch.feature_index = zeros == 0 ? std::uint8_t(0) : zeros == 1 ? std::uint8_t((zero + 1) % 3) : other;
        touch.crossing = static_cast<std::int8_t>(crossing(i));
        ExpectedPassage& passage = expected[judge.fraction()];
        passage.crossings += touch.crossing;
        passage.faces.push_back(touch);
        passage.sides.push_back(side);
    }
    return expected;
}

}  // namespace pierce::test
