// The façade of meshes that move: how one step follows the other.
#include <pierce/deforming_mesh.h>

#include <mutex>
#include <vector>

#include <environment.h>
#include <query/batch_sizes.h>
#include <query/collision_mesh_impl.h>
#include <query/deformation_step_impl.h>
#include <query/pool.h>
#include <query/standard_executor.h>

namespace pierce {

using namespace detail;

template <class Scalar>
struct DeformingMesh<Scalar>::Impl {
    using Step = typename DeformationStep<Scalar>::Impl;

    DeformationOptions options;
    std::vector<IndexTriple> triangles;
    std::vector<std::uint32_t> faces;
    std::vector<Vec3<Scalar>> rest;  ///< as it was built
    std::size_t vertex_count = 0;
    Pool<MovingState<Scalar>> states;
    Pool<MovingRecords<Scalar>> records;
    Pool<Step> steps;
    TreeBoxes<Scalar> boxes{TreeShape{}};  ///< of one end alone, to see what it costs
    mutable std::mutex mutex;              ///< of `current`, which one thread writes and many read
    std::shared_ptr<const Step> current;

    [[nodiscard]] std::shared_ptr<const Step> now() const {
        const std::lock_guard lock(mutex);
        return current;
    }
    void publish(std::shared_ptr<const Step> next) {
        const std::lock_guard lock(mutex);
        current.swap(next);
    }

    [[nodiscard]] PlainMesh<Scalar> plain(const MovingState<Scalar>& state) const {
        return {state.positions, triangles, {}};
    }
    /// A state that is nobody else's, at these positions.
    std::shared_ptr<MovingState<Scalar>> state_at(const PointsView<Scalar>& positions, const Executor& executor) {
        std::shared_ptr<MovingState<Scalar>> state = states.take();
        state->positions.resize(positions.size());
        for (std::size_t v = 0; v < positions.size(); ++v) state->positions[v] = positions[v];
        CollisionMesh<Scalar>& mesh = state->mesh;
        const MeshStatistics built = mesh.statistics();
        if (built.vertices != vertex_count || built.triangles != triangles.size()) {
            BuildOptions build = options.build;
            build.executor = executor;
            mesh = CollisionMesh<Scalar>(MeshView<Scalar>{state->positions, triangles, faces}, build);
        } else {
            mesh.refit(state->positions, executor);
            if (mesh.refit_cost() > options.rebuild_above) mesh.rebuild(state->positions, executor);
        }
        return state;
    }
    std::shared_ptr<const MovingRecords<Scalar>> records_of(const MovingState<Scalar>& state,
                                                            const std::shared_ptr<const MovingLayout<Scalar>>& layout,
                                                            const Executor& executor) {
        std::shared_ptr<MovingRecords<Scalar>> made = records.take();
        write_records<Scalar>(layout, plain(state), *made, executor);
        return made;
    }
    /// Whether the order of the triangles has become a bad one.
    bool is_stale(const MovingRecords<Scalar>& at) {
        if (boxes.clusters.size() != at.boxes.size() || boxes.nodes.size() != at.layout->shape.nodes.size())
            boxes = TreeBoxes<Scalar>(at.layout->shape);
        return layout_cost(at, boxes) > options.rebuild_above;
    }
};

template <class Scalar>
DeformingMesh<Scalar>::DeformingMesh(const MeshView<Scalar>& mesh, const DeformationOptions& options)
    : impl_(new Impl) {
    const StandardArithmetic standard;
    const StandardExecutor in_standard_arithmetic(options.build.executor);
    const Executor threads = in_standard_arithmetic.executor();
    Impl& impl = *impl_;
    impl.options = options;
    impl.options.build.executor = {};
    // First what checks the mesh.
    std::shared_ptr<MovingState<Scalar>> state = impl.states.take();
    state->mesh = CollisionMesh<Scalar>(mesh, options.build);
    impl.vertex_count = mesh.positions.size();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) state->positions.push_back(mesh.positions[v]);
    impl.rest = state->positions;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) impl.triangles.push_back(mesh.triangles[i]);
    impl.faces.assign(mesh.faces.begin(), mesh.faces.end());

    std::shared_ptr<typename Impl::Step> first = impl.steps.take();
    const auto layout = make_layout(impl.plain(*state), threads);
    first->scene.ends[0] = first->scene.ends[1] = impl.records_of(*state, layout, threads);
    first->ends[0] = first->ends[1] = state;
    const Scene<Scalar>& scene = state->mesh.impl_->scene;
    first->set(scene, scene, threads);
    impl.current = std::move(first);
}

template <class Scalar>
void DeformingMesh<Scalar>::begin_step(const PointsView<Scalar>& positions, const Executor& executor) {
    const StandardArithmetic standard;
    check_sizes("begin_step", positions.size(), "positions", impl_ ? impl_->vertex_count : 0, "vertices");
    if (!impl_) return;
    const StandardExecutor in_standard_arithmetic(executor);
    const Executor threads = in_standard_arithmetic.executor();
    Impl& impl = *impl_;
    const std::shared_ptr<const typename Impl::Step> now = impl.now();
    std::shared_ptr<typename Impl::Step> next = impl.steps.take();
    next->let_go();  // of what it held when it was used before
    std::shared_ptr<MovingState<Scalar>> state = impl.state_at(positions, executor);
    next->ends[0] = now->ends[1];
    next->ends[1] = state;
    next->scene.ends[0] = now->scene.ends[1];
    next->scene.ends[1] = impl.records_of(*state, now->scene.ends[1]->layout, threads);
    if (impl.is_stale(*next->scene.ends[1])) {
        const auto layout = make_layout(impl.plain(*state), threads);
        next->scene.ends[0] = impl.records_of(*next->ends[0], layout, threads);
        next->scene.ends[1] = impl.records_of(*state, layout, threads);
    }
    next->set(now->ends[1]->mesh.impl_->scene, state->mesh.impl_->scene, threads);
    impl.publish(std::move(next));
}

template <class Scalar>
void DeformingMesh<Scalar>::begin_step(const Pose<double>& pose, const Executor& executor) {
    if (!impl_) return;
    std::vector<Vec3<Scalar>> posed(impl_->rest.size());
    {
        const StandardArithmetic standard;
        for (std::size_t v = 0; v < posed.size(); ++v) {
            const Vec3<Scalar>& x = impl_->rest[v];
            for (int k = 0; k < 3; ++k)
                posed[v][k] = static_cast<Scalar>(
                    pose.rotation(k, 0) * static_cast<double>(x[0]) + pose.rotation(k, 1) * static_cast<double>(x[1]) +
                    pose.rotation(k, 2) * static_cast<double>(x[2]) + pose.translation[k]);
        }
    }
    begin_step(PointsView<Scalar>(posed), executor);
}

template <class Scalar>
DeformationStep<Scalar> DeformingMesh<Scalar>::step() const noexcept {
    return impl_ ? DeformationStep<Scalar>(impl_->now()) : DeformationStep<Scalar>();
}

template <class Scalar>
DeformingMesh<Scalar>::~DeformingMesh() = default;
template <class Scalar>
DeformingMesh<Scalar>::DeformingMesh(DeformingMesh&&) noexcept = default;
template <class Scalar>
DeformingMesh<Scalar>& DeformingMesh<Scalar>::operator=(DeformingMesh&&) noexcept = default;

template class DeformingMesh<float>;
template class DeformingMesh<double>;

}  // namespace pierce
