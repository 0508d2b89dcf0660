// Whether labels agree: around each edge, and between parts of the surface that share no edge.
//
// Where no faces pass through each other, that makes them agree everywhere. A cell is a part of space between faces.
// Faces of one part of the surface that bound one cell are joined by edges, around which they are neighbours, so they
// say the same of it. Other parts in the cell's boundary are joined to it by rays: from the vertex of a part that is
// furthest along x, moved as in crossing.h, a ray along x does not cross the part itself, as all of it lies behind.
// Where it crosses another, that one bounds the same cell and reaches further along x; where it crosses none, the cell
// is the outside. So by induction all parts that bound a cell are joined to one another, and the last to the outside.
#include <query/label_check.h>

#include <memory>
#include <numeric>
#include <sstream>

#include <exact/around_edge.h>
#include <exact/decide.h>
#include <query/merge_equal.h>
#include <query/ways.h>
#include <query/region_order.h>
#include <query/region_walk.h>

namespace pierce {

namespace detail {

namespace {

/// A face at an edge from vertex `u` to vertex `v`, u < v.
struct Wing {
    std::uint32_t u;
    std::uint32_t v;
    std::uint32_t triangle;
    std::uint32_t apex;    ///< its third vertex
    int turn;              ///< from the first wing of the edge: around_edge.h
    std::uint32_t before;  ///< the region that is come to first by a turn about v - u by the right hand, and then
    std::uint32_t after;
};

template <class Scalar>
class LabelCheck {
  public:
    explicit LabelCheck(const RegionScene<Scalar>& regions)
        : regions_(regions),
          scene_(regions.scene),
          positions_(scene_.vertex_count, no_position()),
          part_of_(scene_.triangles.size()) {
        std::iota(part_of_.begin(), part_of_.end(), 0U);
    }

    LabelReport report() {
        collect();
        for (auto first = wings_.begin(); first != wings_.end();) {
            const auto last =
                std::find_if(first, wings_.end(), [&](const Wing& w) { return w.u != first->u || w.v != first->v; });
            check_edge({std::to_address(first), std::to_address(last)});
            first = last;
        }
        check_parts();
        return std::move(report_);
    }

  private:
    static Point no_position() {
        constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
        return {k_none, k_none, k_none};
    }

    void collect() {
        scene_.each_triangle([&](TriangleRef triangle) {
            const Corners corners = scene_.corners(triangle);
            const IndexTriple& t = scene_.triangles[scene_.number_of(triangle)];
            for (std::size_t k = 0; k < 3; ++k) positions_[t[k]] = corners[k];
        });
        same_ = merge_equal(positions_);
        scene_.each_triangle([&](TriangleRef triangle) {
            const std::uint32_t number = scene_.number_of(triangle);
            const FaceRegions& label = regions_.labels[scene_.face_of_number(number)];
            const IndexTriple& t = scene_.triangles[number];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = same_[t[k]];
                const std::uint32_t b = same_[t[(k + 1) % 3]];
                const std::uint32_t c = same_[t[(k + 2) % 3]];
                // Along the edge from a to b the front is what a turn by the right hand comes to next.
                if (a < b)
                    wings_.push_back({a, b, number, c, 0, label.behind, label.front});
                else
                    wings_.push_back({b, a, number, c, 0, label.front, label.behind});
            }
        });
        std::sort(wings_.begin(), wings_.end(), [](const Wing& x, const Wing& y) {
            return std::array{x.u, x.v, x.triangle} < std::array{y.u, y.v, y.triangle};
        });
    }

    // What all wings of an edge have to say to one another.
    void check_edge(std::span<Wing> wings) {
        for (const Wing& wing : wings) join(wing.triangle, wings[0].triangle);
        // The order of two is no matter.
        if (wings.size() > 2) put_in_order(wings);
        for (std::size_t i = 0; i < wings.size(); ++i) {
            const Wing& one = wings[i];
            const Wing& two = wings[(i + 1) % wings.size()];
            if (one.after == two.before) continue;
            note(report_.edges, report_.edge_list,
                 {{one.u, one.v},
                  {scene_.face_of_number(one.triangle), scene_.face_of_number(two.triangle)},
                  {one.after, two.before}});
            return;
        }
    }

