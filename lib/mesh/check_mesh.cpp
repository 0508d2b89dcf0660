// What a mesh must be before anything is built from it.
#include <mesh/check_mesh.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include <chunks.h>
#include <mesh/read_source.h>

namespace pierce::detail {

namespace {

constexpr std::size_t k_most = std::numeric_limits<std::uint32_t>::max() - 1;

// Whether there is nothing to complain about; what there is, is looked for again one by one.
template <class Scalar>
bool is_sound(const PlainMesh<Scalar>& mesh, const Executor& executor) {
    std::atomic<bool> sound = true;
    const std::size_t vertices = mesh.positions.size();
    const auto each = [&](std::size_t count, auto&& hold) {
        each_chunk(executor, count, [&](std::size_t, std::size_t begin, std::size_t end) {
            if (!hold(begin, end)) sound.store(false, std::memory_order_relaxed);
        });
    };
    // Sums and maxima, three side by side, take no branches.
    each(vertices, [&](std::size_t begin, std::size_t end) {
        Scalar sums[3] = {};
        for (std::size_t v = begin; v < end; ++v)
            for (int k = 0; k < 3; ++k) sums[k] += mesh.positions[v][k] * 0;  // no number if that is not finite
        return sums[0] == 0 && sums[1] == 0 && sums[2] == 0;
    });
    each(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
        std::uint32_t largest[3] = {};
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k) largest[k] = std::max(largest[k], mesh.triangles[i][k]);
        return std::max({largest[0], largest[1], largest[2]}) < vertices;
    });
    return sound;
}

}  // namespace

template <class Scalar>
void check_mesh(const PlainMesh<Scalar>& mesh, const Executor& executor) {
    if (mesh.positions.size() > k_most || mesh.triangles.size() > k_most)
        throw MeshError("a mesh can have at most 4294967294 vertices and as many triangles");
    if (!mesh.faces.empty() && mesh.faces.size() != mesh.triangles.size())
        throw MeshError("the mesh numbers " + std::to_string(mesh.faces.size()) + " faces, but has " +
                        std::to_string(mesh.triangles.size()) + " triangles");
    if (is_sound(mesh, executor)) return;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(mesh.positions[v][k]))
                throw MeshError("vertex " + std::to_string(v) + ": its " + "xyz"[k] + " coordinate is not finite");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            if (corner >= mesh.positions.size())
                throw MeshError(index_out_of_range(mesh.face_of(i), std::to_string(corner), mesh.positions.size(), ""));
}

template void check_mesh(const PlainMesh<float>&, const Executor&);
template void check_mesh(const PlainMesh<double>&, const Executor&);

}  // namespace pierce::detail
