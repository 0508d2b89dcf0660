// What a mesh must be before anything is built from it.
#include <mesh/check_mesh.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace pierce::detail {

namespace {

constexpr std::size_t k_most = std::numeric_limits<std::uint32_t>::max() - 1;

// A few rounds of multiply and shift (as in splitmix64, Steele et al. 2014): coordinates differ in few bits.
struct HashWords {
    template <class Words>
    std::size_t operator()(const Words& words) const {
        std::uint64_t h = 0;
        for (const auto& word : words) {
            h += static_cast<std::uint64_t>(word) + 0x9e3779b97f4a7c15U;
            h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
            h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
            h ^= h >> 31;
        }
        return static_cast<std::size_t>(h);
    }
};

}  // namespace

template <class Scalar>
void check_mesh(const MeshView<Scalar>& mesh) {
    if (mesh.positions.size() > k_most || mesh.triangles.size() > k_most)
        throw MeshError("a mesh can have at most 4294967294 vertices and as many triangles");
    if (!mesh.faces.empty() && mesh.faces.size() != mesh.triangles.size())
        throw MeshError("the mesh numbers " + std::to_string(mesh.faces.size()) + " faces, but has " +
                        std::to_string(mesh.triangles.size()) + " triangles");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(mesh.positions[v][k]))
                throw MeshError("vertex " + std::to_string(v) + ": its " + "xyz"[k] + " coordinate is not finite");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            if (corner >= mesh.positions.size())
                throw MeshError("face " + std::to_string(mesh.face_of(i)) + " (triangle " + std::to_string(i) +
                                "): corner " + std::to_string(corner) + " is out of range: there are " +
                                std::to_string(mesh.positions.size()) + " vertices");
}

template void check_mesh(const MeshView<float>&);
template void check_mesh(const MeshView<double>&);

std::size_t count_duplicates(std::span<const Point> positions, std::span<const IndexTriple> triangles) {
    // Vertices that repeat a position are first given one number.
    std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, HashWords> first_at;
    first_at.reserve(positions.size());
    std::vector<std::uint32_t> same(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        std::array<std::uint64_t, 3> key{};
        for (std::size_t k = 0; k < 3; ++k) key[k] = std::bit_cast<std::uint64_t>(positions[v][k] + 0.0);  // -0 is 0
        same[v] = first_at.try_emplace(key, static_cast<std::uint32_t>(v)).first->second;
    }
    std::unordered_set<IndexTriple, HashWords> seen;
    seen.reserve(triangles.size());
    std::size_t duplicates = 0;
    for (const IndexTriple& triangle : triangles) {
        IndexTriple key = {same[triangle[0]], same[triangle[1]], same[triangle[2]]};
        std::sort(key.begin(), key.end());
        if (!seen.insert(key).second) ++duplicates;
    }
    return duplicates;
}

}  // namespace pierce::detail
