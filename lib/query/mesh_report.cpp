// What is odd about a mesh: its edges sorted, its fans joined, its border vertices looked up along each border edge.
#include <query/mesh_report.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <tuple>

#include <exact/decide.h>
#include <query/point_tree.h>

namespace pierce {

namespace detail {

namespace {

/// Sets that grow together (Tarjan 1975), with paths halved on the way.
class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
    std::uint32_t find(std::uint32_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    void join(std::uint32_t x, std::uint32_t y) { parent_[find(x)] = find(y); }

  private:
    std::vector<std::uint32_t> parent_;
};

// For each position the first one with the same coordinates.
std::vector<std::uint32_t> merge_equal(std::span<const Point> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
        return std::tie(positions[x], x) < std::tie(positions[y], y);
    });
    std::vector<std::uint32_t> same(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        same[order[i]] = i > 0 && positions[order[i]] == positions[order[i - 1]] ? same[order[i - 1]] : order[i];
    return same;
}

// One side of one triangle: from `low` to `high`, or the other way.
struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t triangle;
    std::uint8_t low_corner;   // the places of both in the triangle
    std::uint8_t high_corner;
    bool forward;
};

template <class T>
void note(std::size_t& count, std::vector<T>& list, const T& example) {
    ++count;
    if (list.size() < MeshReport::k_examples) list.push_back(example);
}

class Reporter {
  public:
    Reporter(std::span<const Point> positions, std::span<const IndexTriple> triangles, double epsilon)
        : positions_(positions), triangles_(triangles), epsilon_(epsilon), same_(merge_equal(positions)) {}

    MeshReport run() {
        look_at_triangles();
        look_at_edges();
        look_at_borders();
        return std::move(report_);
    }

  private:
    void look_at_triangles() {
        std::vector<std::pair<IndexTriple, std::uint32_t>> keys;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            const IndexTriple& t = triangles_[i];
            if (has_zero_area({positions_[t[0]], positions_[t[1]], positions_[t[2]]})) {
                note(report_.zero_area, report_.zero_area_triangles, i);
                continue;
            }
            const IndexTriple corner = {same_[t[0]], same_[t[1]], same_[t[2]]};
            for (std::uint8_t k = 0; k < 3; ++k) {
                const auto next = static_cast<std::uint8_t>((k + 1) % 3);
                if (corner[k] < corner[next]) sides_.push_back({corner[k], corner[next], i, k, next, true});
                else sides_.push_back({corner[next], corner[k], i, next, k, false});
            }
            IndexTriple key = corner;
            std::sort(key.begin(), key.end());
            keys.emplace_back(key, i);
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 1; i < keys.size(); ++i)
            if (keys[i].first == keys[i - 1].first)
                note(report_.duplicates, report_.duplicate_triangles, keys[i].second);
    }

    void look_at_edges() {
        std::sort(sides_.begin(), sides_.end(), [](const Side& x, const Side& y) {
            return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
        });
        Sets triangles(triangles_.size());
        Sets corners(3 * triangles_.size());  // corner k of triangle i is 3 i + k; a set is a fan around a vertex
        for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
            int balance = 0;
            for (; end < sides_.size() && sides_[end].low == sides_[begin].low && sides_[end].high == sides_[begin].high;
                 ++end) {
                const Side& first = sides_[begin];
                const Side& side = sides_[end];
                balance += side.forward ? 1 : -1;
                triangles.join(first.triangle, side.triangle);
                corners.join(3 * first.triangle + first.low_corner, 3 * side.triangle + side.low_corner);
                corners.join(3 * first.triangle + first.high_corner, 3 * side.triangle + side.high_corner);
            }
            const MeshReport::Edge edge = {sides_[begin].low, sides_[begin].high};
            const std::size_t count = end - begin;
            if (count == 1) {
                note(report_.border_edges, report_.border_edge_list, edge);
                border_.push_back(edge);
            } else if (balance != 0) {
                note(report_.misoriented_edges, report_.misoriented_edge_list, edge);
            }
            if (count > 2) note(report_.non_manifold_edges, report_.non_manifold_edge_list, edge);
        }

