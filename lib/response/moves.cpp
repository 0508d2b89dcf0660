// The façade of moves on a mesh that stands still: of points and of balls, in standard arithmetic.
#include <pierce/response.h>

#include <environment.h>
#include <query/inside.h>
#include <query/spheres.h>
#include <response/mesh_cast.h>
#include <response/move_all.h>
#include <response/move_loop.h>
#include <response/sphere_cast.h>

namespace pierce {

using namespace detail;

namespace {

// Not inlined: see environment.h.
template <class Scalar>
[[gnu::noinline]] Move<Scalar> move_in(const Scene<Scalar>& scene, const Vec3<Scalar>& position, Scalar radius,
                                       const Vec3<Scalar>& velocity, Scalar seconds, const MoveOptions<Scalar>& options,
                                       bool bounces, std::span<MoveContact<Scalar>> contacts, QueryCounters& counters) {
    if (radius == 0) {
        const MeshCast<Scalar> cast(scene, options.query, counters);
        return MoveLoop<Scalar, MeshCast<Scalar>>(cast, options, bounces, contacts).run(position, velocity, seconds);
    }
    if (!is_radius(radius) || !are_finite(position)) {
        Move<Scalar> move = begun(position, velocity);
        move.state = MoveState::invalid;
        return move;
    }
    const SphereCast<Scalar> cast(scene, to_point(position), static_cast<double>(radius), options.query, counters);
    return MoveLoop<Scalar, SphereCast<Scalar>>(cast, options, bounces, contacts).run(position, velocity, seconds);
}

template <class Scalar>
Move<Scalar> move(const CollisionMesh<Scalar>& mesh, const Vec3<Scalar>& position, const Vec3<Scalar>& velocity,
                  Scalar seconds, const MoveOptions<Scalar>& options, bool bounces,
                  std::span<MoveContact<Scalar>> contacts) {
    const StandardArithmetic standard;
    const auto& impl = Inside::of(mesh);
    QueryCounters spare;
    QueryCounters& counters = options.query.counters != nullptr ? *options.query.counters : spare;
    const Move<Scalar> moved =
        move_in(impl.scene, position, options.radius, velocity, seconds, options, bounces, contacts, counters);
    if (moved.state == MoveState::invalid) impl.count_invalid(1);
    return moved;
}

template <class Scalar>
std::size_t move_all_on(const char* call, const CollisionMesh<Scalar>& mesh, const PointsView<Scalar>& positions,
                        const PointsView<Scalar>& velocities, Scalar seconds, std::span<Move<Scalar>> out,
                        const MoveOptions<Scalar>& options, bool bounces, const Executor& executor,
                        std::span<MoveContact<Scalar>> contacts) {
    const auto& impl = Inside::of(mesh);
    return move_all<Scalar>(
        call, positions, velocities, out, options, executor, contacts,
        [&](std::size_t count) { impl.count_invalid(count); },
        [&](std::size_t i, std::span<MoveContact<Scalar>> room, QueryCounters& counters) {
            const Scalar radius = options.radii.empty() ? options.radius : options.radii[i];
            return move_in<Scalar>(impl.scene, positions[i], radius, velocities[i], seconds, options, bounces, room,
                                   counters);
        });
}

}  // namespace

template <class Scalar>
Move<Scalar> move_and_slide(const CollisionMesh<Scalar>& mesh, const std::type_identity_t<Vec3<Scalar>>& position,
                            const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
                            const std::type_identity_t<MoveOptions<Scalar>>& options,
                            std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) noexcept {
    return move<Scalar>(mesh, position, velocity, seconds, options, false, contacts);
}

template <class Scalar>
Move<Scalar> move_and_bounce(const CollisionMesh<Scalar>& mesh, const std::type_identity_t<Vec3<Scalar>>& position,
                             const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
                             const std::type_identity_t<MoveOptions<Scalar>>& options,
                             std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) noexcept {
    return move<Scalar>(mesh, position, velocity, seconds, options, true, contacts);
}

template <class Scalar>
std::size_t moves_and_slide(const CollisionMesh<Scalar>& mesh,
                            const std::type_identity_t<PointsView<Scalar>>& positions,
                            const std::type_identity_t<PointsView<Scalar>>& velocities,
                            std::type_identity_t<Scalar> seconds, std::type_identity_t<std::span<Move<Scalar>>> out,
                            const std::type_identity_t<MoveOptions<Scalar>>& options, const Executor& executor,
                            std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) {
    return move_all_on<Scalar>("moves_and_slide", mesh, positions, velocities, seconds, out, options, false, executor,
                               contacts);
}

template <class Scalar>
std::size_t moves_and_bounce(const CollisionMesh<Scalar>& mesh,
                             const std::type_identity_t<PointsView<Scalar>>& positions,
                             const std::type_identity_t<PointsView<Scalar>>& velocities,
                             std::type_identity_t<Scalar> seconds, std::type_identity_t<std::span<Move<Scalar>>> out,
                             const std::type_identity_t<MoveOptions<Scalar>>& options, const Executor& executor,
                             std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) {
    return move_all_on<Scalar>("moves_and_bounce", mesh, positions, velocities, seconds, out, options, true, executor,
                               contacts);
}

#define PIERCE_MOVES(Scalar)                                                                                           \
    template Move<Scalar> move_and_slide(const CollisionMesh<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&,       \
                                         Scalar, const MoveOptions<Scalar>&, std::span<MoveContact<Scalar>>) noexcept; \
    template Move<Scalar> move_and_bounce(const CollisionMesh<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&,      \
                                          Scalar, const MoveOptions<Scalar>&,                                          \
                                          std::span<MoveContact<Scalar>>) noexcept;                                    \
    template std::size_t moves_and_slide(const CollisionMesh<Scalar>&, const PointsView<Scalar>&,                      \
                                         const PointsView<Scalar>&, Scalar, std::span<Move<Scalar>>,                   \
                                         const MoveOptions<Scalar>&, const Executor&, std::span<MoveContact<Scalar>>); \
    template std::size_t moves_and_bounce(const CollisionMesh<Scalar>&, const PointsView<Scalar>&,                     \
                                          const PointsView<Scalar>&, Scalar, std::span<Move<Scalar>>,                  \
                                          const MoveOptions<Scalar>&, const Executor&, std::span<MoveContact<Scalar>>)
PIERCE_MOVES(float);
PIERCE_MOVES(double);
#undef PIERCE_MOVES

}  // namespace pierce
