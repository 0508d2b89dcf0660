// A mesh made ready: the build, from positions and indices to the broadphase.
#include <query/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_set>

#include <chunks.h>
#include <cluster/frame.h>
#include <cluster/make_clusters.h>
#include <exact/decide.h>
#include <mesh/check_mesh.h>
#include <query/place.h>
#include <query/rebuild.h>
#include <query/standard_executor.h>
#include <tree/make_tree.h>

namespace pierce::detail {

namespace {

template <class Scalar>
std::size_t count_faces(const Scene<Scalar>& scene) {
    if (scene.faces.empty()) return scene.triangles.size();
    std::unordered_set<std::uint32_t> different(scene.faces.begin(), scene.faces.end());
    return different.size();
}

template <class Scalar>
void copy_triangles(const PlainMesh<Scalar>& mesh, Scene<Scalar>& scene, const Executor& executor) {
    scene.triangles = RawArray<IndexTriple>(mesh.triangles.size());
    each_chunk(executor, mesh.triangles.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        std::copy(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(begin),
                  mesh.triangles.begin() + static_cast<std::ptrdiff_t>(end), scene.triangles.begin() + begin);
    });
}

// Those that are in no cluster.
template <class Scalar>
void keep_degenerate(const PlainMesh<Scalar>& mesh, Scene<Scalar>& scene, const std::vector<std::uint32_t>& numbers) {
    scene.degenerate.reserve(numbers.size());
    for (const std::uint32_t i : numbers) {
        const IndexTriple& t = mesh.triangles[i];
        scene.degenerate.push_back(
            {i, {to_point(mesh.positions[t[0]]), to_point(mesh.positions[t[1]]), to_point(mesh.positions[t[2]])}});
    }
}

Broadphase choose_broadphase(Broadphase wanted) {
    if (wanted == Broadphase::tree || wanted == Broadphase::grid) return wanted;
    if (wanted != Broadphase::automatic)
        throw std::invalid_argument("BuildOptions::broadphase is none of its values, but " +
                                    std::to_string(static_cast<int>(wanted)));
    const char* from_environment = std::getenv("PIERCE_BROADPHASE");
    const std::string_view name = from_environment != nullptr ? from_environment : "";
    if (name.empty() || name == "tree") return Broadphase::tree;
    if (name == "grid") return Broadphase::grid;
    throw std::invalid_argument("no broadphase '" + std::string(name) +
                                "' for PIERCE_BROADPHASE, which takes: tree grid");
}

// Clusters and broadphase, of a mesh whose triangles the scene need not have yet.
template <class Scalar>
void build(const PlainMesh<Scalar>& mesh, const BuildOptions& options, Scene<Scalar>& scene, const Executor& executor) {
    ClusterBuild<Scalar> built = make_clusters(mesh, has_zero_area, executor);
    scene.clusters = std::move(built.clusters);
    scene.cluster_refs = RawArray<ClusterRef>(built.boxes.size());
    each_chunk(executor, built.boxes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) scene.cluster_refs[i] = built.boxes[i].ref;
    });
    if (!scene.empty()) {
        QuadBox<Scalar> box;
        for (int k = 0; k < 3; ++k) {
            box.low[k] = static_cast<Scalar>(built.low[k]);
            box.high[k] = static_cast<Scalar>(built.high[k]);
        }
        set_bounds(scene, box, frame_of(built));
        const std::span boxes(built.boxes.data(), built.boxes.size());
        if (scene.broadphase == Broadphase::grid)
            scene.grid = make_grid<Scalar>(boxes, scene.frame, options, executor);
        else
            scene.tree = make_tree(boxes, scene.clusters.empty, scene.frame, executor);
    }
    keep_degenerate(mesh, scene, built.degenerate);
}

}  // namespace

template <class Scalar>
UniformGrid make_grid(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame, const BuildOptions& options,
                      const Executor& executor) {
    double size = options.cell_size * frame.unit;
    // 0 would leave it to the grid.
    if (options.cell_size > 0) size = std::max(size, std::numeric_limits<double>::min());
    return UniformGrid::make(boxes, frame, size, options.max_grid_bytes, executor);
}

