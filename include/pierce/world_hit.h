// What a query of a world is asked and answers: as for one mesh, and which of them it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <variant>

#include <pierce/batch.h>
#include <pierce/hit.h>
#include <pierce/options.h>
#include <pierce/small_callable.h>

namespace pierce {

/// Names a mesh of a world. The place of one that was removed is used again, with the next generation: so an id that is
/// kept too long is known to be stale. Places are given away lowest first where none was used before, else the one that
/// became free last.
struct MeshId {
    std::uint32_t index = 0xffffffff;  ///< its place; what no mesh has stands for none
    std::uint32_t generation = 0;      ///< of one that was given away: at least 1

    friend constexpr bool operator==(const MeshId&, const MeshId&) = default;
};

/// A hit and the mesh that is hit. Plain memory: a `Hit`, and the id right behind it.
///
/// `hit.face`, `triangle`, `side`, `feature` and `barycentric` are those of the mesh. `point`, `position` and `normal`
/// are in the world. `fraction` and `exact_fraction` are as in `Hit`, of the local image of the way (`World`).
template <class Scalar>
struct WorldHit {
    Hit<Scalar> hit;  ///< of that mesh, in the world where said above
    MeshId mesh;      ///< which one

    /// False for `no_world_hit`, with which batches fill the places of queries without a hit.
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(hit); }
};

namespace detail {

template <class Scalar>
constexpr bool has_documented_world_layout() {
    using H = WorldHit<Scalar>;
    return std::is_trivially_copyable_v<H> && std::is_standard_layout_v<H> &&
           offsetof(H, mesh) == sizeof(Hit<Scalar>) && sizeof(H) == sizeof(Hit<Scalar>) + 8;
}
static_assert(has_documented_world_layout<float>() && has_documented_world_layout<double>());

}  // namespace detail

/// What an array of hits has where a query has none: `no_hit`, and no mesh.
template <class Scalar>
inline constexpr WorldHit<Scalar> no_world_hit = {no_hit<Scalar>, {}};

/// `Accept` for worlds: called with the mesh and a `Contact` in its coordinates, says whether that counts. What is said
/// there of what it may be, and of how often it is asked, holds here.
class WorldAccept {
    using Kept = detail::SmallCallable<bool(MeshId, const Contact&)>;

  public:
    WorldAccept() = default;
    /// Keeps a copy of a callable.
    template <class Callable>
    requires(Kept::keeps<Callable>) WorldAccept(const Callable& callable) : kept_(callable) {}
    /// Refuses what can't be kept, and says what to do.
    template <class Callable>
    requires(!Kept::keeps<Callable> && std::is_invocable_r_v<bool, Callable&, MeshId, const Contact&>)
        WorldAccept(const Callable&) {
        static_assert(Kept::template keeps<Callable>, PIERCE_REFUSED_CALLABLE);
    }

    /// Whether there is one: without one every hit counts.
    explicit operator bool() const { return static_cast<bool>(kept_); }
    /// Asks it.
    bool operator()(MeshId mesh, const Contact& contact) const { return kept_(mesh, contact); }

  private:
    Kept kept_;
};

/// As `QueryOptions`. What an option leaves out hides nothing behind it.
struct WorldOptions {
    Sides sides = Sides::front;                                     ///< as in `QueryOptions`
    double max_fraction = std::numeric_limits<double>::infinity();  ///< as in `QueryOptions`
    /// Only meshes count whose layers have a bit of it, and of a mesh with face layers only faces that have one too.
    std::uint32_t mask = 0xffffffff;
    WorldAccept accept = {};            ///< if given, only hits count that it says yes to
    QueryCounters* counters = nullptr;  ///< adds up what was gone through, if given
};

/// For queries that count crossings: whole meshes are in or out, as a surface with holes has no inside.
struct WorldCountOptions {
    std::uint32_t mask = 0xffffffff;    ///< as in `WorldOptions`
    QueryCounters* counters = nullptr;  ///< as in `WorldOptions`
};

/// Hits as one array for each of their members, as in `HitArrays`, and their meshes; for a miss that is `MeshId{}`.
template <class Scalar>
struct WorldHitArrays {
    HitArrays<Scalar> hits;  ///< the arrays of all but the meshes
    MeshId* mesh = nullptr;  ///< the mesh of each hit
};

/// Where a batch writes its hits. A miss is `no_world_hit` in plain memory.
template <class Scalar>
using WorldHitsOut =
    std::variant<std::span<std::optional<WorldHit<Scalar>>>, std::span<WorldHit<Scalar>>, WorldHitArrays<Scalar>>;

}  // namespace pierce
