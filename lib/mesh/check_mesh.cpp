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

// Whether `hold(begin, end)` is true of all chunks.
template <class Hold>
bool all_hold(const Executor& executor, std::size_t count, Hold&& hold) {
    std::atomic<bool> sound = true;
    each_chunk(executor, count, [&](std::size_t, std::size_t begin, std::size_t end) {
        if (!hold(begin, end)) sound.store(false, std::memory_order_relaxed);
    });
    return sound;
}

// What is wrong is looked for again one by one. Sums and maxima, three side by side, take no branches.
template <class Scalar>
bool are_finite(std::span<const Vec3<Scalar>> positions, const Executor& executor) {
    return all_hold(executor, positions.size(), [&](std::size_t begin, std::size_t end) {
        Scalar sums[3] = {};
        for (std::size_t v = begin; v < end; ++v)
            for (int k = 0; k < 3; ++k) sums[k] += positions[v][k] * 0;  // no number if that is not finite
        return sums[0] == 0 && sums[1] == 0 && sums[2] == 0;
    });
}

template <class Scalar>
bool has_all_corners(const PlainMesh<Scalar>& mesh, const Executor& executor) {
    return all_hold(executor, mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
        std::uint32_t largest[3] = {};
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k) largest[k] = std::max(largest[k], mesh.triangles[i][k]);
        return std::max({largest[0], largest[1], largest[2]}) < mesh.positions.size();
    });
}

}  // namespace

template <class Scalar>
void check_position(std::size_t vertex, const Vec3<Scalar>& position) {
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(position[k]))
            throw MeshError("vertex " + std::to_string(vertex) + ": its " + "xyz"[k] + " coordinate is not finite");
}

template <class Scalar>
void check_positions(std::span<const Vec3<Scalar>> positions, const Executor& executor) {
    if (are_finite(positions, executor)) return;
    for (std::size_t v = 0; v < positions.size(); ++v) check_position(v, positions[v]);
}

template <class Scalar>
void check_mesh(const PlainMesh<Scalar>& mesh, const Executor& executor) {
    if (mesh.positions.size() > k_most || mesh.triangles.size() > k_most)
        throw MeshError("a mesh can have at most 4294967294 vertices and as many triangles");
    if (!mesh.faces.empty() && mesh.faces.size() != mesh.triangles.size())
        throw MeshError("the mesh numbers " + std::to_string(mesh.faces.size()) + " faces, but has " +
                        std::to_string(mesh.triangles.size()) + " triangles");
    check_positions(mesh.positions, executor);
    if (has_all_corners(mesh, executor)) return;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            if (corner >= mesh.positions.size())
                throw MeshError(index_out_of_range(mesh.face_of(i), std::to_string(corner), mesh.positions.size(), ""));
}

template void check_position(std::size_t, const Vec3<float>&);
template void check_positions(std::span<const Vec3<float>>, const Executor&);
template void check_mesh(const PlainMesh<float>&, const Executor&);
template void check_position(std::size_t, const Vec3<double>&);
template void check_positions(std::span<const Vec3<double>>, const Executor&);
template void check_mesh(const PlainMesh<double>&, const Executor&);

}  // namespace pierce::detail
