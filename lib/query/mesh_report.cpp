// What is odd about a mesh: equal vertices merged, the triangles around each looked at, the border's vertices looked up
// along the border's edges. And the report as text.
#include <query/mesh_report.h>

#include <sstream>

#include <query/merge_equal.h>
#include <query/vertex_fans.h>

namespace pierce {

namespace detail {

MeshReport report_on(std::span<const Point> positions, std::span<const IndexTriple> triangles,
                     std::span<const std::uint32_t> degenerate, double epsilon, TJunctionCounters& counters) {
    MeshReport report;
    const std::vector<std::uint32_t> same = merge_equal(positions);
    RawArray<IndexTriple> merged(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) merged[i][k] = same[triangles[i][k]];
    for (const std::uint32_t i : degenerate) {
        note(report.zero_area, report.zero_area_triangles, i);
        merged[i].fill(0);
    }
    VertexFans fans({merged.data(), merged.size()}, positions.size());
    const std::vector<MeshReport::Edge> border = fans.look(report);
    for (const std::uint32_t v : t_junctions(positions, border, epsilon, counters))
        note(report.t_junctions, report.t_junction_list, v);
    return report;
}

}  // namespace detail

std::string MeshReport::to_string() const {
    std::ostringstream out;
    if (components == 0)
        out << "empty: no triangle that could be hit\n";
    else
        out << (closed() ? "closed: nothing gets through" : "not closed: a particle can get through") << "; "
            << components << (components == 1 ? " component\n" : " components\n");
    const auto line = [&](std::size_t count, const char* what, const auto& list, const auto& print) {
        if (count == 0) return;
        out << "  " << count << ' ' << what << ':';
        for (const auto& example : list) print(example);
        out << (list.size() < count ? " ...\n" : "\n");
    };
    const auto number = [&](std::uint32_t n) { out << ' ' << n; };
    const auto edge = [&](const Edge& e) { out << ' ' << e[0] << '-' << e[1]; };
    line(zero_area, "triangles of zero area", zero_area_triangles, number);
    line(duplicates, "duplicate triangles", duplicate_triangles, number);
    line(border_edges, "border edges", border_edge_list, edge);
    line(non_manifold_edges, "edges of more than two triangles", non_manifold_edge_list, edge);
    if (non_manifold_edges > 0) {
        out << "  edges by their number of triangles:";
        for (std::size_t n = 1; n <= k_most_around_edge; ++n)
            if (edges_with[n] > 0) out << "  " << n << (n == k_most_around_edge ? " or more: " : ": ") << edges_with[n];
        out << '\n';
    }
    line(misoriented_edges, "edges whose triangles do not face the same way", misoriented_edge_list, edge);
    line(non_manifold_vertices, "vertices where several fans touch", non_manifold_vertex_list, number);
    line(t_junctions, "T-junctions, vertices", t_junction_list, number);
    return out.str();
}

}  // namespace pierce
