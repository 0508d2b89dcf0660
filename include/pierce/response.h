// What a particle does after a hit: slide along, bounce off, come to rest. Velocities by themselves, and whole steps.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <pierce/collision_mesh.h>
#include <pierce/coordinates.h>
#include <pierce/deforming_mesh.h>
#include <pierce/executor.h>
#include <pierce/export.h>
#include <pierce/options.h>
#include <pierce/points_view.h>
#include <pierce/small_callable.h>
#include <pierce/types.h>

namespace pierce {

/// The velocity that is left of `velocity` where it runs into a surface with this unit normal (`Hit::facing()`) that
/// moves at `surface_velocity`: its part into the surface is taken off, one out of it is kept. No friction. What is not
/// finite gives what is not finite.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Vec3<Scalar> slide(
    const Vec3<Scalar>& velocity, const std::type_identity_t<Vec3<Scalar>>& normal,
    const std::type_identity_t<Vec3<Scalar>>& surface_velocity = Vec3<Scalar>::Zero()) noexcept;

/// The same for several surfaces at rest that it runs into at one place: the velocity nearest to `velocity` that goes
/// into none of them. That is its part along one of the planes, along the crease of two, or 0 where a third one stops
/// it. At most `k_most_planes` normals; of more the rest is left out.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Vec3<Scalar> slide(const Vec3<Scalar>& velocity,
                                               std::span<const std::type_identity_t<Vec3<Scalar>>> normals) noexcept;

/// At how many planes at once a particle is followed. Where a place touches more than these, it stops.
inline constexpr std::size_t k_most_planes = 8;

/// The velocity after an impact on a surface with this unit normal: of its part into the surface, seen from the
/// surface, `restitution` comes back; the part along the surface loses up to `friction` times what the normal part
/// changed by (Coulomb), and stops where that is less. A velocity out of the surface is left as it is.
/// `restitution`: 0 to 1, as a rule; `friction`: 0 and up.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Vec3<Scalar> bounce(
    const Vec3<Scalar>& velocity, const std::type_identity_t<Vec3<Scalar>>& normal,
    std::type_identity_t<Scalar> restitution, std::type_identity_t<Scalar> friction = 0,
    const std::type_identity_t<Vec3<Scalar>>& surface_velocity = Vec3<Scalar>::Zero()) noexcept;

/// What a surface does to a particle that runs into it.
template <class Scalar>
struct Response {
    Scalar restitution = 0;  ///< the part of the approach that comes back: 0 to 1
    Scalar friction = 0;     ///< Coulomb's, 0 and up
    /// That of the surface where it is met: of a conveyor, or of a wall that moves (the mesh itself stands still).
    Vec3<Scalar> velocity = Vec3<Scalar>::Zero();
    /// An approach at this speed or a lower one does not bounce. Where gravity is added once a step, a bounce gets up
    /// to twice g times the step on top of what it should have, so at 0 a particle bounces for ever, and at that
    /// divided by 1 - `restitution` or more it comes to rest.
    Scalar rest_speed = 0;
};

/// One contact of a move. Plain memory.
template <class Scalar>
struct MoveContact {
    Coordinates<Scalar> point;   ///< where the particle was, or the center of the ball
    Coordinates<Scalar> normal;  ///< unit normal, towards the particle
    Scalar speed;                ///< at which it approached the surface along the normal, seen from the surface
    Scalar seconds;              ///< how much of the step was left
    std::uint32_t face;          ///< the caller's number
    std::uint32_t triangle;      ///< its place in `MeshView::triangles`
    Sides side;                  ///< of the face: front or back
};

/// Something that is called with a `MoveContact` and says what the surface does there: a lambda, say, that looks up the
/// face's material. The contact's speed is then that towards a surface at rest. Kept as `Accept` is; the answer must
/// depend on the contact only, and it must not throw.
template <class Scalar>
class ResponseAt {
    using Kept = detail::SmallCallable<Response<Scalar>(const MoveContact<Scalar>&)>;

  public:
    ResponseAt() = default;
    /// Keeps a copy of a callable.
    template <class Callable>
    requires(Kept::template keeps<Callable>) ResponseAt(const Callable& callable) : kept_(callable) {}
    /// Refuses what can't be kept, and says what to do.
    template <class Callable>
    requires(!Kept::template keeps<Callable> &&
             std::is_invocable_r_v<Response<Scalar>, Callable&, const MoveContact<Scalar>&>)
        ResponseAt(const Callable&) {
        static_assert(Kept::template keeps<Callable>, PIERCE_REFUSED_CALLABLE);
    }

    /// Whether there is one: without one `MoveOptions::response` holds everywhere.
    explicit operator bool() const { return static_cast<bool>(kept_); }
    /// Asks it.
    Response<Scalar> operator()(const MoveContact<Scalar>& contact) const { return kept_(contact); }

  private:
    Kept kept_;
};

