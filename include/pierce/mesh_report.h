// What is odd about a mesh, so that its owner sees whether it can keep a promise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pierce/export.h>

namespace pierce {

/// Vertices with equal coordinates count as one here, whatever their numbers: that is how queries see them. Triangles
/// of area zero are counted, and left out of the rest. Lists hold the first `k_examples` cases.
struct MeshReport {
    static constexpr std::size_t k_examples = 8;          ///< the length of lists, at most
    static constexpr std::size_t k_most_around_edge = 8;  ///< the last place of `edges_with`
    using Edge = std::array<std::uint32_t, 2>;            ///< numbers of positions

    std::size_t zero_area = 0;              ///< triangles: they are never hit
    std::size_t duplicates = 0;             ///< triangles with the same corners as one before, either way round
    std::size_t border_edges = 0;           ///< edges with one triangle: a particle can get through beside them
    std::size_t non_manifold_edges = 0;     ///< edges with more than two
    std::size_t misoriented_edges = 0;      ///< edges, not borders, that more triangles follow one way than the other
    std::size_t non_manifold_vertices = 0;  ///< vertices whose triangles fall into several fans that share no edge
    std::size_t t_junctions = 0;            ///< border vertices in the middle of a border edge, or within rounding
    std::size_t components = 0;             ///< sets of triangles joined by edges
    /// `edges_with[n]`: edges that n triangles share; the last place counts those with `k_most_around_edge` and more,
    /// the place 0 is 0. A manifold without borders has edges in place 2 only. Where walls meet, or cells share their
    /// faces, edges with three and more are as they should be. `closed()` allows them if as many triangles follow the
    /// edge one way as the other, so never with an odd number.
    std::array<std::size_t, k_most_around_edge + 1> edges_with{};

    std::vector<std::uint32_t> zero_area_triangles;       ///< places in `MeshView::triangles`, as in the next list
    std::vector<std::uint32_t> duplicate_triangles;       ///< each a repetition of one before
    std::vector<Edge> border_edge_list;                   ///< edges with one triangle
    std::vector<Edge> non_manifold_edge_list;             ///< edges with more than two
    std::vector<Edge> misoriented_edge_list;              ///< edges that more triangles follow one way
    std::vector<std::uint32_t> non_manifold_vertex_list;  ///< numbers of positions, as in the next list
    std::vector<std::uint32_t> t_junction_list;           ///< border vertices within a border edge

    /// No edge has more triangles on one side than on the other: then the surface has an inside, `crossings` add up,
    /// and no particle gets from one side to the other without a hit.
    [[nodiscard]] bool closed() const { return border_edges == 0 && misoriented_edges == 0; }

    /// A few lines for people.
    [[nodiscard]] PIERCE_EXPORT std::string to_string() const;
};

}  // namespace pierce
