// The façade of responses: velocities and moves, in standard arithmetic.
#include <pierce/response.h>

#include <atomic>

#include <environment.h>
#include <query/batch_sizes.h>
#include <query/inside.h>
#include <query/parts.h>
#include <response/mesh_cast.h>
#include <response/move_loop.h>

namespace pierce {

using namespace detail;

namespace {

// A power of two of about the largest component, so that squares stay in range; NaN and 0: 1.
double scale_of(const Point& p, const Point& q) {
    double most = 0;
    for (const double x : {p[0], p[1], p[2], q[0], q[1], q[2]}) most = std::max(most, std::abs(x));
    return most > 0 && std::isfinite(most) ? std::ldexp(1.0, std::clamp(std::ilogb(most), -1000, 1000)) : 1;
}

template <class Scalar>
Vec3<Scalar> to_vector(double scale, const Point& p) {
    return {static_cast<Scalar>(scale * p[0]), static_cast<Scalar>(scale * p[1]), static_cast<Scalar>(scale * p[2])};
}

// Not inlined: see environment.h.
template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> bounce_of(const Vec3<Scalar>& velocity, const Vec3<Scalar>& normal,
                                         const Vec3<Scalar>& surface_velocity, Scalar restitution, Scalar friction) {
    const Point before = to_point(velocity);
    const Point with = to_point(surface_velocity);
    const double scale = scale_of(before, with);
    const Wall wall{to_point(normal), times(1 / scale, with), static_cast<double>(friction)};
    const Point after = bounced(times(1 / scale, before), wall, static_cast<double>(restitution));
    return to_vector<Scalar>(scale, after);
}

template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> slide_of(const Vec3<Scalar>& velocity, std::span<const Vec3<Scalar>> normals) {
    const Point before = to_point(velocity);
    if (normals.empty() || !are_finite(before)) return velocity;
    std::array<Wall, k_most_planes> walls{};
    const std::size_t count = std::min(normals.size(), k_most_planes);
    for (std::size_t i = 0; i < count; ++i) walls[i].normal = to_point(normals[i]);
    const double scale = scale_of(before, {});
    const Point scaled = times(1 / scale, before);
    return to_vector<Scalar>(scale, Resolver({walls.data(), count}, scaled, k_alike<Scalar>).nearest().velocity);
}

template <class Scalar>
[[gnu::noinline]] Move<Scalar> move_of(const Scene<Scalar>& scene, const Vec3<Scalar>& position,
                                       const Vec3<Scalar>& velocity, Scalar seconds, const MoveOptions<Scalar>& options,
                                       bool bounces, std::span<MoveContact<Scalar>> contacts, QueryCounters& counters) {
    const MeshCast<Scalar> cast(scene, options.query, counters);
    return MoveLoop<Scalar, MeshCast<Scalar>>(cast, options, bounces, contacts).run(position, velocity, seconds);
}

template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> lifted_from(const Vec3<Scalar>& position, std::span<const MoveContact<Scalar>> contacts,
                                           Scalar skin) {
    if (!(skin > 0) || !std::isfinite(skin)) return position;
    HalfSpaces spaces;
    for (const MoveContact<Scalar>& contact : contacts)
        if (!spaces.full()) spaces.push({to_point(contact.normal.vec()), 1});
    Point lift{};
    constexpr double k_furthest = 8;
    if (!spaces.nearest(k_furthest, lift)) return position;
    return to_vector<Scalar>(1, plus(to_point(position), static_cast<double>(skin), lift));
}

template <class Scalar>
Move<Scalar> move(const CollisionMesh<Scalar>& mesh, const Vec3<Scalar>& position, const Vec3<Scalar>& velocity,
                  Scalar seconds, const MoveOptions<Scalar>& options, bool bounces,
                  std::span<MoveContact<Scalar>> contacts) {
    const StandardArithmetic standard;
    const auto& impl = Inside::of(mesh);
    QueryCounters spare;
    QueryCounters& counters = options.query.counters != nullptr ? *options.query.counters : spare;
    const Move<Scalar> moved = move_of(impl.scene, position, velocity, seconds, options, bounces, contacts, counters);
    if (moved.state == MoveState::invalid) impl.count_invalid(1);
    return moved;
}

template <class Scalar>
std::size_t move_all(const char* call, const CollisionMesh<Scalar>& mesh, const PointsView<Scalar>& positions,
                     const PointsView<Scalar>& velocities, Scalar seconds, std::span<Move<Scalar>> out,
                     const MoveOptions<Scalar>& options, bool bounces, const Executor& executor,
                     std::span<MoveContact<Scalar>> contacts) {
    check_sizes(call, positions.size(), "positions", velocities.size(), "velocities");
    check_sizes(call, positions.size(), "positions", out.size(), "places for answers");
    if (out.empty()) return 0;
    const auto& impl = Inside::of(mesh);
    const std::size_t room = contacts.size() / out.size();
    return in_parts(
        out.size(), options.query.counters, executor, [&](std::size_t count) { impl.count_invalid(count); },
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            counters.queries = 0;  // a move counts its own
            std::size_t met = 0;
            for (std::size_t i = first; i < last; ++i) {
                out[i] = move_of(impl.scene, positions[i], velocities[i], seconds, options, bounces,
                                 contacts.subspan(i * room, room), counters);
                if (out[i].contacts > 0) ++met;
                if (out[i].state == MoveState::invalid) ++invalid;
            }
            return met;
        });
}

}  // namespace

