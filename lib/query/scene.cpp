// A mesh made ready: the build, from positions and indices to the grid.
#include <query/scene.h>

#include <algorithm>
#include <unordered_set>

#include <exact/decide.h>
#include <mesh/check_mesh.h>

namespace pierce::detail {

namespace {

std::size_t count_faces(const Scene& scene) {
    if (scene.faces.empty()) return scene.triangles.size();
    std::unordered_set<std::uint32_t> different(scene.faces.begin(), scene.faces.end());
    return different.size();
}

}  // namespace

std::size_t Scene::bytes() const {
    return sizeof(Scene) + positions.capacity() * sizeof(Point) + triangles.capacity() * sizeof(IndexTriple) +
           faces.capacity() * sizeof(std::uint32_t) + prepared.capacity() * sizeof(PreparedTriangle) + grid.bytes();
}

template <class Scalar>
Scene make_scene(const MeshView<Scalar>& mesh, const BuildOptions& options) {
    check_mesh(mesh);
    Scene scene;
    scene.positions.reserve(mesh.positions.size());
    for (const Vec3<Scalar>& position : mesh.positions) scene.positions.push_back(to_point(position));
    scene.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    scene.faces.assign(mesh.faces.begin(), mesh.faces.end());
    scene.prepared.resize(scene.triangles.size());

    std::vector<Box> boxes;
    std::vector<std::uint32_t> numbers;
    boxes.reserve(scene.triangles.size());
    numbers.reserve(scene.triangles.size());
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const Corners corners = scene.corners(i);
        if (has_zero_area(corners)) {
            ++scene.degenerate;
            continue;
        }
        scene.prepared[i] = prepare(corners);
        boxes.push_back(box_of(corners));
        numbers.push_back(i);
    }
    const std::size_t most = options.max_grid_bytes != 0
                                 ? options.max_grid_bytes
                                 : std::max<std::size_t>(192 * boxes.size(), std::size_t{1} << 16);
    scene.grid = Grid(boxes, numbers, {options.grid_cells, most});
    scene.face_count = count_faces(scene);
    return scene;
}

template Scene make_scene(const MeshView<float>&, const BuildOptions&);
template Scene make_scene(const MeshView<double>&, const BuildOptions&);

}  // namespace pierce::detail