template <class Scalar>
std::size_t Scene<Scalar>::bytes() const {
    return sizeof(*this) + clusters.records.bytes() + cluster_refs.bytes() + triangles.bytes() +
           faces.capacity() * sizeof(std::uint32_t) + degenerate.capacity() * sizeof(Degenerate) + tree.bytes() +
           grid.bytes();
}

template <class Scalar>
Scene<Scalar> make_scene(const MeshView<Scalar>& view, const BuildOptions& options) {
    const StandardExecutor standard_executor(options.executor);
    const Executor executor = standard_executor.executor();
    if (view.triangles.size() >= k_most_triangles)  // a record's place has 28 bits (cluster/record.h)
        throw MeshError("the mesh has " + std::to_string(view.triangles.size()) + " triangles; " +
                        std::to_string(k_most_triangles - 1) + " are the most it can have");
    if (const std::size_t left = view.triangles.left_over(); left > 0)
        throw MeshError("the mesh has " + std::to_string(3 * view.triangles.size() + left) +
                        " indices, which is no multiple of three");
    const MadePlain<Scalar> plain(view, executor);
    const PlainMesh<Scalar>& mesh = plain.mesh();
    check_mesh(mesh, executor);
    if (!(options.cell_size >= 0))
        throw std::invalid_argument("BuildOptions::cell_size is " + std::to_string(options.cell_size) +
                                    ", and must be 0 or more");
    Scene<Scalar> scene;
    scene.broadphase = choose_broadphase(options.broadphase);
    scene.backend = &choose_backend(options.backend);
    scene.faces.assign(mesh.faces.begin(), mesh.faces.end());
    scene.vertex_count = mesh.positions.size();

    build(mesh, options, scene, executor);
    copy_triangles(mesh, scene, executor);
    scene.face_count = count_faces(scene);
    return scene;
}

template <class Scalar>
void rebuild_scene(Scene<Scalar>& scene, std::span<const Vec3<Scalar>> positions, const BuildOptions& options,
                   const Executor& executor) {
    Scene<Scalar> built;
    built.broadphase = scene.broadphase;
    built.backend = scene.backend;
    built.vertex_count = scene.vertex_count;
    built.face_count = scene.face_count;
    const PlainMesh<Scalar> mesh{positions, {scene.triangles.data(), scene.triangles.size()}, {}};
    if (always_builds<Scalar>(positions)) {
        // What was there before is used again while caches still have it (6 % of the time). Nobody reads it: positions
        // are the caller's, or Refit's.
        scene.cluster_refs = {};
        scene.clusters.records = {};
        scene.tree = {};
        scene.grid = {};
    }
    build(mesh, options, built, executor);
    built.triangles = std::move(scene.triangles);
    built.faces = std::move(scene.faces);
    scene = std::move(built);
}

template <class Scalar>
void set_bounds(Scene<Scalar>& scene, const QuadBox<Scalar>& box, const Frame& frame) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
        const std::size_t axis = static_cast<std::size_t>(k);
        scene.bounds.low[axis] = static_cast<double>(box.low[k]);
        scene.bounds.high[axis] = static_cast<double>(box.high[k]);
        largest = std::max({largest, std::abs(scene.bounds.low[axis]), std::abs(scene.bounds.high[axis])});
    }
    scene.grain = grain_of<Scalar>(largest);
    scene.near_bound = near_margin(scene.grain);
    scene.frame = frame;
    scene.frame.noise = std::max(scene.near_bound * frame.unit, std::numeric_limits<double>::min());
}

template struct Scene<float>;
template struct Scene<double>;
template Scene<float> make_scene(const MeshView<float>&, const BuildOptions&);
template void rebuild_scene(Scene<float>&, std::span<const Vec3<float>>, const BuildOptions&, const Executor&);
template void set_bounds(Scene<float>&, const QuadBox<float>&, const Frame&);
template UniformGrid make_grid(std::span<const ClusterBox<float>>, const Frame&, const BuildOptions&, const Executor&);
template Scene<double> make_scene(const MeshView<double>&, const BuildOptions&);
template void rebuild_scene(Scene<double>&, std::span<const Vec3<double>>, const BuildOptions&, const Executor&);
template void set_bounds(Scene<double>&, const QuadBox<double>&, const Frame&);
template UniformGrid make_grid(std::span<const ClusterBox<double>>, const Frame&, const BuildOptions&, const Executor&);

}  // namespace pierce::detail
