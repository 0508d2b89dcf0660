// The refit of what is around some vertices.
#include <query/refit.h>

#include <algorithm>
#include <cstring>

#include <cluster/frame.h>
#include <cluster/make_clusters.h>
#include <mesh/check_mesh.h>
#include <query/refit_cluster.h>

namespace pierce::detail {

namespace {

// Whether all bounds are in [1, 65534] on the lattice, as frame_around has them, and its cells are not much larger than
// the scene asks for.
[[nodiscard]] bool still_fits(const Frame& frame, const QuadBox<double>& scene) {
    for (int k = 0; k < 3; ++k)
        if (!(scene.low[k] - frame.low[k] >= 1.25 * frame.step && scene.high[k] - frame.low[k] <= 65533 * frame.step))
            return false;
    return largest_of<double>(scene.high - scene.low) >= 0x1p13 * frame.step;
}

// A frame for half as much again as there is, a quarter at each end: the scene is less than 1 wide in its units, so it
// ends before 2. One that moves on does not need a new frame each time.
[[nodiscard]] Frame roomy_frame(const QuadBox<double>& scene, double unit) {
    const Quad<double> room = all_of(largest_of<double>(scene.high - scene.low) / 4);
    Frame frame = frame_around({scene.low - room, scene.high + room}, unit);
    for (int k = 0; k < 3; ++k) frame.high[k] = scene.high[k];
    return frame;
}

}  // namespace

/// Counted, then listed: entries of a vertex are one behind the other, in the order of clusters, each once.
template <class Scalar>
void Refit<Scalar>::find_clusters_of_vertices(const Scene<Scalar>& scene) {
    const auto each = [&](auto&& visit) {
        for (std::uint32_t c = 0; c < shape_.clusters.size(); ++c) {
            const ClusterRef ref = shape_.clusters[c].ref;
            for (std::uint32_t lane = 0; lane < count_of(ref); ++lane)
                for (const std::uint32_t v : scene.triangles[numbers_[first_of(ref) + lane]]) visit(v, c);
        }
        for (const std::uint32_t number : homeless_)
            for (const std::uint32_t v : scene.triangles[number]) visit(v, k_leaf_bit | number);
    };
    constexpr std::uint32_t k_none = 0xffffffffU;
    Numbers latest(scene.vertex_count, k_none);
    const auto each_once = [&](auto&& visit) {
        std::fill(latest.begin(), latest.end(), k_none);
        each([&](std::uint32_t v, std::uint32_t entry) {
            if (latest[v] != entry) visit(v, latest[v] = entry);
        });
    };
    first_of_vertex_.assign(scene.vertex_count + 1, 0);
    each_once([&](std::uint32_t v, std::uint32_t) { ++first_of_vertex_[v + 1]; });
    for (std::size_t v = 0; v < scene.vertex_count; ++v) first_of_vertex_[v + 1] += first_of_vertex_[v];
    clusters_of_vertex_.resize(first_of_vertex_.back());
    Numbers next = first_of_vertex_;
    each_once([&](std::uint32_t v, std::uint32_t entry) { clusters_of_vertex_[next[v]++] = entry; });
}

/// Marks the clusters around changed vertices. False: a triangle got area that has no cluster.
template <class Scalar>
bool Refit<Scalar>::touch(const Scene<Scalar>& scene, std::span<const std::uint32_t> changed) {
    touched_.clear();
    for (const std::uint32_t v : changed)
        for (std::uint32_t i = first_of_vertex_[v]; i < first_of_vertex_[v + 1]; ++i) {
            const std::uint32_t entry = clusters_of_vertex_[i];
            if ((entry & k_leaf_bit) == 0)
                touched_.add(entry);
            else if (has_area(mesh(scene, now_), entry & ~k_leaf_bit))
                return false;
        }
    return true;
}

/// Records, boxes and names of the clusters that are marked, and boxes of all above.
template <class Scalar>
void Refit<Scalar>::rewrite_touched(Scene<Scalar>& scene, Numbers& degenerate) {
    RecordRewriter<Scalar> rewriter(mesh(scene, now_), numbers_, scene.clusters);
    dirty_.clear();
    touched_.each_down([&](std::uint32_t c) {
        const bool renamed = rewriter.rewrite(shape_.clusters[c], boxes_.clusters[c], degenerate);
        renamed_ = renamed_ || renamed;
        if (shape_.clusters[c].parent != k_no_parent) dirty_.add(shape_.clusters[c].parent);
    });
    unite_boxes(shape_, boxes_, dirty_);
}

template <class Scalar>
bool Refit<Scalar>::some(Scene<Scalar>& scene, const PointsView<Scalar>& positions,
                         std::span<const std::uint32_t> changed, const BuildOptions& options) {
    for (const std::uint32_t v : changed) check_position<Scalar>(v, positions[v]);
    if (first_of_vertex_.empty()) find_clusters_of_vertices(scene);
    const auto copy = [](Scalar* to, const Scalar* from) { std::memcpy(to, from, 3 * sizeof(Scalar)); };
    // A vertex may be named twice: all old positions are kept before there is a new one.
    for (const std::size_t v : changed) copy(&next_[3 * v], &now_[3 * v]);
    for (const std::size_t v : changed) copy(&now_[3 * v], positions[v].data());
    const auto restore_positions = [&] {
        for (const std::size_t v : changed) copy(&now_[3 * v], &next_[3 * v]);
    };
    const auto give_up = [&] {
        restore_positions();
        std::copy(now_.begin(), now_.end(), next_.begin());
        for (const std::size_t v : changed) copy(&next_[3 * v], positions[v].data());
        return false;
    };
    if (!touch(scene, changed)) return give_up();

    Numbers degenerate;
    rewrite_touched(scene, degenerate);
    const auto restore = [&] {
        restore_positions();
        Numbers none;
        rewrite_touched(scene, none);
    };
    const QuadBox<Scalar> box = box_of_all();
    const std::optional<double> unit = unit_or_undo(box, restore);
    if (!unit) return give_up();
    set_bounds_of_touched(scene, box, *unit);
    set_names(scene);
    if (scene.broadphase == Broadphase::grid) make_new_grid(scene, options, {});
    keep_degenerate_of_touched(scene, degenerate);
    return true;
}

/// The scene's unit stays as long as its frame does.
template <class Scalar>
void Refit<Scalar>::set_bounds_of_touched(Scene<Scalar>& scene, const QuadBox<Scalar>& box, double unit) {
    Frame frame = scene.frame;
    const QuadBox<double> bounds = in_scene_units<Scalar>(box.low, box.high, frame.unit);
    const bool fits = scene.broadphase == Broadphase::tree && still_fits(frame, bounds);
    if (fits)
        for (int k = 0; k < 3; ++k) frame.high[k] = bounds.high[k];
    else
        frame = roomy_frame(in_scene_units<Scalar>(box.low, box.high, unit), unit);
    set_bounds(scene, box, frame);
    if (scene.broadphase == Broadphase::grid) return;
    if (fits)
        write_bounds(shape_, boxes_, scene.frame, scene.tree, dirty_);
    else
        write_bounds(shape_, boxes_, scene.frame, scene.tree, Executor());
}

template <class Scalar>
void Refit<Scalar>::keep_degenerate_of_touched(Scene<Scalar>& scene, Numbers& degenerate) const {
    if (degenerate.empty() && scene.degenerate.empty()) return;
    Numbers seen;  // triangles whose cluster was looked at again
    touched_.each_down([&](std::uint32_t c) {
        const ClusterRef ref = shape_.clusters[c].ref;
        for (std::uint32_t lane = 0; lane < count_of(ref); ++lane) seen.push_back(numbers_[first_of(ref) + lane]);
    });
    std::sort(seen.begin(), seen.end());
    for (const auto& triangle : scene.degenerate)
        if (!std::binary_search(seen.begin(), seen.end(), triangle.number)) degenerate.push_back(triangle.number);
    keep_degenerate(scene, degenerate);
}

template bool Refit<float>::some(Scene<float>&, const PointsView<float>&, std::span<const std::uint32_t>,
                                 const BuildOptions&);
template bool Refit<double>::some(Scene<double>&, const PointsView<double>&, std::span<const std::uint32_t>,
                                  const BuildOptions&);

}  // namespace pierce::detail
