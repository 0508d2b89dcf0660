// What a caller may choose when a mesh is built and when a query is asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include <pierce/executor.h>
#include <pierce/types.h>

namespace pierce {

/// How the triangles near a segment are found. The answers are the same, to the last bit.
enum class Broadphase : std::uint8_t {
    automatic,  ///< what the environment variable PIERCE_BROADPHASE says, `tree` or `grid`; without it the tree
    tree,       ///< a tree of boxes with sixteen children a node: the faster one, whatever the mesh and the segments
    grid,       ///< one uniform grid, for meshes whose triangles are about as large as one another
};

/// None of these changes an answer: they trade memory and build time for query time.
struct BuildOptions {
    /// Building throws std::invalid_argument where PIERCE_BROADPHASE is another word.
    Broadphase broadphase = Broadphase::automatic;
    /// For the grid: the edge of a cell. Zero leaves it to the library, which looks at the triangles' sizes. It grows
    /// where the grid would take more memory than `max_grid_bytes`. Building throws std::invalid_argument for what
    /// is negative or not a number.
    double cell_size = 0;
    /// For the grid: an upper bound for its memory, kept by larger cells, down to what one cell for all needs. Zero
    /// stands for a multiple of the triangles' number.
    std::size_t max_grid_bytes = 0;
    /// Which wide kernels to use: `avx512`, `avx2`, `sse2`, `neon`, `plain`. If it is empty, the environment variable
    /// PIERCE_BACKEND says, and without that the machine's fastest. Building throws std::invalid_argument where the
    /// machine has none of the name.
    std::string_view backend = {};
    /// Builds in parallel, if given.
    Executor executor = {};
};

/// What a query went through, added up over the queries that were given the same counters. Not thread-safe: one for
/// each thread.
struct QueryCounters {
    std::uint64_t queries = 0;          ///< single ones, or those of batches
    std::uint64_t nodes = 0;            ///< nodes of the tree, or cells of the grid, visited
    std::uint64_t clusters = 0;         ///< clusters of up to eight triangles given to the wide kernels
    std::uint64_t triangles = 0;        ///< triangles that those could not refuse
    std::uint64_t exact_decisions = 0;  ///< triangles that the filter left doubtful
    std::uint64_t exact_orders = 0;     ///< pairs of hits too close to be ordered without exact arithmetic
    std::uint64_t exact_values = 0;     ///< times that fraction and weights, or the normal, took exact arithmetic
    std::uint64_t exact_sides = 0;      ///< points so close to a face's plane that their side took exact arithmetic
    std::uint64_t retreats = 0;         ///< places for verified points that were not clear
};

/// A hit before it is weighed against others: what `QueryOptions::accept` is asked about.
struct Contact {
    std::uint32_t face;          ///< the caller's number
    std::uint32_t triangle;      ///< its place in `MeshView::triangles`
    Sides side;                  ///< front or back
    Feature feature;             ///< what of it is hit, exactly
    std::uint8_t feature_index;  ///< as in `Hit`
    bool at_start;               ///< the exact fraction is 0
    double fraction;             ///< within 1 ulp, not verified
    Vec3<double> barycentric;    ///< weights of the corners, within 1 ulp of 1
};

/// Something that is called with a `Contact` and says whether it counts: a lambda, say, that looks up a texture.
///
/// It keeps what it is made of: a function pointer, or a lambda or other object of up to four pointers that is copied
/// byte by byte and does not change when it is called. What is larger, owns memory or changes is refused by the
/// compiler unless it is wrapped in `std::ref`; then it has to live as long as the options are used, as does what a
/// lambda captures by reference.
///
/// It may be asked about the same face more than once, also for the shortened segment to the point that is being
/// verified, so its answer must depend on the contact only. It must not throw.
class Accept {
    using Kept = detail::SmallCallable<bool(const Contact&)>;

  public:
    Accept() = default;
    /// Keeps a copy of a callable.
    template <class Callable>
    requires(Kept::keeps<Callable>) Accept(const Callable& callable) : kept_(callable) {}
    /// Refuses what can't be kept, and says what to do.
    template <class Callable>
    requires(!Kept::keeps<Callable> && std::is_invocable_r_v<bool, Callable&, const Contact&>) Accept(const Callable&) {
        static_assert(Kept::template keeps<Callable>, PIERCE_REFUSED_CALLABLE);
    }

    /// Whether there is one: without one every hit counts.
    explicit operator bool() const { return static_cast<bool>(kept_); }
    /// Asks it.
    bool operator()(const Contact& contact) const { return kept_(contact); }

  private:
    Kept kept_;
};

/// For a single query or a batch of them. A hit that an option leaves out hides nothing behind it: the answer is as if
/// it were not there.
struct QueryOptions {
    /// The side that a segment must come from to hit a triangle. The front by default, as in the one-sided tests that
    /// the library stands on, and in PhysX, Jolt and Unity; Embree, Bullet and Godot count both. A mesh whose triangles
    /// are clockwise seen from outside needs `back`; one that is open, or of mixed orientation, `both`.
    Sides sides = Sides::front;
    /// Only hits whose exact fraction, or t of a ray, is at most this count. NaN: no hit.
    double max_fraction = std::numeric_limits<double>::infinity();
    /// If it is not empty, only faces count whose number is a place in it that is not 0.
    std::span<const std::uint8_t> face_mask = {};
    /// If given, only hits count that it says yes to. In a batch with an executor it is called from that one's threads.
    Accept accept = {};
    /// Adds up what the query, or the batch, went through, if given.
    QueryCounters* counters = nullptr;
};

}  // namespace pierce
