// The report against a twin that compares everything with everything, and how its work grows.
#include <algorithm>
#include <map>
#include <set>

#include <exact/decide.h>
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <query/mesh_report.h>
#include <query/report_notes.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;
using detail::note;
using Edge = MeshReport::Edge;

template <class Scalar>
MeshReport naive_report(const TriangleSoup<Scalar>& soup) {
    MeshReport r;
    std::vector<detail::Point> points;
    for (const Vec3<Scalar>& p : soup.positions) points.push_back(detail::to_point(p));
    std::set<std::uint32_t> used;
    for (const IndexTriple& t : soup.triangles) used.insert(t.begin(), t.end());
    const auto same = [&](std::uint32_t v) {
        return *std::find_if(used.begin(), used.end(), [&](std::uint32_t w) { return points[w] == points[v]; });
    };

    // Of each edge the triangles, and which way round each has it.
    std::map<Edge, std::vector<std::pair<std::uint32_t, int>>> edges;
    std::map<IndexTriple, std::vector<std::uint32_t>> triples;
    std::map<std::uint32_t, std::set<std::uint32_t>> around;
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
        const IndexTriple& t = soup.triangles[i];
        if (detail::has_zero_area({points[t[0]], points[t[1]], points[t[2]]})) {
            note(r.zero_area, r.zero_area_triangles, i);
            continue;
        }
        IndexTriple key = {same(t[0]), same(t[1]), same(t[2])};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = key[k];
            const std::uint32_t b = key[(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}].emplace_back(i, a < b ? 1 : -1);
            around[a].insert(i);
        }
        std::sort(key.begin(), key.end());
        triples[key].push_back(i);
    }
    for (const auto& [key, list] : triples)
        for (std::size_t i = 1; i < list.size(); ++i) note(r.duplicates, r.duplicate_triangles, list[i]);

    // Sets of triangles, of all or around one vertex, that edges join: each has the name of its lowest one.
    const auto sets_of = [&](const std::set<std::uint32_t>& triangles, const auto& counts) {
        std::map<std::uint32_t, std::uint32_t> names;
        for (const std::uint32_t i : triangles) names[i] = i;
        for (const auto& [edge, list] : edges)
            for (std::size_t i = 1; counts(edge) && i < list.size(); ++i) {
                const auto [low, high] = std::minmax({names[list[0].first], names[list[i].first]});
                for (auto& [triangle, name] : names)
                    if (name == high) name = low;
            }
        return static_cast<std::size_t>(
            std::count_if(names.begin(), names.end(), [](const auto& n) { return n.first == n.second; }));
    };
    std::set<std::uint32_t> all;
    for (const auto& [v, list] : around) all.insert(list.begin(), list.end());
    r.components = sets_of(all, [](const Edge&) { return true; });
    for (const auto& [v, list] : around)
        if (sets_of(list, [&, v = v](const Edge& e) { return e[0] == v || e[1] == v; }) > 1)
            note(r.non_manifold_vertices, r.non_manifold_vertex_list, v);

    std::set<std::uint32_t> border;
    for (const auto& [edge, list] : edges) {
        int balance = 0;
        for (const auto& side : list) balance += side.second;
        if (list.size() == 1) {
            note(r.border_edges, r.border_edge_list, edge);
            border.insert(edge.begin(), edge.end());
        } else if (balance != 0) {
            note(r.misoriented_edges, r.misoriented_edge_list, edge);
        }
        ++r.edges_with[std::min(list.size(), MeshReport::k_most_around_edge)];
        if (list.size() > 2) note(r.non_manifold_edges, r.non_manifold_edge_list, edge);
    }
    constexpr double k_epsilon = std::numeric_limits<Scalar>::epsilon();
    for (const std::uint32_t v : border)
        if (std::any_of(edges.begin(), edges.end(), [&](const auto& e) {
                return e.second.size() == 1 && detail::lies_on(points, v, e.first, k_epsilon);
            }))
            note(r.t_junctions, r.t_junction_list, v);
    return r;
}

template <class Scalar>
std::size_t compare(const TriangleSoup<double>& given) {
    TriangleSoup<Scalar> soup{{}, given.triangles, {}};
    for (const V& p : given.positions) soup.positions.push_back(p.cast<Scalar>());  // -0 stays -0
    const MeshReport r = CollisionMesh<Scalar>(soup.view()).mesh_report();
    const MeshReport naive = naive_report(soup);
    EXPECT_EQ(r.to_string(), naive.to_string());
    EXPECT_EQ(r.edges_with, naive.edges_with);  // the text has them for non-manifold meshes only
    return r.border_edges + r.duplicates + r.non_manifold_vertices + r.t_junctions;
}

