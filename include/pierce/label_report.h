// Labels of faces, and where they disagree.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pierce/export.h>

namespace pierce {

/// The regions on the two sides of a face: numbers of the caller's choice.
struct FaceRegions {
    std::uint32_t front = 0;   ///< the side that sees its corners counter-clockwise
    std::uint32_t behind = 0;  ///< the other side

    friend bool operator==(const FaceRegions&, const FaceRegions&) = default;
};

/// Where labels disagree: two faces next to one another around an edge, with different regions between them. The two
/// are one face where an edge has no other: then it has different regions on its sides, which meet around that edge.
///
/// Edges are those of equal coordinates, as in `MeshReport`; triangles of area zero are left out. Faces that coincide
/// agree if there is an order of them that does.
///
/// **Faces must not pass through each other**: they may meet at edges and vertices they share, and coincide. Where two
/// volumes overlap, faces cross away from all edges. The labels agree around each edge then, and not in space. That is
/// not looked for; a flight through such a place shows it by a leg that is not consistent (`Leg::consistent`).
struct LabelReport {
    static constexpr std::size_t k_examples = 8;  ///< the length of lists, at most

    /// Two faces, or the two sides of one, and what they say.
    struct Disagreement {
        std::array<std::uint32_t, 2> edge;     ///< numbers of positions
        std::array<std::uint32_t, 2> faces;    ///< the caller's, the first one's side towards the second
        std::array<std::uint32_t, 2> regions;  ///< what they say is between them
    };

    std::size_t edges = 0;     ///< at which faces disagree
    std::size_t floating = 0;  ///< parts that share no edge with others and lie in another region than they say
    std::vector<Disagreement> edge_list;      ///< the first ones
    std::vector<Disagreement> floating_list;  ///< the first ones: `edge` is a vertex of the part, twice

    /// If no faces pass through each other: every point of space has one region, whatever face it is seen from, and no
    /// flight comes to a leg that is not consistent.
    [[nodiscard]] bool agree() const { return edges == 0 && floating == 0; }

    /// A few lines for people.
    [[nodiscard]] PIERCE_EXPORT std::string to_string() const;
};

}  // namespace pierce
