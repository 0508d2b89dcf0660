// The triangles around each vertex, vertex by vertex: edges, fans, duplicates and components come from what lies around
// one vertex, so nothing as large as the mesh is sorted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <pierce/types.h>
#include <query/report_notes.h>
#include <query/sets.h>
#include <raw_array.h>

namespace pierce::detail {

class VertexFans {
  public:
    /// `triangles`: of vertices that are merged. One to leave out has the same vertex three times; the others have
    /// three different ones. Must live as long.
    VertexFans(std::span<const IndexTriple> triangles, std::size_t vertex_count)
        : triangles_(triangles), ends_(vertex_count + 1), around_(3 * triangles.size()), components_(triangles.size()) {
        list_triangles();
    }

    /// Writes all but triangles of area zero and T-junctions; returns the border edges, in ascending order.
    [[nodiscard]] std::vector<MeshReport::Edge> look(MeshReport& report) {
        report.components = count_;
        std::size_t begin = 0;
        for (std::uint32_t vertex = 0; vertex + 1 < ends_.size(); ++vertex) {
            const std::span<const std::uint32_t> around(around_.data() + begin, ends_[vertex] - begin);
            begin = ends_[vertex];
            if (around.empty()) continue;
            read_corners(vertex, around);
            if (is_closed_fan()) {
                for (const std::uint32_t triangle : around) join(around[0], triangle, report);
            } else {
                look_at_edges(vertex, around, report);
                look_at_duplicates(vertex, around, report);
            }
        }
        // Where the lower of its vertices has a closed fan, an edge has two triangles, and none of these was counted
        // yet.
        report.edges_with[2] += (3 * count_ - counted_sides_) / 2;
        return std::move(border_);
    }

  private:
    /// Of one triangle: the vertices behind and before the one that is looked at, counter-clockwise.
    struct Corner {
        std::uint32_t next;
        std::uint32_t previous;
    };

    // Counts, sums, places: the triangles of each vertex in ascending order (Knuth, volume 3, 5.2). `ends_[v]` counts
    // those of v first, is where the next one goes then, and where they end at last.
    void list_triangles() {
        for (const IndexTriple& t : triangles_) {
            if (t[0] == t[1]) continue;
            ++count_;
            for (const std::uint32_t v : t) ++ends_[v];
        }
        std::size_t sum = 0;
        for (std::size_t& end : ends_) sum += std::exchange(end, sum);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            const IndexTriple& t = triangles_[i];
            if (t[0] == t[1]) continue;
            for (const std::uint32_t v : t) around_[ends_[v]++] = i;
        }
    }

    void read_corners(std::uint32_t vertex, std::span<const std::uint32_t> around) {
        corners_.resize(around.size());
        for (std::size_t i = 0; i < around.size(); ++i) {
            const IndexTriple& t = triangles_[around[i]];
            corners_[i] = t[0] == vertex   ? Corner{t[1], t[2]}
                          : t[1] == vertex ? Corner{t[2], t[0]}
                                           : Corner{t[0], t[1]};
        }
    }

    // Whether each corner goes on in another one, and all are met in one turn: then each edge at the vertex has two
    // triangles that face the same way, and from three corners on none has the same vertices as another. Almost all
    // vertices of a good mesh are like that.
    [[nodiscard]] bool is_closed_fan() const {
        constexpr std::size_t k_most = 32;  // more are sorted: here each looks for the next one among all
        const std::size_t count = corners_.size();
        if (count < 3 || count > k_most) return false;
        std::uint32_t next = corners_[0].next;
        for (std::size_t met = 1; met < count; ++met) {
            std::size_t at = 1;
            while (at < count && corners_[at].previous != next) ++at;
            if (at == count) return false;
            next = corners_[at].next;
            if (next == corners_[0].previous) return met + 1 == count;
        }
        return false;
    }

    void look_at_edges(std::uint32_t vertex, std::span<const std::uint32_t> around, MeshReport& report) {
        spokes_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i)
            for (const std::uint32_t other : {corners_[i].next, corners_[i].previous})
                spokes_.push_back(std::uint64_t{other} << 32 | i);
        std::sort(spokes_.begin(), spokes_.end());
        fans_.reset(corners_.size());
        std::size_t fans = corners_.size();
        for (std::size_t begin = 0, end = 0; begin < spokes_.size(); begin = end) {
            const auto corner = [&](std::size_t i) { return static_cast<std::uint32_t>(spokes_[i]); };
            const auto other = static_cast<std::uint32_t>(spokes_[begin] >> 32);
            int balance = 0;
            for (; end < spokes_.size() && spokes_[end] >> 32 == other; ++end) {
                balance += corners_[corner(end)].next == other ? 1 : -1;
                if (fans_.join(corner(begin), corner(end))) --fans;
                join(around[corner(begin)], around[corner(end)], report);
            }
            if (other > vertex) look_at_edge({vertex, other}, end - begin, balance, report);
        }
        if (fans > 1) note(report.non_manifold_vertices, report.non_manifold_vertex_list, vertex);
    }

    void look_at_edge(const MeshReport::Edge& edge, std::size_t count, int balance, MeshReport& report) {
        if (count == 1) {
            note(report.border_edges, report.border_edge_list, edge);
            border_.push_back(edge);
        } else if (balance != 0) {
            note(report.misoriented_edges, report.misoriented_edge_list, edge);
        }
        ++report.edges_with[std::min(count, MeshReport::k_most_around_edge)];
        counted_sides_ += count;
        if (count > 2) note(report.non_manifold_edges, report.non_manifold_edge_list, edge);
    }

    // At the lowest vertex of each triangle.
    void look_at_duplicates(std::uint32_t vertex, std::span<const std::uint32_t> around, MeshReport& report) {
        opposite_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const auto [low, high] = std::minmax(corners_[i].next, corners_[i].previous);
            if (low > vertex) opposite_.emplace_back(std::uint64_t{low} << 32 | high, around[i]);
        }
        std::sort(opposite_.begin(), opposite_.end());
        for (std::size_t i = 1; i < opposite_.size(); ++i)
            if (opposite_[i].first == opposite_[i - 1].first)
                note(report.duplicates, report.duplicate_triangles, opposite_[i].second);
    }

    void join(std::uint32_t x, std::uint32_t y, MeshReport& report) {
        if (components_.join(x, y)) --report.components;
    }

    std::span<const IndexTriple> triangles_;
    std::size_t count_ = 0;          ///< of triangles, but those left out
    std::size_t counted_sides_ = 0;  ///< of triangles, at edges that were looked at
    std::vector<std::size_t> ends_;
    RawArray<std::uint32_t> around_;
    Sets components_;  ///< of triangles
    std::vector<MeshReport::Edge> border_;
    // Of the vertex that is looked at:
    std::vector<Corner> corners_;
    std::vector<std::uint64_t> spokes_;                              ///< an edge's other vertex, and the corner
    Sets fans_{0};                                                   ///< of corners
    std::vector<std::pair<std::uint64_t, std::uint32_t>> opposite_;  ///< both other vertices, and the triangle
};

}  // namespace pierce::detail
