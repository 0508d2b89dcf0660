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
    std::uint32_t index = 0xffffffff;
    std::uint32_t generation = 0;  ///< of one that was given away: at least 1

    friend constexpr bool operator==(const MeshId&, const MeshId&) = default;
};

/// A hit and the mesh that is hit. Plain memory: a `Hit`, and the id right behind it.
///
/// `hit.face`, `triangle`, `side`, `feature` and `barycentric` are those of the mesh. `point`, `position` and `normal`
/// are in the world. `fraction` and `exact_fraction` are as in `Hit`, of the local image of the way (`World`).
template <class Scalar>
struct WorldHit {
    Hit<Scalar> hit;
    MeshId mesh;

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

template <class Scalar>
inline constexpr WorldHit<Scalar> no_world_hit = {no_hit<Scalar>, {}};

/// `Accept` for worlds: called with the mesh and a `Contact` in its coordinates, says whether that counts. What is said
/// there of what it may be, and of how often it is asked, holds here.
class WorldAccept {
    using Kept = detail::SmallCallable<bool(MeshId, const Contact&)>;

  public:
    WorldAccept() = default;
    template <class Callable>
    requires(Kept::keeps<Callable>) WorldAccept(const Callable& callable) : kept_(callable) {}
    template <class Callable>
    requires(!Kept::keeps<Callable> && std::is_invocable_r_v<bool, Callable&, MeshId, const Contact&>)
        WorldAccept(const Callable&) {
        static_assert(Kept::template keeps<Callable>, PIERCE_REFUSED_CALLABLE);
    }

    explicit operator bool() const { return static_cast<bool>(kept_); }
    bool operator()(MeshId mesh, const Contact& contact) const { return kept_(mesh, contact); }

  private:
    Kept kept_;
};

/// As `QueryOptions`. What an option leaves out hides nothing behind it.
struct WorldOptions {
    Sides sides = Sides::front;
    double max_fraction = std::numeric_limits<double>::infinity();
    /// Only meshes count whose layers have a bit of it, and of a mesh with face layers only faces that have one too.
    std::uint32_t mask = 0xffffffff;
    WorldAccept accept = {};
    QueryCounters* counters = nullptr;
};

/// For queries that count crossings: whole meshes are in or out, as a surface with holes has no inside.
struct WorldCountOptions {
    std::uint32_t mask = 0xffffffff;
    QueryCounters* counters = nullptr;
};

/// Hits as one array for each of their members, as in `HitArrays`, and their meshes; for a miss that is `MeshId{}`.
template <class Scalar>
struct WorldHitArrays {
    HitArrays<Scalar> hits;
    MeshId* mesh = nullptr;
};

/// Where a batch writes its hits. A miss is `no_world_hit` in plain memory.
template <class Scalar>
using WorldHitsOut =
    std::variant<std::span<std::optional<WorldHit<Scalar>>>, std::span<WorldHit<Scalar>>, WorldHitArrays<Scalar>>;

}  // namespace pierce
