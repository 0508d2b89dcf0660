// The façade of moves in one step of a mesh that moves: in standard arithmetic.
#include <pierce/response.h>

#include <environment.h>
#include <query/deformation_step_impl.h>
#include <query/inside.h>
#include <response/move_all.h>
#include <response/moving_loop.h>

namespace pierce {

using namespace detail;

namespace {

// Not inlined: see environment.h.
template <class Scalar>
[[gnu::noinline]] Move<Scalar> move_in(const MovingScene<Scalar>& scene, const Vec3<Scalar>& position, Scalar radius,
                                       const Vec3<Scalar>& velocity, Scalar seconds, const MoveOptions<Scalar>& options,
                                       bool bounces, std::span<MoveContact<Scalar>> contacts, QueryCounters& counters) {
    if (!(radius == 0)) {
        Move<Scalar> move = begun(position, velocity);
        move.state = MoveState::invalid;
        return move;
    }
    return MovingLoop<Scalar>(scene, options, bounces, contacts, counters).run(position, velocity, seconds);
}

template <class Scalar>
Move<Scalar> move(const DeformationStep<Scalar>& step, const Vec3<Scalar>& position, const Vec3<Scalar>& velocity,
                  Scalar seconds, const MoveOptions<Scalar>& options, bool bounces,
                  std::span<MoveContact<Scalar>> contacts) {
    const auto* impl = Inside::of(step);
    if (impl == nullptr)
        return bounces ? move_and_bounce(step.before(), position, velocity, seconds, options, contacts)
                       : move_and_slide(step.before(), position, velocity, seconds, options, contacts);
    const StandardArithmetic standard;
    QueryCounters spare;
    QueryCounters& counters = options.query.counters != nullptr ? *options.query.counters : spare;
    const Move<Scalar> moved =
        move_in(impl->scene, position, options.radius, velocity, seconds, options, bounces, contacts, counters);
    if (moved.state == MoveState::invalid) Inside::of(step.before()).count_invalid(1);
    return moved;
}

template <class Scalar>
std::size_t move_all_in(const char* call, const DeformationStep<Scalar>& step, const PointsView<Scalar>& positions,
                        const PointsView<Scalar>& velocities, Scalar seconds, std::span<Move<Scalar>> out,
                        const MoveOptions<Scalar>& options, bool bounces, const Executor& executor,
                        std::span<MoveContact<Scalar>> contacts) {
    const auto* impl = Inside::of(step);
    if (impl == nullptr)
        return bounces
                   ? moves_and_bounce(step.before(), positions, velocities, seconds, out, options, executor, contacts)
                   : moves_and_slide(step.before(), positions, velocities, seconds, out, options, executor, contacts);
    return move_all<Scalar>(
        call, positions, velocities, out, options, executor, contacts,
        [&](std::size_t count) { Inside::of(step.before()).count_invalid(count); },
        [&](std::size_t i, std::span<MoveContact<Scalar>> room, QueryCounters& counters) {
            const Scalar radius = options.radii.empty() ? options.radius : options.radii[i];
            return move_in<Scalar>(impl->scene, positions[i], radius, velocities[i], seconds, options, bounces, room,
                                   counters);
        });
}

}  // namespace

template <class Scalar>
Move<Scalar> move_and_slide(const DeformationStep<Scalar>& step, const std::type_identity_t<Vec3<Scalar>>& position,
                            const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
                            const std::type_identity_t<MoveOptions<Scalar>>& options,
                            std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) noexcept {
    return move<Scalar>(step, position, velocity, seconds, options, false, contacts);
}

template <class Scalar>
Move<Scalar> move_and_bounce(const DeformationStep<Scalar>& step, const std::type_identity_t<Vec3<Scalar>>& position,
                             const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
                             const std::type_identity_t<MoveOptions<Scalar>>& options,
                             std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) noexcept {
    return move<Scalar>(step, position, velocity, seconds, options, true, contacts);
}

template <class Scalar>
std::size_t moves_and_slide(const DeformationStep<Scalar>& step,
                            const std::type_identity_t<PointsView<Scalar>>& positions,
                            const std::type_identity_t<PointsView<Scalar>>& velocities,
                            std::type_identity_t<Scalar> seconds, std::type_identity_t<std::span<Move<Scalar>>> out,
                            const std::type_identity_t<MoveOptions<Scalar>>& options, const Executor& executor,
                            std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) {
    return move_all_in<Scalar>("moves_and_slide", step, positions, velocities, seconds, out, options, false, executor,
                               contacts);
}

template <class Scalar>
std::size_t moves_and_bounce(const DeformationStep<Scalar>& step,
                             const std::type_identity_t<PointsView<Scalar>>& positions,
                             const std::type_identity_t<PointsView<Scalar>>& velocities,
                             std::type_identity_t<Scalar> seconds, std::type_identity_t<std::span<Move<Scalar>>> out,
                             const std::type_identity_t<MoveOptions<Scalar>>& options, const Executor& executor,
                             std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) {
    return move_all_in<Scalar>("moves_and_bounce", step, positions, velocities, seconds, out, options, true, executor,
                               contacts);
}

#define PIERCE_MOVING_MOVES(Scalar)                                                                                    \
    template Move<Scalar> move_and_slide(const DeformationStep<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&,     \
                                         Scalar, const MoveOptions<Scalar>&, std::span<MoveContact<Scalar>>) noexcept; \
    template Move<Scalar> move_and_bounce(const DeformationStep<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&,    \
                                          Scalar, const MoveOptions<Scalar>&,                                          \
                                          std::span<MoveContact<Scalar>>) noexcept;                                    \
    template std::size_t moves_and_slide(const DeformationStep<Scalar>&, const PointsView<Scalar>&,                    \
                                         const PointsView<Scalar>&, Scalar, std::span<Move<Scalar>>,                   \
                                         const MoveOptions<Scalar>&, const Executor&, std::span<MoveContact<Scalar>>); \
    template std::size_t moves_and_bounce(const DeformationStep<Scalar>&, const PointsView<Scalar>&,                   \
                                          const PointsView<Scalar>&, Scalar, std::span<Move<Scalar>>,                  \
                                          const MoveOptions<Scalar>&, const Executor&, std::span<MoveContact<Scalar>>)
PIERCE_MOVING_MOVES(float);
PIERCE_MOVING_MOVES(double);
#undef PIERCE_MOVING_MOVES

}  // namespace pierce
