// The border's vertices in a tree, which each border edge is led through; those whose boxes it passes are measured.
#include <query/t_junctions.h>

#include <algorithm>
#include <cmath>

namespace pierce::detail {

namespace {

double largest(std::span<const Point> positions, const MeshReport::Edge& edge) {
    double most = 0;
    for (const std::uint32_t v : edge)
        for (const double x : positions[v]) most = std::max(most, std::abs(x));
    return most;
}

// Each vertex once, in ascending order: by marks, as there are few numbers that no vertex has.
std::vector<std::uint32_t> ends_of(std::span<const MeshReport::Edge> border, std::vector<bool>& marks) {
    for (const MeshReport::Edge& edge : border)
        for (const std::uint32_t v : edge) marks[v] = true;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < marks.size(); ++v)
        if (marks[v]) vertices.push_back(v);
    return vertices;
}

}  // namespace

// In units of the edge's own length, but for a factor below 2: powers of two, so that they lose nothing, and among the
// smallest doubles nothing becomes zero.
bool lies_on(std::span<const Point> positions, std::uint32_t v, const MeshReport::Edge& edge, double epsilon) {
    if (v == edge[0] || v == edge[1]) return false;
    const double most = largest(positions, edge);
    const double shrink = most > 0x1p1020 ? 0x1p-3 : 1;  // against overflow of the differences
    Point d{};
    Point x{};
    double length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double start = shrink * positions[edge[0]][k];
        d[k] = shrink * positions[edge[1]][k] - start;
        x[k] = shrink * positions[v][k] - start;
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
    return distance <= 4 * epsilon * std::scalbn(shrink * most, scale) * std::sqrt(square);
}

std::vector<std::uint32_t> t_junctions(std::span<const Point> positions, std::span<const MeshReport::Edge> border,
                                       double epsilon, TJunctionCounters& counters) {
    if (border.empty()) return {};
    std::vector<bool> marks(positions.size());
    std::vector<std::uint32_t> vertices = ends_of(border, marks);
    const PointTree tree(positions, vertices);
    for (const MeshReport::Edge& edge : border) {
        const auto measure = [&](std::uint32_t v) {
            if (!marks[v]) return;  // found before
            ++counters.pairs;
            if (lies_on(positions, v, edge, epsilon)) marks[v] = false;
        };
        // Four times as far as lies_on() goes.
        counters.boxes += tree.visit_near(positions[edge[0]], positions[edge[1]], 16 * epsilon, measure);
    }
    std::erase_if(vertices, [&](std::uint32_t v) { return marks[v]; });
    return vertices;
}

}  // namespace pierce::detail
