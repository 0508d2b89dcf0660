// The façade: segments in, hits out.
#include <pierce/collision_mesh.h>

#include <atomic>
#include <cmath>

#include <query/collectors.h>
#include <query/report.h>
#include <query/scene.h>
#include <query/traverse.h>

namespace pierce {

using namespace detail;

template <class Scalar>
struct CollisionMesh<Scalar>::Impl {
    Scene scene;
    std::atomic<std::uint64_t> invalid_queries = 0;

    // Whether a query has anything to ask; one with a coordinate that is not finite is counted.
    bool accepts(const Segment<Scalar>& segment, const QueryOptions& options) {
        if (!segment.from.allFinite() || !segment.to.allFinite()) {
            invalid_queries.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
        return options.max_fraction >= 0;  // false for NaN
    }

    // Sets the verified point. `before` are hits that lie strictly before this one, and so on the way to any point near it.
    void place(Hit<Scalar>& hit, const Path& path, std::span<const Hit<Scalar>> before, const QueryOptions& options,
               QueryCounters& counters) const {
        // A nearer limit was meant for the caller's own segment.
        QueryOptions whole = options;
        whole.max_fraction = 1;
        const auto clear = [&](const Point& point) {
            Any<Scalar> any(hit, before);  // verify() has seen to the hit's own triangle
            traverse(scene, {path.from, point}, whole, counters, any);
            return !any.found();
        };
        const int tries =
            verify(hit, path, scene.corners(hit.triangle), scene.prepared[hit.triangle].normal, clear);
        counters.retreats += static_cast<std::uint64_t>(tries);
    }

    Hit<Scalar> reported(const Path& path, const Candidate& candidate) const {
        // The filter does not tell an edge from a face, but it calls a hit only what is on neither edge nor corner.
        return report<Scalar>(path, scene.corners(candidate.triangle), scene.prepared[candidate.triangle].normal,
                              candidate.decision, scene.face_of(candidate.triangle), candidate.triangle);
    }
};

namespace {

template <class Scalar>
Path path_of(const Segment<Scalar>& segment) {
    return {to_point(segment.from), to_point(segment.to)};
}

QueryCounters& counters_of(const QueryOptions& options, QueryCounters& spare) {
    QueryCounters& counters = options.counters != nullptr ? *options.counters : spare;
    ++counters.queries;
    return counters;
}

}  // namespace

template <class Scalar>
CollisionMesh<Scalar>::CollisionMesh(const MeshView<Scalar>& mesh, const BuildOptions& options)
    : impl_(std::make_unique<Impl>()) {
    impl_->scene = make_scene(mesh, options);
}

template <class Scalar>
CollisionMesh<Scalar>::~CollisionMesh() = default;
template <class Scalar>
CollisionMesh<Scalar>::CollisionMesh(CollisionMesh&&) noexcept = default;
template <class Scalar>
CollisionMesh<Scalar>& CollisionMesh<Scalar>::operator=(CollisionMesh&&) noexcept = default;

template <class Scalar>
std::optional<Hit<Scalar>> CollisionMesh<Scalar>::first_hit(const Segment<Scalar>& segment,
                                                            const QueryOptions& options) const noexcept {
    QueryCounters spare;
    QueryCounters& counters = counters_of(options, spare);
    if (!impl_->accepts(segment, options)) return std::nullopt;
    const Path path = path_of(segment);
    First first(impl_->scene, path, counters);
    traverse(impl_->scene, path, options, counters, first);
    if (!first.found()) return std::nullopt;
    Hit<Scalar> hit = impl_->reported(path, first.best());
    impl_->place(hit, path, {}, options, counters);
    return hit;
}

template <class Scalar>
bool CollisionMesh<Scalar>::any_hit(const Segment<Scalar>& segment, const QueryOptions& options) const noexcept {
    QueryCounters spare;
    QueryCounters& counters = counters_of(options, spare);
    if (!impl_->accepts(segment, options)) return false;
    Any<Scalar> any;
    traverse(impl_->scene, path_of(segment), options, counters, any);
    return any.found();
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::all_hits(const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                                            const QueryOptions& options) const noexcept {
    QueryCounters spare;
    QueryCounters& counters = counters_of(options, spare);
    if (!impl_->accepts(segment, options)) return 0;
    const Path path = path_of(segment);
    All<Scalar> all(impl_->scene, path, out, counters);
    traverse(impl_->scene, path, options, counters, all);

    std::size_t strictly_before = 0;  // how many of the hits have a smaller fraction than the one at hand
    for (std::size_t i = 0; i < all.kept_count(); ++i) {
        const Candidate candidate = all.kept(i);
        if (i > 0 && compare_fractions(path, impl_->scene.corners(out[i - 1].triangle),
                                       impl_->scene.corners(candidate.triangle)) < 0)
            strictly_before = i;
        out[i] = impl_->reported(path, candidate);
        impl_->place(out[i], path, out.first(strictly_before), options, counters);
    }
    return all.total();
}

template <class Scalar>
std::optional<SweepHit<Scalar>> CollisionMesh<Scalar>::sweep(const Vec3<Scalar>& from, const Vec3<Scalar>& to,
                                                             const QueryOptions& options) const noexcept {
    const std::optional<Hit<Scalar>> hit = first_hit({from, to}, options);
    if (!hit) return std::nullopt;
    return SweepHit<Scalar>{*hit, hit->fraction};
}

template <class Scalar>
MeshStatistics CollisionMesh<Scalar>::statistics() const noexcept {
    const Scene& scene = impl_->scene;
    MeshStatistics s;
    s.vertices = scene.positions.size();
    s.faces = scene.face_count;
    s.triangles = scene.triangles.size();
    s.degenerate = scene.degenerate;
    s.duplicates = scene.duplicates;
    for (std::size_t k = 0; k < 3; ++k) s.grid_cells[k] = static_cast<std::uint32_t>(scene.grid.shape().cells[k]);
    s.grid_references = scene.grid.entry_count();
    s.bytes = scene.bytes();
    s.invalid_queries = impl_->invalid_queries.load(std::memory_order_relaxed);
    return s;
}

template class CollisionMesh<float>;
template class CollisionMesh<double>;

}  // namespace pierce