    void put_in_order(std::span<Wing> wings) const {
        const Point& u = positions_[wings[0].u];
        const Point& v = positions_[wings[0].v];
        const Point& reference = positions_[wings[0].apex];
        for (Wing& wing : wings) wing.turn = turn_of(u, v, reference, positions_[wing.apex]);
        const auto comes_before = [&](const Wing& x, const Wing& y) {
            if (x.turn != y.turn) return x.turn < y.turn;
            return x.turn % 2 == 1 && side_of({u, v, positions_[x.apex]}, positions_[y.apex]) > 0;
        };
        std::stable_sort(wings.begin(), wings.end(), comes_before);
        // Coincident ones lead on from one another, as far as they do. If possible begin with one that is alone.
        const auto alone = [&](std::size_t i) {
            const bool after_last = i == 0 || comes_before(wings[i - 1], wings[i]);
            return after_last && (i + 1 == wings.size() || comes_before(wings[i], wings[i + 1]));
        };
        std::size_t start = 0;
        while (start < wings.size() && !alone(start)) ++start;
        if (start == wings.size()) start = 0;
        std::rotate(wings.begin(), wings.begin() + static_cast<std::ptrdiff_t>(start), wings.end());
        const auto are_one = [&](const Wing& x, const Wing& y) { return !comes_before(x, y) && !comes_before(y, x); };
        for (std::size_t first = 0; first < wings.size();) {
            std::size_t last = first + 1;
            while (last < wings.size() && are_one(wings[first], wings[last])) ++last;
            chain(wings.subspan(first, last - first), first > 0 ? wings[first - 1].after : beginning(wings, last));
            first = last;
        }
    }
    static void chain(std::span<Wing> wings, std::uint32_t region) {
        for (auto at = wings.begin(); at != wings.end(); ++at) {
            const auto next = std::find_if(at, wings.end(), [&](const Wing& w) { return w.before == region; });
            if (next != wings.end()) std::rotate(at, next, next + 1);
            region = at->after;
        }
    }
    // Of the first ones, which no other of them leads to.
    static std::uint32_t beginning(std::span<const Wing> wings, std::size_t count) {
        for (const Wing& x : wings.first(count)) {
            bool led_to = false;
            for (const Wing& y : wings.first(count)) led_to = led_to || (&x != &y && y.after == x.before);
            if (!led_to) return x.before;
        }
        return wings[0].before;
    }

    void check_parts() {
        constexpr std::uint32_t k_none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> furthest(part_of_.size(), k_none);  // vertex of each part
        std::vector<std::vector<TriangleRef>> triangles;
        std::vector<std::uint32_t> list_of(part_of_.size(), k_none);
        scene_.each_triangle([&](TriangleRef triangle) {
            const std::uint32_t number = scene_.number_of(triangle);
            const std::uint32_t part = find(number);
            if (list_of[part] == k_none) {
                list_of[part] = static_cast<std::uint32_t>(triangles.size());
                triangles.emplace_back();
            }
            triangles[list_of[part]].push_back(triangle);
            for (const std::uint32_t v : scene_.triangles[number])
                if (furthest[part] == k_none || positions_[v][0] > positions_[furthest[part]][0]) furthest[part] = v;
        });
        for (const std::vector<TriangleRef>& part : triangles)
            check_part(part, furthest[find(scene_.number_of(part[0]))]);
    }