/// What may be chosen for a move.
template <class Scalar>
struct MoveOptions {
    /// Which faces stop the particle, and from which side. `max_fraction` means nothing here.
    QueryOptions query = {};
    /// Of all faces, unless `response_at` says more. `move_and_slide` takes no more than the velocity of it.
    Response<Scalar> response = {};
    ResponseAt<Scalar> response_at = {};  ///< if given, asked at each contact in place of `response`
    /// 0: what moves is a point. More than 0: it is a ball of this radius, whose center goes from `position`.
    Scalar radius = 0;
    /// In a batch the radius of each, if they differ. Single calls don't look at it.
    std::span<const Scalar> radii = {};
    /// How many queries a move may take: one, and one for each contact. Each goes to a face that was not met before at
    /// that place, so most moves take one to four; long steps over fine meshes take one for each fold that they cross.
    int max_casts = 32;
};

/// How a move ended.
enum class MoveState : std::uint8_t {
    free,     ///< met nothing
    slid,     ///< met something, and goes on: along it, or off it
    resting,  ///< stands still on what it met: on a face, or in the crease of two; or goes with a mesh that moves
    wedged,   ///< stopped by three or more; or its queries were used up, or no place was left, without moving at all
    invalid,  ///< something was NaN or infinite, or time went back: nothing was moved, and the mesh counted it
    /// In a step of a mesh that moves: no place was found at its end, as between two sheets that meet. It was put where
    /// the mesh carries it, perhaps to the other side.
    crushed,
};

/// What became of a particle in one step.
template <class Scalar>
struct Move {
    Vec3<Scalar> position;              ///< where the particle is after the step
    Vec3<Scalar> velocity;              ///< exactly 0 where it rests
    Vec3<Scalar> travel;                ///< `position` less where it began
    Vec3<Scalar> remainder;             ///< the way left undone, where the queries were used up; else 0
    std::size_t contacts = 0;           ///< how many there were, those included for which there was no room
    int casts = 0;                      ///< queries
    MoveState state = MoveState::free;  ///< how it ended
};

/// Moves a particle by one step of `seconds` at `velocity`, with gravity and the like already in it, sliding without
/// friction along what it meets. Where it meets several faces at once it goes on as `slide` says.
///
/// The way to `position` has no hit under `options.query`, nor has any part of it, so that a chain of moves can't get
/// through the mesh, at no distance from the origin and with no skin. Where it slides, each target is a representable
/// point that is certified, exactly, to lie in front of the planes of all faces that it slides along, as a rule a grain
/// (`Hit::point`) from them: so no step is eaten by rounding, and a slide keeps its way. What rests is not moved, not
/// by one bit: the result is then that of the step before, as long as velocity and options are. (In a sharp tip it
/// takes two or three steps to come to rest: each ends where the particle is stopped, `resting`.) Particles fed the
/// same velocity in the same place do the same on every machine.
///
/// A face is met where the way goes into it, and the particle is left where it is if that is within four grains of the
/// face's plane. So a resting particle takes one query for each face that it rests on, and a sliding one another: one
/// at rest some 1.5 to 2 times as long as one that is free a little above the ground, as it has a hit, the hit's plane
/// and a response as well. (As its answer stays the same, a caller may leave it out until its velocity or something
/// around it changes.) A way shorter than eight grains is first looked along for that distance, for what it is in
/// contact with, so slow particles that are free take two. One that is not to move at all meets nothing and takes none,
/// also where a surface moves. Without friction nothing stops what swings at the bottom of a fold.
///
/// Contacts are written in order to `contacts`, as many as fit. Allocates nothing. Throws nothing.
///
/// Sources: the order of planes, crease and stop are those of Quake's and Quake 3's player movement (id Software 1996,
/// 1999; the idea only), stop and go on that of K. Fauerby (Improved collision detection and response, 2003). Both keep
/// a distance from what they hit, and both take planes one after the other; here there is no distance, and the velocity
/// is the nearest one that goes into no plane, which does not depend on their order.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Move<Scalar> move_and_slide(
    const CollisionMesh<Scalar>& mesh, const std::type_identity_t<Vec3<Scalar>>& position,
    const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
    const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {}) noexcept;

/// The same with all of `Response`: impacts above `rest_speed` bounce, others slide, both with friction. Where several
/// faces hold it at once the friction of each counts, by how hard it holds.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Move<Scalar> move_and_bounce(
    const CollisionMesh<Scalar>& mesh, const std::type_identity_t<Vec3<Scalar>>& position,
    const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
    const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {}) noexcept;

