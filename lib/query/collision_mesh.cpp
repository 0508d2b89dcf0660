// The façade: what may be asked, in which arithmetic, and what is counted.
#include <pierce/collision_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include <environment.h>
#include <query/along.h>
#include <query/collision_mesh_impl.h>
#include <query/engine.h>
#include <query/locate.h>
#include <query/mesh_report.h>
#include <query/passages.h>
#include <without_exceptions.h>

namespace pierce {

using namespace detail;

namespace {

template <class Impl, class Way>
int crossings_along(const Impl& impl, const Way& way, QueryCounters* given) {
    const StandardArithmetic standard;
    Counters counters(given);
    if (!impl.valid(way)) return 0;
    return detail::crossings(impl.scene, way, counters);
}

}  // namespace

// Never destroyed: meshes may be used, and moved from, until the very end of a program.
template <class Scalar>
typename CollisionMesh<Scalar>::Impl& CollisionMesh<Scalar>::Impl::not_built() noexcept {
    alignas(Impl) static std::byte room[sizeof(Impl)];
    static Impl* const impl = ::new (static_cast<void*>(room)) Impl;
    return *impl;
}

template <class Scalar>
void CollisionMesh<Scalar>::Release::operator()(Impl* impl) const noexcept {
    if (impl->built()) delete impl;
}

template <class Scalar>
CollisionMesh<Scalar>::CollisionMesh() noexcept : impl_(&Impl::not_built()) {}

template <class Scalar>
CollisionMesh<Scalar>::CollisionMesh(const MeshView<Scalar>& mesh, const BuildOptions& options) : impl_(new Impl) {
    const StandardArithmetic standard;
    impl_->scene = make_scene(mesh, options);
    impl_->options.cell_size = options.cell_size;
    impl_->options.max_grid_bytes = options.max_grid_bytes;
}

template <class Scalar>
Result<CollisionMesh<Scalar>> CollisionMesh<Scalar>::try_make(const MeshView<Scalar>& mesh,
                                                              const BuildOptions& options) noexcept {
    Result<CollisionMesh> result;
    result.status =
        without_exceptions([&] { result.value = CollisionMesh(mesh, options); }, Status::bad_mesh, result.message);
    return result;
}

template <class Scalar>
CollisionMesh<Scalar>::~CollisionMesh() = default;
template <class Scalar>
CollisionMesh<Scalar>::CollisionMesh(CollisionMesh&& other) noexcept : CollisionMesh() {
    impl_.swap(other.impl_);
}
template <class Scalar>
CollisionMesh<Scalar>& CollisionMesh<Scalar>::operator=(CollisionMesh&& other) noexcept {
    CollisionMesh old(std::move(*this));
    impl_.swap(other.impl_);
    return *this;
}

template <class Scalar>
std::optional<Hit<Scalar>> CollisionMesh<Scalar>::first_hit(const Segment<Scalar>& segment,
                                                            const QueryOptions& options) const noexcept {
    return first_along<Hit<Scalar>>(*impl_, segment, options);
}

template <class Scalar>
bool CollisionMesh<Scalar>::any_hit(const Segment<Scalar>& segment, const QueryOptions& options) const noexcept {
    return any_along(*impl_, segment, options);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::all_hits(const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                                            const QueryOptions& options) const noexcept {
    return all_along(*impl_, segment, out, options);
}

template <class Scalar>
int CollisionMesh<Scalar>::crossings(const Segment<Scalar>& segment, QueryCounters* given) const noexcept {
    return crossings_along(*impl_, segment, given);
}

template <class Scalar>
std::optional<Hit<Scalar>> CollisionMesh<Scalar>::first_hit_of_ray(const Ray<Scalar>& ray,
                                                                   const QueryOptions& options) const noexcept {
    return first_along<Hit<Scalar>>(*impl_, ray, options);
}

template <class Scalar>
bool CollisionMesh<Scalar>::any_hit_of_ray(const Ray<Scalar>& ray, const QueryOptions& options) const noexcept {
    return any_along(*impl_, ray, options);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::all_hits_of_ray(const Ray<Scalar>& ray, std::span<Hit<Scalar>> out,
                                                   const QueryOptions& options) const noexcept {
    return all_along(*impl_, ray, out, options);
}

template <class Scalar>
int CollisionMesh<Scalar>::crossings_of_ray(const Ray<Scalar>& ray, QueryCounters* given) const noexcept {
    return crossings_along(*impl_, ray, given);
}

template <class Scalar>
int CollisionMesh<Scalar>::winding_number(const Vec3<Scalar>& point, QueryCounters* given) const noexcept {
    const StandardArithmetic standard;
    Counters counters(given);
    if (!impl_->valid(point)) return 0;
    return detail::winding_number(impl_->scene, point, counters);
}

template <class Scalar>
bool CollisionMesh<Scalar>::contains(const Vec3<Scalar>& point, QueryCounters* counters) const noexcept {
    return winding_number(point, counters) != 0;
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::passages(const Segment<Scalar>& segment, std::span<Passage<Scalar>> out,
                                            const PassageOptions& options, std::span<FaceTouch> faces) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(segment) || !(options.max_fraction >= 0)) return 0;
    return detail::passages(impl_->scene, segment, out, faces, options, counters);
}

template <class Scalar>
Location CollisionMesh<Scalar>::locate(const Vec3<Scalar>& point, std::span<FaceTouch> faces,
                                       QueryCounters* given) const noexcept {
    const StandardArithmetic standard;
    Counters counters(given);
    if (!impl_->valid(point)) return {};
    return detail::locate(impl_->scene, point, faces, counters);
}

template <class Scalar>
std::vector<FaceVerdict> CollisionMesh<Scalar>::explain(const Segment<Scalar>& segment,
                                                        const QueryOptions& options) const {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(segment)) return {};
    return detail::explain(impl_->scene, segment, options, counters);
}

template <class Scalar>
MeshReport CollisionMesh<Scalar>::mesh_report() const {
    const StandardArithmetic standard;
    const Scene<Scalar>& scene = impl_->scene;
    constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    std::vector<Point> positions(scene.vertex_count, Point{k_none, k_none, k_none});
    const auto place = [&](std::uint32_t number, const Corners& corners) {
        for (std::size_t k = 0; k < 3; ++k) positions[scene.triangles[number][k]] = corners[k];
    };
    scene.each_triangle([&](TriangleRef triangle) { place(scene.number_of(triangle), scene.corners(triangle)); });
    std::vector<std::uint32_t> degenerate;
    for (const auto& [number, corners] : scene.degenerate) {
        place(number, corners);
        degenerate.push_back(number);
    }
    const std::span triangles(scene.triangles.data(), scene.triangles.size());
    TJunctionCounters counters;
    return report_on(positions, triangles, degenerate, std::numeric_limits<Scalar>::epsilon(), counters);
}

template <class Scalar>
MeshStatistics CollisionMesh<Scalar>::statistics() const noexcept {
    const Scene<Scalar>& scene = impl_->scene;
    MeshStatistics s;
    s.vertices = scene.vertex_count;
    s.faces = scene.face_count;
    s.triangles = scene.triangles.size();
    s.degenerate = scene.degenerate.size();
    s.clusters = scene.cluster_refs.size();
    s.broadphase = scene.broadphase;
    s.nodes = scene.tree.node_count;
    if (scene.grid.cell_count() > 0)  // the one cell of the largest scenes is larger than numbers go
        s.cell_size = std::min(scene.grid.cell_size() / scene.frame.unit, std::numeric_limits<double>::max());
    s.grid_references = scene.grid.reference_count();
    if (!impl_->built()) return s;
    s.backend = scene.backend->name;
    s.bytes = scene.bytes() + (impl_->refit ? impl_->refit->bytes() : 0);
    s.invalid_queries = impl_->invalid_queries.load(std::memory_order_relaxed);
    return s;
}

template class CollisionMesh<float>;
template class CollisionMesh<double>;

}  // namespace pierce
