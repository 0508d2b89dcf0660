// A whole mesh as fans, for `kernels::triangle_fan`: each triangle in exactly one of them, whatever the mesh is like.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <pierce/kernels/triangle_fan.h>
#include <pierce/mesh_view.h>

namespace pierce {

/// Triangles around one vertex, each joined to the next by an edge that runs from it: k is (apex, ring[k],
/// ring[k + 1]), with the same orientation as in the mesh.
struct Fan {
    std::uint32_t apex = 0;                ///< the vertex that all share
    std::vector<std::uint32_t> ring;       ///< vertices, one more than triangles; a closed fan's last is its first
    std::vector<std::uint32_t> triangles;  ///< their places in `MeshView::triangles`

    /// Whether it goes all the way round.
    [[nodiscard]] bool closed() const { return ring.size() > 3 && ring.front() == ring.back(); }
};

/// Triangles in a fan of `fans_of`, unless told otherwise: each hands its errors on to the next. Measured in float
/// around a flat vertex, once round (KernelWeaknesses.ErrorsOfAFanGrowAlongItsMembers): u and v are off by up to 9e-7
/// with 10 members, 3.5e-6 with 16, 4.5e-4 with 64, 2e-2 with 256; by 2e-7, 3e-7, 1.5e-6, 6e-6 if these triangles are
/// tested alone. So many are found at the tip of a cone or a pole; elsewhere nothing is cut, and what is cut has
/// 6 (1 + 1/8) numbers a triangle at most.
inline constexpr std::size_t k_most_in_fan = 16;

/// Covers each triangle of the mesh exactly once, by fans of at most `most` (0 is taken as 1). Greedy: the vertex with
/// the most uncovered triangles is next; these are chained, from borders first, and each chain is a fan, so that a
/// vertex where several sheets meet, or a non-manifold edge, gives several. A triangle without a basis at one of its
/// corners (`TriangleFan::has_basis`), which includes those that name a vertex twice, is a fan of its own.
///
/// O(F log F) time and O(F) memory for F triangles, if valences are bounded. Indices must be in range: throws
/// `MeshError` naming the triangle.
template <class Scalar>
[[nodiscard]] std::vector<Fan> fans_of(const MeshView<Scalar>& mesh, std::size_t most = k_most_in_fan);

/// The stored form of a fan of `mesh`.
template <class Scalar>
[[nodiscard]] kernels::TriangleFan::Stored<Scalar> prepare(const MeshView<Scalar>& mesh, const Fan& fan) {
    std::vector<Vec3<Scalar>> ring;
    ring.reserve(fan.ring.size());
    for (const std::uint32_t v : fan.ring) ring.push_back(mesh.positions[v]);
    return kernels::triangle_fan.prepare<Scalar>(mesh.positions[fan.apex], ring);
}

namespace fans_detail {

/// A triangle at a vertex: the ring goes from `first` to `second`.
struct Wedge {
    std::uint32_t first;
    std::uint32_t second;
    std::uint32_t triangle;
};

[[nodiscard]] inline Wedge wedge_of(const IndexTriple& t, std::uint32_t apex, std::uint32_t triangle) {
    const std::size_t k = t[0] == apex ? 0 : t[1] == apex ? 1 : 2;
    return {t[(k + 1) % 3], t[(k + 2) % 3], triangle};
}

/// Joins wedges into fans: where one ends another may begin. Chains that nothing leads to come first, what is left are
/// rings.
inline void chain(std::uint32_t apex, const std::vector<Wedge>& wedges, std::vector<Fan>& fans) {
    std::multimap<std::uint32_t, Wedge> by_first;
    std::map<std::uint32_t, int> surplus;  // wedges that begin at a ring vertex, less those that end there
    for (const Wedge& w : wedges) {
        by_first.emplace(w.first, w);
        ++surplus[w.first];
        --surplus[w.second];
    }
    const auto grow_from = [&](std::uint32_t start) {
        Fan fan{apex, {start}, {}};
        for (auto at = by_first.find(start); at != by_first.end(); at = by_first.find(fan.ring.back())) {
            fan.ring.push_back(at->second.second);
            fan.triangles.push_back(at->second.triangle);
            by_first.erase(at);
        }
        fans.push_back(std::move(fan));
    };
    for (auto& [vertex, count] : surplus)
        for (; count > 0; --count) grow_from(vertex);
    while (!by_first.empty()) grow_from(by_first.begin()->first);
}

/// Whether any corner will do as the apex: rounding, and a limit on lengths, may tell them apart.
template <class Scalar>
[[nodiscard]] bool has_bases(const MeshView<Scalar>& mesh, const IndexTriple& t) {
    const auto at = [&](std::size_t k) -> Vec3<Scalar> { return mesh.positions[t[k % 3]]; };
    for (std::size_t k = 0; k < 3; ++k)
        if (!kernels::TriangleFan::has_basis<Scalar>(at(k), at(k + 1), at(k + 2))) return false;
    return true;
}

/// Appends the fan in as few parts as have at most `most` triangles each, all of about the same length: so that none
/// has more errors than it must.
inline void append_in_parts(const Fan& fan, std::size_t most, std::vector<Fan>& fans) {
    const std::size_t count = fan.triangles.size();
    const std::size_t parts = (count + most - 1) / most;
    for (std::size_t part = 0; part < parts; ++part) {
        const auto first = static_cast<std::ptrdiff_t>(count * part / parts);
        const auto last = static_cast<std::ptrdiff_t>(count * (part + 1) / parts);
        fans.push_back({fan.apex,
                        {fan.ring.begin() + first, fan.ring.begin() + last + 1},
                        {fan.triangles.begin() + first, fan.triangles.begin() + last}});
    }
}

}  // namespace fans_detail

template <class Scalar>
std::vector<Fan> fans_of(const MeshView<Scalar>& mesh, std::size_t most) {
    most = std::max(most, std::size_t{1});
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    std::vector<Fan> fans;
    std::vector<bool> covered(count);
    std::vector<std::vector<std::uint32_t>> around(mesh.positions.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const IndexTriple& t = mesh.triangles[i];
        for (const std::uint32_t v : t)
            if (v >= mesh.positions.size())
                throw_mesh_error("triangle " + std::to_string(i) + ": vertex index " + std::to_string(v) +
                                 " is out of range (" + std::to_string(mesh.positions.size()) + " vertices)");
        if (fans_detail::has_bases(mesh, t)) {
            for (const std::uint32_t v : t) around[v].push_back(i);
        } else {
            fans.push_back({t[0], {t[1], t[2]}, {i}});
            covered[i] = true;
        }
    }

    // Vertices by the number of their uncovered triangles. That only falls: a vertex found too high is moved down to
    // where it belongs.
    std::vector<std::vector<std::uint32_t>> with_count;
    const auto file = [&](std::uint32_t vertex, std::size_t number) {
        if (with_count.size() <= number) with_count.resize(number + 1);
        with_count[number].push_back(vertex);
    };
    for (std::uint32_t v = 0; v < around.size(); ++v)
        if (!around[v].empty()) file(v, around[v].size());
    for (std::size_t number = with_count.size(); number-- > 1;) {
        while (!with_count[number].empty()) {
            const std::uint32_t apex = with_count[number].back();
            with_count[number].pop_back();
            std::erase_if(around[apex], [&](std::uint32_t i) { return covered[i]; });
            if (around[apex].size() < number) {
                if (!around[apex].empty()) file(apex, around[apex].size());
                continue;
            }
            std::vector<fans_detail::Wedge> wedges;
            for (const std::uint32_t i : around[apex]) {
                wedges.push_back(fans_detail::wedge_of(mesh.triangles[i], apex, i));
                covered[i] = true;
            }
            std::vector<Fan> chains;
            fans_detail::chain(apex, wedges, chains);
            for (const Fan& fan : chains) fans_detail::append_in_parts(fan, most, fans);
        }
    }
    return fans;
}

}  // namespace pierce