/// The same as `move_and_slide` above, in a step of a mesh that moves.
///
/// **Balls.** With `MoveOptions::radius` both calls move a ball, which slides along faces and round edges and corners.
/// Each of its ways is clear by the exact rule of `SphereHit`: it penetrates nothing at the end or on the way that it
/// did not in the beginning, and that no deeper. `QueryOptions::sides` says nothing then. All that is said above of
/// particles is true of it, with the distance from the triangle less the radius in place of that from the plane, and
/// with a grain that is in double at least 2^-45 of the distance of the mesh's furthest point. Faces that go on in one
/// plane have no edges for it. One that overlaps the mesh from the beginning slides along what it overlaps, and is not
/// pushed out (`sphere_contacts` says how). A radius below 0, NaN or infinity is invalid.
///
/// **Meshes that move.** In a step of a `DeformingMesh` the particle goes on for `seconds` while the mesh goes from
/// `before` to `after`. The velocity of the mesh at each contact enters the response, with that of `Response` on top: a
/// wall that comes pushes, and what friction holds goes with the mesh. `seconds` must be above 0, a radius must be 0.
///
/// What is promised: the straight way from `position` to the one returned, over the whole step, has no contact under
/// `options.query` (`DeformationStep::sweep`), unless the state is `crushed`. So a chain of moves, one for each step,
/// can't get through the mesh, however it moves. The way with its bends can't be asked about, as the mesh at a time
/// within a step has no representable corners: velocity, contacts and the place in the end are those of that way,
/// computed in double, and the short cut to that place is what is certified. What lies within a bend and is not on the
/// short cut is not met. Where the short cut meets what the bent way does not, or no way is found in `max_casts`, the
/// particle goes with what it met first to the end of the step (`SweepHit::place`), as fast as it was left by the
/// contacts; `remainder` has the way lost. So the motion is truer in short steps. One query is always made, and what
/// rests takes two; it goes with the mesh to within the rounding of a step, and on a part of the mesh that stands still
/// it does not move by one bit.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Move<Scalar> move_and_slide(
    const DeformationStep<Scalar>& step, const std::type_identity_t<Vec3<Scalar>>& position,
    const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
    const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {}) noexcept;
/// The same with impacts and friction, as `move_and_bounce` on a mesh that stands still.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Move<Scalar> move_and_bounce(
    const DeformationStep<Scalar>& step, const std::type_identity_t<Vec3<Scalar>>& position,
    const std::type_identity_t<Vec3<Scalar>>& velocity, std::type_identity_t<Scalar> seconds,
    const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {}) noexcept;

/// Where to draw a particle that touches something, for looks: `position` moved off the planes of the first
/// `k_most_planes` contacts of its last move to a distance of `skin`, within a hundredth or so, or as far that way as
/// nothing is hit. Not to be moved on from: what is drawn is no part of the motion, which needs no skin. A `skin` that
/// is not above 0 or not finite, and planes that leave no such place within eight skins, give `position`.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT Vec3<Scalar> lifted(const CollisionMesh<Scalar>& mesh,
                                                const std::type_identity_t<Vec3<Scalar>>& position,
                                                std::type_identity_t<std::span<const MoveContact<Scalar>>> contacts,
                                                std::type_identity_t<Scalar> skin,
                                                const QueryOptions& options = {}) noexcept;

/// Many particles in one call: `out[i]` is what the single call for number i gives, to the last bit, whatever the
/// executor. `out` may hold the positions and velocities that are read (`PointsView(&out[0].position[0], n,
/// sizeof(Move))`). Returns how many met something. If `contacts` is not empty, its first part of
/// `contacts.size() / out.size()` is that of particle 0, the next that of particle 1, and so on. Allocates nothing.
/// Throws std::invalid_argument, naming the call and both lengths, where they differ; nothing is moved then.
template <class Scalar>
PIERCE_EXPORT std::size_t moves_and_slide(
    const CollisionMesh<Scalar>& mesh, const std::type_identity_t<PointsView<Scalar>>& positions,
    const std::type_identity_t<PointsView<Scalar>>& velocities, std::type_identity_t<Scalar> seconds,
    std::type_identity_t<std::span<Move<Scalar>>> out, const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    const Executor& executor = {}, std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {});
/// Many of `move_and_bounce`, in the same way.
template <class Scalar>
PIERCE_EXPORT std::size_t moves_and_bounce(
    const CollisionMesh<Scalar>& mesh, const std::type_identity_t<PointsView<Scalar>>& positions,
    const std::type_identity_t<PointsView<Scalar>>& velocities, std::type_identity_t<Scalar> seconds,
    std::type_identity_t<std::span<Move<Scalar>>> out, const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    const Executor& executor = {}, std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {});

/// Many particles in a step of a mesh that moves, in the same way.
template <class Scalar>
PIERCE_EXPORT std::size_t moves_and_slide(
    const DeformationStep<Scalar>& step, const std::type_identity_t<PointsView<Scalar>>& positions,
    const std::type_identity_t<PointsView<Scalar>>& velocities, std::type_identity_t<Scalar> seconds,
    std::type_identity_t<std::span<Move<Scalar>>> out, const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    const Executor& executor = {}, std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {});
/// The same with impacts and friction.
template <class Scalar>
PIERCE_EXPORT std::size_t moves_and_bounce(
    const DeformationStep<Scalar>& step, const std::type_identity_t<PointsView<Scalar>>& positions,
    const std::type_identity_t<PointsView<Scalar>>& velocities, std::type_identity_t<Scalar> seconds,
    std::type_identity_t<std::span<Move<Scalar>>> out, const std::type_identity_t<MoveOptions<Scalar>>& options = {},
    const Executor& executor = {}, std::type_identity_t<std::span<MoveContact<Scalar>>> contacts = {});

}  // namespace pierce
