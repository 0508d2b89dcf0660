// What is behind a step.
#pragma once

#include <algorithm>
#include <vector>

#include <pierce/deforming_mesh.h>
#include <query/moving_scene.h>

namespace pierce {

namespace detail {

/// The mesh at one end of a step.
template <class Scalar>
struct MovingState {
    CollisionMesh<Scalar> mesh;
    std::vector<Vec3<Scalar>> positions;
};

}  // namespace detail

template <class Scalar>
struct DeformationStep<Scalar>::Impl {
    std::shared_ptr<const detail::MovingState<Scalar>> ends[2];
    detail::MovingScene<Scalar> scene;

    /// Makes the step, whose ends are there.
    void set(const detail::Scene<Scalar>& before, const detail::Scene<Scalar>& after, const Executor& executor) {
        scene.scene = &after;
        scene.grain = std::max(before.grain, after.grain);
        detail::set_step(scene, executor);
    }
    /// What it leads from and to is for others to use again; the memory of its own tree stays.
    void let_go() {
        for (std::size_t end = 0; end < 2; ++end) {
            ends[end].reset();
            scene.ends[end].reset();
        }
    }
};

}  // namespace pierce