template <class Scalar>
Vec3<Scalar> slide(const Vec3<Scalar>& velocity, const std::type_identity_t<Vec3<Scalar>>& normal,
                   const std::type_identity_t<Vec3<Scalar>>& surface_velocity) noexcept {
    const StandardArithmetic standard;
    return bounce_of<Scalar>(velocity, normal, surface_velocity, 0, 0);
}

template <class Scalar>
Vec3<Scalar> slide(const Vec3<Scalar>& velocity, std::span<const std::type_identity_t<Vec3<Scalar>>> normals) noexcept {
    const StandardArithmetic standard;
    return slide_of<Scalar>(velocity, normals);
}

template <class Scalar>
Vec3<Scalar> bounce(const Vec3<Scalar>& velocity, const std::type_identity_t<Vec3<Scalar>>& normal,
                    std::type_identity_t<Scalar> restitution, std::type_identity_t<Scalar> friction,
                    const std::type_identity_t<Vec3<Scalar>>& surface_velocity) noexcept {
    const StandardArithmetic standard;
    return bounce_of<Scalar>(velocity, normal, surface_velocity, restitution, friction);
}

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
Vec3<Scalar> lifted(const CollisionMesh<Scalar>& mesh, const std::type_identity_t<Vec3<Scalar>>& position,
                    std::type_identity_t<std::span<const MoveContact<Scalar>>> contacts,
                    std::type_identity_t<Scalar> skin, const QueryOptions& options) noexcept {
    const StandardArithmetic standard;
    const Vec3<Scalar> target = lifted_from<Scalar>(position, contacts, skin);
    if (!is_valid(Segment<Scalar>{position, target})) return position;
    const auto hit = mesh.first_hit({position, target}, options);
    return hit ? hit->point.vec() : target;
}

template <class Scalar>
std::size_t moves_and_slide(const CollisionMesh<Scalar>& mesh,
                            const std::type_identity_t<PointsView<Scalar>>& positions,
                            const std::type_identity_t<PointsView<Scalar>>& velocities,
                            std::type_identity_t<Scalar> seconds, std::type_identity_t<std::span<Move<Scalar>>> out,
                            const std::type_identity_t<MoveOptions<Scalar>>& options, const Executor& executor,
                            std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) {
    return move_all<Scalar>("moves_and_slide", mesh, positions, velocities, seconds, out, options, false, executor,
                            contacts);
}

template <class Scalar>
std::size_t moves_and_bounce(const CollisionMesh<Scalar>& mesh,
                             const std::type_identity_t<PointsView<Scalar>>& positions,
                             const std::type_identity_t<PointsView<Scalar>>& velocities,
                             std::type_identity_t<Scalar> seconds, std::type_identity_t<std::span<Move<Scalar>>> out,
                             const std::type_identity_t<MoveOptions<Scalar>>& options, const Executor& executor,
                             std::type_identity_t<std::span<MoveContact<Scalar>>> contacts) {
    return move_all<Scalar>("moves_and_bounce", mesh, positions, velocities, seconds, out, options, true, executor,
                            contacts);
}

#define PIERCE_RESPONSES(Scalar)                                                                                       \
    template Vec3<Scalar> slide(const Vec3<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&) noexcept;               \
    template Vec3<Scalar> slide(const Vec3<Scalar>&, std::span<const Vec3<Scalar>>) noexcept;                          \
    template Vec3<Scalar> bounce(const Vec3<Scalar>&, const Vec3<Scalar>&, Scalar, Scalar,                             \
                                 const Vec3<Scalar>&) noexcept;                                                        \
    template Move<Scalar> move_and_slide(const CollisionMesh<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&,       \
                                         Scalar, const MoveOptions<Scalar>&, std::span<MoveContact<Scalar>>) noexcept; \
    template Move<Scalar> move_and_bounce(const CollisionMesh<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&,      \
                                          Scalar, const MoveOptions<Scalar>&,                                          \
                                          std::span<MoveContact<Scalar>>) noexcept;                                    \
    template Vec3<Scalar> lifted(const CollisionMesh<Scalar>&, const Vec3<Scalar>&,                                    \
                                 std::span<const MoveContact<Scalar>>, Scalar, const QueryOptions&) noexcept;          \
    template std::size_t moves_and_slide(const CollisionMesh<Scalar>&, const PointsView<Scalar>&,                      \
                                         const PointsView<Scalar>&, Scalar, std::span<Move<Scalar>>,                   \
                                         const MoveOptions<Scalar>&, const Executor&, std::span<MoveContact<Scalar>>); \
    template std::size_t moves_and_bounce(const CollisionMesh<Scalar>&, const PointsView<Scalar>&,                     \
                                          const PointsView<Scalar>&, Scalar, std::span<Move<Scalar>>,                  \
                                          const MoveOptions<Scalar>&, const Executor&, std::span<MoveContact<Scalar>>)
PIERCE_RESPONSES(float);
PIERCE_RESPONSES(double);
#undef PIERCE_RESPONSES

}  // namespace pierce