// Few vertices, on a lattice: much is equal, of zero area, on an edge of another, or more than once.
TEST(MeshReportNaive, random_triangles_on_a_lattice) {
    Random random(7);
    std::size_t cases = 0;
    for (int i = 0; i < 2000; ++i) {
        const double unit = std::array{1.0, 1.0 / 3, 0x1p-1070, 0x1p1021}[static_cast<std::size_t>(i) % 4];
        const int size = random.between_ints(1, i % 4 == 3 ? 2 : 4);
        TriangleSoup<double> soup;
        for (std::size_t v = 3 + random.below(12); v > 0; --v) {
            V p;
            for (int k = 0; k < 3; ++k) {
                p[k] = k == 2 && i % 3 == 0 ? 0 : unit * random.between_ints(-size, size);
                if (p[k] == 0 && random.chance(0.5)) p[k] = -0.0;
            }
            soup.positions.push_back(p);
        }
        const auto any = [&] { return static_cast<std::uint32_t>(random.below(soup.positions.size())); };
        for (std::size_t t = random.below(24); t > 0; --t) {
            soup.triangles.push_back({any(), any(), any()});
            if (random.chance(0.2)) {
                const auto [a, b, c] = soup.triangles[random.below(soup.triangles.size())];
                soup.triangles.push_back(random.chance(0.5) ? IndexTriple{b, c, a} : IndexTriple{a, c, b});
            }
        }
        cases += compare<double>(soup);
        if (i % 4 < 2) compare<float>(soup);
        ASSERT_FALSE(HasFailure()) << i;
    }
    EXPECT_GT(cases, 20'000U);
}

TEST(MeshReportNaive, good_meshes_that_were_damaged) {
    Random random(8);
    for (int i = 0; i < 120; ++i) {
        TriangleSoup<double> soup = i % 3 == 0   ? polycube(3, 0.4, 3, 1 + static_cast<std::uint64_t>(i))
                                    : i % 3 == 1 ? bumpy_sphere(3)
                                                 : terrain(6, 0.1, 1);
        for (int damage = i % 5; damage > 0 && !soup.triangles.empty(); --damage) {
            IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
            const auto middle = static_cast<std::uint32_t>(soup.positions.size());
            if (damage == 1) std::swap(t[0], t[1]);
            if (damage == 2) t = soup.triangles.back();
            if (damage < 3) continue;
            const V from = soup.positions[t[0]];
            soup.positions.emplace_back(from + random.unit() * (soup.positions[t[1]] - from));
            const IndexTriple rest = {middle, t[1], t[2]};
            t[1] = middle;
            soup.triangles.push_back(rest);
        }
        compare<double>(soup);
        ASSERT_FALSE(HasFailure()) << i;
    }
}

// Around a vertex of up to 32 triangles they are followed from one to the next, around larger ones sorted.
TEST(MeshReportNaive, spindles_of_all_sizes) {
    for (const std::uint32_t count : {2U, 3U, 4U, 31U, 32U, 33U, 34U, 70U})
        for (int damage = 0; damage < 3; ++damage) {
            TriangleSoup<double> soup{{V(0, 0, 1), V(0, 0, -1)}, {}, {}};
            for (std::uint32_t i = 0; i < count; ++i) {
                soup.positions.push_back(V(std::cos(6.28 * i / count), std::sin(6.28 * i / count), 0));
                soup.triangles.push_back({0, 2 + i, 2 + (i + 1) % count});
                soup.triangles.push_back({1, 2 + (i + 1) % count, 2 + i});
            }
            if (damage == 1) soup.triangles.erase(soup.triangles.begin() + 2);
            if (damage == 2) std::swap(soup.triangles[2][1], soup.triangles[2][2]);
            compare<double>(soup);
        }
}

detail::TJunctionCounters counters_of(const TriangleSoup<double>& soup, std::size_t* edges) {
    std::vector<detail::Point> points;
    for (const V& p : soup.positions) points.push_back(detail::to_point(p));
    detail::TJunctionCounters counters;
    *edges = detail::report_on(points, soup.triangles, {}, 0x1p-52, counters).border_edges;
    return counters;
}

// 4,000 triangles that share nothing took ten seconds: each border vertex was compared with all edges whose boxes held
// it. A tree that is asked along the edge measures few, whatever the edges' lengths. Boxes that it looks at on the way:
// for short edges as many as the tree is deep, for edges as long as the mesh the cube root of the vertices, or the
// square root in a plane.
TEST(MeshReportNaive, borders_cost_what_they_pass) {
    struct Case {
        double size;    ///< of a triangle
        double height;  ///< of the mesh
        double growth;  ///< of boxes per edge, where there are 16 times the edges
        double first;   ///< boxes per edge of the smaller mesh, at most
    };
    for (const Case& c : {Case{0.01, 1, 1.5, 40}, Case{1, 1, 3.1, 120}, Case{1, 0, 4.6, 190}}) {
        std::array<double, 2> boxes{};
        for (const std::size_t i : {0U, 1U}) {
            Random random(5);
            TriangleSoup<double> soup;
            for (std::uint32_t t = 0; t < (i == 0 ? 1000U : 16'000U); ++t) {
                const V centre = random.in_cube();
                for (int k = 0; k < 3; ++k) {
                    V p = (c.size < 1 ? centre : V(0, 0, 0)) + c.size * random.in_cube();
                    p[2] *= c.height;
                    soup.positions.push_back(p);
                }
                soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
            }
            std::size_t edges = 0;
            const detail::TJunctionCounters counters = counters_of(soup, &edges);
            ASSERT_EQ(edges, 3 * soup.triangles.size());
            boxes[i] = static_cast<double>(counters.boxes) / static_cast<double>(edges);
            ASSERT_LT(counters.pairs, 2 * edges + edges / 100) << "its ends, and hardly more";
        }
        EXPECT_LT(boxes[0], c.first) << c.size << ' ' << c.height;
        EXPECT_LT(boxes[1], c.growth * boxes[0]) << c.size << ' ' << c.height << ": " << boxes[0] << ' ' << boxes[1];
    }
}

}  // namespace
}  // namespace pierce::test
