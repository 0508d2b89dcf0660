// The façade: new positions for a mesh.
#include <pierce/collision_mesh.h>

#include <stdexcept>
#include <string>

#include <environment.h>
#include <mesh/check_mesh.h>
#include <query/batch_sizes.h>
#include <query/collision_mesh_impl.h>
#include <query/standard_executor.h>

namespace pierce {

using namespace detail;

namespace {

/// The mesh is left without triangles where memory runs out, since records and bounds may be half written.
template <class Mesh, class Do>
void or_without_triangles(Mesh& mesh, Do&& change) {
    try {
        change();
    } catch (const std::bad_alloc&) {
        mesh = Mesh();
        throw;
    }
}

/// Builds anew, and forgets what refits and rebuilds went by.
template <class Scalar, class Mesh, class Impl>
void build_anew(Mesh& mesh, Impl& impl, std::span<const Vec3<Scalar>> positions, const Executor& executor) {
    or_without_triangles(mesh, [&] { rebuild_scene(impl.scene, positions, impl.options, executor); });
    impl.refit.reset();
    impl.kept = {};
}

/// `refit(Refit&)`, which says whether it could; else builds anew.
template <class Scalar, class Mesh, class Impl, class Do>
void refit_or_build(Mesh& mesh, Impl& impl, const Executor& executor, Do&& refit) {
    bool done = false;
    or_without_triangles(mesh, [&] {
        if (!impl.refit) impl.refit = std::make_unique<Refit<Scalar>>(impl.scene);
        done = refit(*impl.refit);
    });
    if (!done) build_anew<Scalar>(mesh, impl, impl.refit->wanted(), executor);
}

}  // namespace

template <class Scalar>
void CollisionMesh<Scalar>::refit(const PointsView<Scalar>& positions, const Executor& executor) {
    const StandardArithmetic standard;
    check_sizes("refit", positions.size(), "positions", impl_->scene.vertex_count, "vertices");
    // Nothing to go by: without clusters, or without vertices, as in one that was moved from.
    if (impl_->scene.empty()) return rebuild(positions, executor);
    const StandardExecutor in_standard_arithmetic(executor);
    const Executor threads = in_standard_arithmetic.executor();
    refit_or_build<Scalar>(*this, *impl_, threads, [&](Refit<Scalar>& refit) {
        return refit.all(impl_->scene, positions, impl_->options, threads);
    });
}

template <class Scalar>
void CollisionMesh<Scalar>::refit(const PointsView<Scalar>& positions, std::span<const std::uint32_t> changed) {
    const StandardArithmetic standard;
    Scene<Scalar>& scene = impl_->scene;
    check_sizes("refit", positions.size(), "positions", scene.vertex_count, "vertices");
    for (const std::uint32_t v : changed)
        if (v >= scene.vertex_count)
            throw std::invalid_argument("refit: no vertex " + std::to_string(v) + " among " +
                                        std::to_string(scene.vertex_count));
    if (changed.empty()) return;
    if (scene.empty()) {
        // Of its triangles, which have no area, positions are known as well.
        std::vector<Vec3<Scalar>> all(scene.vertex_count, Vec3<Scalar>::Zero());
        for (const auto& [number, corners] : scene.degenerate)
            for (std::size_t k = 0; k < 3; ++k)
                all[scene.triangles[number][k]] = {static_cast<Scalar>(corners[k][0]),
                                                   static_cast<Scalar>(corners[k][1]),
                                                   static_cast<Scalar>(corners[k][2])};
        for (const std::uint32_t v : changed) {
            check_position<Scalar>(v, positions[v]);
            all[v] = positions[v];
        }
        return build_anew<Scalar>(*this, *impl_, all, {});
    }
    refit_or_build<Scalar>(*this, *impl_, {},
                           [&](Refit<Scalar>& refit) { return refit.some(scene, positions, changed, impl_->options); });
}

template <class Scalar>
void CollisionMesh<Scalar>::rebuild(const PointsView<Scalar>& positions, const Executor& executor) {
    const StandardArithmetic standard;
    check_sizes("rebuild", positions.size(), "positions", impl_->scene.vertex_count, "vertices");
    if (!impl_->built()) return;
    const StandardExecutor in_standard_arithmetic(executor);
    const Executor threads = in_standard_arithmetic.executor();
    const MadePlain<Scalar> plain(MeshView<Scalar>{positions, {}}, threads);
    const std::span<const Vec3<Scalar>> at = plain.mesh().positions;
    bool done = false;
    if (!always_builds<Scalar>(at)) {
        check_positions(at, threads);
    } else if (!impl_->refit) {
        or_without_triangles(
            *this, [&] { done = rebuild_on_clusters<Scalar>(impl_->scene, at, impl_->options, impl_->kept, threads); });
    }
    if (!done) build_anew<Scalar>(*this, *impl_, at, threads);
}

template <class Scalar>
double CollisionMesh<Scalar>::refit_cost() const noexcept {
    const StandardArithmetic standard;
    return impl_->refit ? impl_->refit->cost(impl_->scene) : 1;
}

#define PIERCE_REFITS(Scalar)                                                                              \
    template void CollisionMesh<Scalar>::refit(const PointsView<Scalar>&, const Executor&);                \
    template void CollisionMesh<Scalar>::refit(const PointsView<Scalar>&, std::span<const std::uint32_t>); \
    template void CollisionMesh<Scalar>::rebuild(const PointsView<Scalar>&, const Executor&);              \
    template double CollisionMesh<Scalar>::refit_cost() const noexcept
PIERCE_REFITS(float);
PIERCE_REFITS(double);
#undef PIERCE_REFITS

}  // namespace pierce
