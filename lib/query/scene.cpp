// A mesh made ready: the build, from positions and indices to the grid.
#include <query/scene.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <unordered_set>

#include <chunks.h>
#include <environment.h>
#include <exact/decide.h>
#include <kernel/plane.h>
#include <mesh/check_mesh.h>

namespace pierce::detail {

namespace {

template <class Scalar>
std::size_t count_faces(const Scene<Scalar>& scene) {
    if (scene.faces.empty()) return scene.triangles.size();
    std::unordered_set<std::uint32_t> different(scene.faces.begin(), scene.faces.end());
    return different.size();
}

template <class Scalar>
RawArray<PlainBox<Scalar>> make_boxes(const MeshView<Scalar>& mesh, const Executor& executor) {
    RawArray<PlainBox<Scalar>> boxes(mesh.triangles.size());
    each_chunk(executor, boxes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const IndexTriple& t = mesh.triangles[i];
            const Scalar* a = mesh.positions[t[0]].data();
            const Scalar* b = mesh.positions[t[1]].data();
            const Scalar* c = mesh.positions[t[2]].data();
            PlainBox<Scalar>& box = boxes[i];
            for (std::size_t k = 0; k < 3; ++k) {
                box.low[k] = std::min(std::min(a[k], b[k]), c[k]);
                box.high[k] = std::max(std::max(a[k], b[k]), c[k]);
            }
            const Corners corners = {to_point(mesh.positions[t[0]]), to_point(mesh.positions[t[1]]), to_point(mesh.positions[t[2]])};
            if (!Plane<double>(corners).has_area() && has_zero_area(corners)) box = {{1, 1, 1}, {0, 0, 0}};
        }
    });
    return boxes;
}

// Copies the mesh in the order of the grid, which is not its own: what comes next is asked of memory before.
template <class Scalar>
void copy_in_order(const MeshView<Scalar>& mesh, Scene<Scalar>& scene, const Executor& executor) {
    const std::size_t count = mesh.triangles.size();
    scene.triangles = RawArray<IndexTriple>(count);
    scene.coordinates = RawArray<Scalar>(9 * count + 1);
    scene.coordinates[9 * count] = 0;
    each_chunk(executor, count, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto triangle = [&](std::size_t at) -> const IndexTriple& { return mesh.triangles[scene.triangle_numbers[std::min(at, end - 1)]]; };
            __builtin_prefetch(&triangle(i + 2 * k_ahead));
            for (const std::uint32_t vertex : triangle(i + k_ahead)) __builtin_prefetch(&mesh.positions[vertex]);
            const IndexTriple& t = triangle(i);
            scene.triangles[i] = t;
            Scalar* to = &scene.coordinates[9 * i];
            for (const std::uint32_t vertex : t) {
                const Scalar* from = mesh.positions[vertex].data();
                for (std::size_t k = 0; k < 3; ++k) *to++ = from[k];
            }
        }
    });
    scene.vertex_count = mesh.positions.size();
}

// Exact whatever the numbers: the exponent of the cell, taken from the bits.
float scale_for(const Grid& grid) {
    if (grid.empty()) return 1;
    const Raster& raster = grid.levels().front().raster();
    const double cell = std::max({raster.size(0), raster.size(1), raster.size(2)});
    const int power = std::isfinite(cell) ? std::clamp(-std::ilogb(cell), -100, 100) : -100;
    return static_cast<float>(std::ldexp(1.0, power));
}

}  // namespace

template <class Scalar>
std::size_t Scene<Scalar>::bytes() const {
    return sizeof(*this) + coordinates.bytes() + triangles.bytes() +
           (triangle_numbers.capacity() + faces.capacity()) * sizeof(std::uint32_t) + grid.bytes();
}

template <class Scalar>
Scene<Scalar> make_scene(const MeshView<Scalar>& mesh, const BuildOptions& options) {
    // The caller's threads have floating-point environments of their own, and no use for what is thrown, when memory is at an end.
    const auto in_standard_arithmetic = [&](std::size_t parts, Task task) {
        std::atomic_flag failed;
        std::exception_ptr failure;
        options.executor(parts, [&](std::size_t part) {
            const StandardArithmetic standard;
            try {
                task(part);
            } catch (...) {
                if (!failed.test_and_set()) failure = std::current_exception();
            }
        });
        if (failure) std::rethrow_exception(failure);
    };
    const Executor executor = options.executor ? Executor(in_standard_arithmetic) : Executor();
    check_mesh(mesh, executor);
    if (!(options.cell_size >= 0)) throw MeshError("BuildOptions::cell_size must be 0 or more");
    Scene<Scalar> scene;
    scene.backend = &choose_backend(options.backend);
    scene.faces.assign(mesh.faces.begin(), mesh.faces.end());

    const RawArray<PlainBox<Scalar>> boxes = make_boxes(mesh, executor);
    const std::size_t most = options.max_grid_bytes != 0 ? options.max_grid_bytes
                                                         : std::max<std::size_t>(96 * boxes.size(), std::size_t{1} << 16);
    scene.grid = Grid(std::span(boxes.data(), boxes.size()), {options.cell_size, most}, executor);
    scene.triangle_numbers = scene.grid.take_order();
    const std::size_t listed = scene.triangle_numbers.size();
    scene.triangle_numbers.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].listed()) scene.triangle_numbers.push_back(i);
    scene.degenerate = scene.triangle_numbers.size() - listed;
    copy_in_order(mesh, scene, executor);
    scene.scale = scale_for(scene.grid);
    scene.face_count = count_faces(scene);
    return scene;
}

template struct Scene<float>;
template struct Scene<double>;
template Scene<float> make_scene(const MeshView<float>&, const BuildOptions&);
template Scene<double> make_scene(const MeshView<double>&, const BuildOptions&);

}  // namespace pierce::detail
