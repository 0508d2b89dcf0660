// The façade of worlds: what is in them, and single queries.
#include <pierce/world.h>

#include <limits>
#include <utility>

#include <environment.h>
#include <query/along.h>
#include <world/engine.h>
#include <world/world_impl.h>

namespace pierce {

using namespace detail;

namespace {

template <class Impl, class Way>
int crossings_along(const Impl& impl, const Way& way, const WorldCountOptions& options) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl.valid(way)) return 0;
    return detail::crossings(impl.scene, way, options.mask, counters);
}

template <class Scalar>
Vec3<Scalar> no_vector() {
    return Vec3<Scalar>::Constant(std::numeric_limits<Scalar>::quiet_NaN());
}

}  // namespace

template <class Scalar>
World<Scalar>::World() : impl_(new Impl) {}
template <class Scalar>
World<Scalar>::~World() = default;

template <class Scalar>
World<Scalar>::World(const World& other) : World() {
    impl_->scene = other.impl_->scene;
    impl_->scene.free.reserve(impl_->scene.instances.size());  // as removing asks for
}
template <class Scalar>
World<Scalar>& World<Scalar>::operator=(const World& other) {
    return *this = World(other);
}
template <class Scalar>
World<Scalar>::World(World&& other) noexcept = default;
template <class Scalar>
World<Scalar>& World<Scalar>::operator=(World&& other) noexcept = default;

template <class Scalar>
bool World<Scalar>::holds(MeshId id) const noexcept {
    return impl_->scene.holds(id);
}

template <class Scalar>
std::size_t World<Scalar>::size() const noexcept {
    return impl_->scene.size();
}

template <class Scalar>
typename World<Scalar>::Mesh World<Scalar>::mesh(MeshId id) const noexcept {
    if (!holds(id)) return nullptr;
    return std::static_pointer_cast<const CollisionMesh<Scalar>>(impl_->scene.instances[id.index].owner);
}

template <class Scalar>
Vec3<Scalar> World<Scalar>::to_mesh(MeshId id, const Vec3<Scalar>& point) const noexcept {
    const StandardArithmetic standard;
    return holds(id) ? detail::to_mesh(impl_->scene.instances[id.index].placement, point) : no_vector<Scalar>();
}

template <class Scalar>
Vec3<Scalar> World<Scalar>::to_world(MeshId id, const Vec3<Scalar>& point) const noexcept {
    const StandardArithmetic standard;
    return holds(id) ? detail::to_world(impl_->scene.instances[id.index].placement, point) : no_vector<Scalar>();
}

template <class Scalar>
std::optional<WorldHit<Scalar>> World<Scalar>::first_hit(const Segment<Scalar>& segment,
                                                         const WorldOptions& options) const noexcept {
    return first_along<WorldHit<Scalar>>(*impl_, segment, options);
}
template <class Scalar>
bool World<Scalar>::any_hit(const Segment<Scalar>& segment, const WorldOptions& options) const noexcept {
    return any_along(*impl_, segment, options);
}
template <class Scalar>
std::size_t World<Scalar>::all_hits(const Segment<Scalar>& segment, std::span<WorldHit<Scalar>> out,
                                    const WorldOptions& options) const noexcept {
    return all_along(*impl_, segment, out, options);
}
template <class Scalar>
int World<Scalar>::crossings(const Segment<Scalar>& segment, const WorldCountOptions& options) const noexcept {
    return crossings_along(*impl_, segment, options);
}
template <class Scalar>
std::optional<WorldHit<Scalar>> World<Scalar>::first_hit_of_ray(const Ray<Scalar>& ray,
                                                                const WorldOptions& options) const noexcept {
    return first_along<WorldHit<Scalar>>(*impl_, ray, options);
}
template <class Scalar>
bool World<Scalar>::any_hit_of_ray(const Ray<Scalar>& ray, const WorldOptions& options) const noexcept {
    return any_along(*impl_, ray, options);
}
template <class Scalar>
std::size_t World<Scalar>::all_hits_of_ray(const Ray<Scalar>& ray, std::span<WorldHit<Scalar>> out,
                                           const WorldOptions& options) const noexcept {
    return all_along(*impl_, ray, out, options);
}
template <class Scalar>
int World<Scalar>::crossings_of_ray(const Ray<Scalar>& ray, const WorldCountOptions& options) const noexcept {
    return crossings_along(*impl_, ray, options);
}

template <class Scalar>
WorldStatistics World<Scalar>::statistics() const noexcept {
    const WorldScene<Scalar>& scene = impl_->scene;
    WorldStatistics s;
    s.meshes = scene.size();
    for (const Instance<Scalar>& instance : scene.instances)
        if (instance.owner != nullptr) s.triangles += instance.scene->triangles.size();
    s.depth = scene.tree.depth();
    s.bytes = sizeof(Impl) + scene.instances.capacity() * sizeof(Instance<Scalar>) +
              scene.free.capacity() * sizeof(std::uint32_t) + scene.tree.bytes();
    s.invalid_queries = impl_->invalid_queries.load(std::memory_order_relaxed);
    return s;
}

template class World<float>;
template class World<double>;

}  // namespace pierce