        std::vector<std::uint32_t> roots;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> fans;  // (vertex, fan)
        for (const Side& side : sides_) {
            roots.push_back(triangles.find(side.triangle));
            fans.emplace_back(side.low, corners.find(3 * side.triangle + side.low_corner));
            fans.emplace_back(side.high, corners.find(3 * side.triangle + side.high_corner));
        }
        const auto keep_different = [](auto& list) {
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        };
        keep_different(roots);
        keep_different(fans);
        report_.components = roots.size();
        for (std::size_t i = 1; i < fans.size(); ++i)
            if (fans[i].first == fans[i - 1].first && (i == 1 || fans[i].first != fans[i - 2].first))
                note(report_.non_manifold_vertices, report_.non_manifold_vertex_list, fans[i].first);
    }

    double largest(const MeshReport::Edge& edge) const {
        double most = 0;
        for (const std::uint32_t v : edge)
            for (const double x : positions_[v]) most = std::max(most, std::abs(x));
        return most;
    }

    // How far a vertex that was put on an edge may lie from it: each coordinate is rounded once, and a few roundings went before.
    // Among denormal numbers it is 0: what lies on an edge exactly is found there, and nothing else.
    double rounding(const MeshReport::Edge& edge) const { return 4 * epsilon_ * largest(edge); }

    // Whether v lies beside the inner part of the edge, within `rounding`. In units of the edge's own length, but for a factor
    // below 2: powers of two, so that they lose nothing, and among the smallest doubles nothing becomes zero.
    bool lies_on(std::uint32_t v, const MeshReport::Edge& edge) const {
        if (v == edge[0] || v == edge[1]) return false;
        const double most = largest(edge);
        const double shrink = most > 0x1p1020 ? 0x1p-3 : 1;  // against overflow of the differences
        Point d{};
        Point x{};
        double length = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double start = shrink * positions_[edge[0]][k];
            d[k] = shrink * positions_[edge[1]][k] - start;
            x[k] = shrink * positions_[v][k] - start;
            length = std::max(length, std::abs(d[k]));
        }
        if (!(length > 0)) return false;
        const int scale = -std::ilogb(length);
        double square = 0;
        double along = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            d[k] = std::scalbn(d[k], scale);
            x[k] = std::scalbn(x[k], scale);
            square += d[k] * d[k];
            along += d[k] * x[k];
        }
        if (!(along > 0 && along < square)) return false;
        // |d x x| / |d|: with its own rounding within half of what is allowed. That of x less its foot on the edge can be
        // more than all of it.
        double distance = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            distance = std::hypot(distance, d[i] * x[j] - d[j] * x[i]);
        }
        return distance <= 4 * epsilon_ * std::scalbn(shrink * most, scale) * std::sqrt(square);
    }

    void look_at_borders() {
        std::vector<std::uint32_t> vertices;
        for (const MeshReport::Edge& edge : border_) vertices.insert(vertices.end(), edge.begin(), edge.end());
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        const PointTree tree(positions_, vertices);
        std::vector<std::uint8_t> found(positions_.size(), 0);
        for (const MeshReport::Edge& edge : border_)
            tree.visit_near(positions_[edge[0]], positions_[edge[1]], 4 * rounding(edge), [&](std::uint32_t v) {
                if (found[v] == 0 && lies_on(v, edge)) found[v] = 1;
            });
        for (const std::uint32_t v : vertices)
            if (found[v] != 0) note(report_.t_junctions, report_.t_junction_list, v);
    }

    std::span<const Point> positions_;
    std::span<const IndexTriple> triangles_;
    double epsilon_;
    std::vector<std::uint32_t> same_;
    std::vector<Side> sides_;
    std::vector<MeshReport::Edge> border_;
    MeshReport report_;
};

}  // namespace

MeshReport report_on(std::span<const Point> positions, std::span<const IndexTriple> triangles, double epsilon) {
    return Reporter(positions, triangles, epsilon).run();
}

}  // namespace detail

std::string MeshReport::to_string() const {
    std::ostringstream out;
    out << (closed() ? "closed: nothing gets through" : "not closed: a particle can get through") << "; " << components
        << (components == 1 ? " component\n" : " components\n");
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
    line(misoriented_edges, "edges whose triangles do not face the same way", misoriented_edge_list, edge);
    line(non_manifold_vertices, "vertices where several fans touch", non_manifold_vertex_list, number);
    line(t_junctions, "T-junctions, vertices", t_junction_list, number);
    return out.str();
}

}  // namespace pierce