    void check_part(const std::vector<TriangleRef>& part, std::uint32_t vertex) {
        const Point& from = positions_[vertex];
        Crossing around{};
        Crossing own{};
        const bool has_around = first_crossing(
            from, {1, 0, 0}, [](TriangleRef) { return true; }, around);
        const std::uint32_t expected = has_around ? regions_.near(around.triangle, around.sign) : regions_.outside;
        const std::uint32_t id = find(scene_.number_of(part[0]));
        const auto is_own = [&](TriangleRef triangle) { return find(scene_.number_of(triangle)) == id; };
        // Towards the middle of one of its faces, which it crosses there if nowhere else.
        for (const TriangleRef& triangle : part) {
            const Corners corners = scene_.corners(triangle);
            Point way{};
            for (std::size_t k = 0; k < 3; ++k)
                way[k] = static_cast<double>(
                    static_cast<Scalar>(corners[0][k] / 3 + corners[1][k] / 3 + corners[2][k] / 3 - from[k]));
            if (!first_crossing(from, way, is_own, own)) continue;
            const std::uint32_t said = regions_.near(own.triangle, own.sign);
            if (said == expected) return;
            const std::uint32_t face = scene_.face_of(own.triangle);
            note(report_.floating, report_.floating_list,
                 {{vertex, vertex}, {face, has_around ? scene_.face_of(around.triangle) : face}, {said, expected}});
            return;
        }
        // A flat one has no inside: the regions on its sides are one, or they disagree at its border.
        const FaceRegions& label = regions_.labels[scene_.face_of(part[0])];
        if (label.front == expected) return;
        const std::uint32_t face = scene_.face_of(part[0]);
        note(report_.floating, report_.floating_list, {{vertex, vertex}, {face, face}, {label.front, expected}});
    }

    template <class Counts>
    [[nodiscard]] bool first_crossing(const Point& from, const Point& way, Counts&& counts, Crossing& first) {
        Path path;
        constexpr double k_infinite = std::numeric_limits<double>::infinity();
        constexpr bool k_floats = sizeof(Scalar) == sizeof(float);
        if (!set_ray_path(scene_.bounds, from, way, k_infinite, k_infinite, k_floats, path)) return false;
        bool found = false;
        each_crossing(
            scene_, path, counters_, [&] { return found ? first.latest : 1; },
            [&](const Crossing& crossing) {
                if (!counts(crossing.triangle)) return;
                if (found && order_of(scene_, path, first, crossing, counters_) <= 0) return;
                first = crossing;
                found = true;
            });
        return found;
    }

    static void note(std::size_t& count, std::vector<LabelReport::Disagreement>& list,
                     const LabelReport::Disagreement& what) {
        if (++count <= LabelReport::k_examples) list.push_back(what);
    }

    // Triangles joined by edges (Tarjan 1975, with halved paths).
    std::uint32_t find(std::uint32_t triangle) {
        while (part_of_[triangle] != triangle) triangle = part_of_[triangle] = part_of_[part_of_[triangle]];
        return triangle;
    }
    void join(std::uint32_t x, std::uint32_t y) { part_of_[find(x)] = find(y); }

    const RegionScene<Scalar>& regions_;
    const Scene<Scalar>& scene_;
    std::vector<Point> positions_;
    std::vector<std::uint32_t> same_;
    std::vector<std::uint32_t> part_of_;
    std::vector<Wing> wings_;
    QueryCounters counters_;
    LabelReport report_;
};

}  // namespace

template <class Scalar>
LabelReport check_labels(const RegionScene<Scalar>& regions) {
    return LabelCheck<Scalar>(regions).report();
}

template LabelReport check_labels(const RegionScene<float>&);
template LabelReport check_labels(const RegionScene<double>&);

}  // namespace detail

std::string LabelReport::to_string() const {
    std::ostringstream out;
    if (agree()) return "the labels agree: each point has one region\n";
    const auto line = [&](std::size_t count, const char* what, const auto& list, const auto& print) {
        if (count == 0) return;
        out << count << ' ' << what << ":\n";
        for (const Disagreement& x : list) {
            print(x);
            out << "face " << x.faces[0] << " says region " << x.regions[0] << ", ";
            if (x.faces[1] != x.faces[0]) out << "face " << x.faces[1] << " says ";
            out << "region " << x.regions[1] << '\n';
        }
        if (list.size() < count) out << "  ...\n";
    };
    line(edges, "edges around which labels disagree", edge_list,
         [&](const Disagreement& x) { out << "  " << x.edge[0] << '-' << x.edge[1] << ": "; });
    line(floating, "parts that lie in another region than they say", floating_list,
         [&](const Disagreement& x) { out << "  vertex " << x.edge[0] << ": "; });
    return out.str();
}

}  // namespace pierce
