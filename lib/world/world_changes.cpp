// The façade of changes to worlds, with exceptions and without.
#include <stdexcept>
#include <utility>

#include <environment.h>
#include <query/inside.h>
#include <without_exceptions.h>
#include <world/world_impl.h>

namespace pierce {

using namespace detail;

namespace {

template <class Impl>
std::uint32_t index_of(const Impl& impl, MeshId id) {
    if (!impl.scene.holds(id)) throw std::invalid_argument("the world has no mesh of this MeshId: it is stale");
    return id.index;
}

/// What `change()`, which returns an id, comes to.
template <class Change>
Result<MeshId> tried(Change&& change) {
    Result<MeshId> result;
    result.status = without_exceptions([&] { result.value = change(); }, Status::bad_mesh, result.message);
    return result;
}

}  // namespace

template <class Scalar>
MeshId World<Scalar>::add(Mesh mesh, const InstanceOptions<Scalar>& options) {
    const StandardArithmetic standard;
    if (mesh == nullptr) throw std::invalid_argument("a mesh for a world is null");
    Instance<Scalar> instance;
    instance.scene = &Inside::of(*mesh).scene;
    instance.owner = std::move(mesh);
    instance.placement = make_placement(options.pose);
    instance.layers = options.layers;
    instance.face_layers = options.face_layers;
    return impl_->scene.id_of(impl_->scene.add(std::move(instance)));
}

template <class Scalar>
bool World<Scalar>::remove(MeshId id) noexcept {
    const StandardArithmetic standard;
    if (!impl_->scene.holds(id)) return false;
    impl_->scene.remove(id.index);
    return true;
}

template <class Scalar>
void World<Scalar>::replace(MeshId id, Mesh mesh) {
    const StandardArithmetic standard;
    const std::uint32_t index = index_of(*impl_, id);
    if (mesh == nullptr) throw std::invalid_argument("a mesh for a world is null");
    const Scene<Scalar>& scene = Inside::of(*mesh).scene;
    impl_->scene.put(index, std::move(mesh), scene, impl_->scene.instances[index].placement);
}

template <class Scalar>
void World<Scalar>::set_pose(MeshId id, const Pose<Scalar>& pose) {
    const StandardArithmetic standard;
    const std::uint32_t index = index_of(*impl_, id);
    const Instance<Scalar>& instance = impl_->scene.instances[index];
    impl_->scene.put(index, instance.owner, *instance.scene, make_placement(pose));
}

template <class Scalar>
void World<Scalar>::set_layers(MeshId id, std::uint32_t layers) {
    impl_->scene.instances[index_of(*impl_, id)].layers = layers;
}

template <class Scalar>
void World<Scalar>::set_face_layers(MeshId id, std::shared_ptr<const std::vector<std::uint32_t>> face_layers) {
    impl_->scene.instances[index_of(*impl_, id)].face_layers = std::move(face_layers);
}

template <class Scalar>
Result<MeshId> World<Scalar>::try_add(Mesh mesh, const InstanceOptions<Scalar>& options) noexcept {
    return tried([&] { return add(std::move(mesh), options); });
}
template <class Scalar>
Result<MeshId> World<Scalar>::try_replace(MeshId id, Mesh mesh) noexcept {
    return tried([&] { return replace(id, std::move(mesh)), id; });
}
template <class Scalar>
Result<MeshId> World<Scalar>::try_set_pose(MeshId id, const Pose<Scalar>& pose) noexcept {
    return tried([&] { return set_pose(id, pose), id; });
}
template <class Scalar>
Result<MeshId> World<Scalar>::try_set_layers(MeshId id, std::uint32_t layers) noexcept {
    return tried([&] { return set_layers(id, layers), id; });
}
template <class Scalar>
Result<MeshId> World<Scalar>::try_set_face_layers(
    MeshId id, std::shared_ptr<const std::vector<std::uint32_t>> face_layers) noexcept {
    return tried([&] { return set_face_layers(id, std::move(face_layers)), id; });
}

#define PIERCE_CHANGES(Scalar)                                                                               \
    template MeshId World<Scalar>::add(Mesh, const InstanceOptions<Scalar>&);                                \
    template bool World<Scalar>::remove(MeshId) noexcept;                                                    \
    template void World<Scalar>::replace(MeshId, Mesh);                                                      \
    template void World<Scalar>::set_pose(MeshId, const Pose<Scalar>&);                                      \
    template void World<Scalar>::set_layers(MeshId, std::uint32_t);                                          \
    template void World<Scalar>::set_face_layers(MeshId, std::shared_ptr<const std::vector<std::uint32_t>>); \
    template Result<MeshId> World<Scalar>::try_add(Mesh, const InstanceOptions<Scalar>&) noexcept;           \
    template Result<MeshId> World<Scalar>::try_replace(MeshId, Mesh) noexcept;                               \
    template Result<MeshId> World<Scalar>::try_set_pose(MeshId, const Pose<Scalar>&) noexcept;               \
    template Result<MeshId> World<Scalar>::try_set_layers(MeshId, std::uint32_t) noexcept;                   \
    template Result<MeshId> World<Scalar>::try_set_face_layers(                                              \
        MeshId, std::shared_ptr<const std::vector<std::uint32_t>>) noexcept
PIERCE_CHANGES(float);
PIERCE_CHANGES(double);
#undef PIERCE_CHANGES

}  // namespace pierce
