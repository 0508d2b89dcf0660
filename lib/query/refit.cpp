// What a refit goes by, and the refit of all.
#include <query/refit.h>

#include <cstring>

#include <chunks.h>
#include <cluster/frame.h>
#include <cluster/make_clusters.h>
#include <mesh/check_mesh.h>
#include <query/refit_cluster.h>

namespace pierce::detail {

namespace {

// Clusters of a part of the work: about as many triangles as k_chunk.
constexpr std::size_t k_clusters = k_chunk / 4;

template <class Scalar>
Quad<Scalar> quad_at(const Scalar* from) {
    return Quad<Scalar>{from[0], from[1], from[2], 0};
}

}  // namespace

template <class Scalar>
Refit<Scalar>::Refit(const Scene<Scalar>& scene)
    : shape_(shape_of(scene.tree, {scene.cluster_refs.data(), scene.cluster_refs.size()}, scene.clusters.empty)),
      boxes_(shape_),
      numbers_(scene.triangles.size()),
      now_(3 * scene.vertex_count),
      next_(3 * scene.vertex_count),
      touched_(shape_.clusters.size()),
      dirty_(shape_.nodes.size()) {
    read_positions(scene);
    read_clusters(scene);
    unite_boxes(shape_, boxes_);
    cost_when_built_ = expected_cost(shape_, boxes_, scene.frame.unit);
}

// Those of vertices that no triangle has are 0.
template <class Scalar>
void Refit<Scalar>::read_positions(const Scene<Scalar>& scene) {
    std::fill(now_.begin(), now_.end(), Scalar(0));
    const auto place = [&](std::uint32_t number, const Corners& corners) {
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                now_[3 * std::size_t{scene.triangles[number][k]} + axis] = static_cast<Scalar>(corners[k][axis]);
    };
    scene.each_triangle([&](TriangleRef triangle) { place(scene.number_of(triangle), scene.corners(triangle)); });
    for (const auto& [number, corners] : scene.degenerate) place(number, corners);
}

template <class Scalar>
void Refit<Scalar>::read_clusters(const Scene<Scalar>& scene) {
    for (const auto& triangle : scene.degenerate) homeless_.push_back(triangle.number);
    for (std::size_t c = 0; c < shape_.clusters.size(); ++c) {
        const ClusterRef ref = shape_.clusters[c].ref;
        QuadBox<Scalar> box;
        for (std::uint32_t lane = 0; lane < count_of(ref); ++lane) {
            const std::uint32_t number = numbers_[first_of(ref) + lane] = scene.clusters.triangle(ref, lane);
            for (const std::uint32_t vertex : scene.triangles[number]) {
                const Quad<Scalar> corner = quad_at(&now_[3 * std::size_t{vertex}]);
                box.add({corner, corner});
            }
        }
        boxes_.clusters[c].ref = ref;
        set_box(boxes_.clusters[c], box);
    }
}

template <class Scalar>
void Refit<Scalar>::rewrite_all(Scene<Scalar>& scene, const RawArray<Scalar>& positions, Numbers& degenerate,
                                const Executor& executor) {
    std::vector<Numbers> parts(chunks_of(shape_.clusters.size(), k_clusters));
    std::atomic<bool> renamed = false;
    each_chunk(
        executor, shape_.clusters.size(),
        [&](std::size_t chunk, std::size_t begin, std::size_t end) {
            RecordRewriter<Scalar> rewriter(mesh(scene, positions), numbers_, scene.clusters);
            bool any = false;
            for (std::size_t c = begin; c < end; ++c)
                any |= rewriter.rewrite(shape_.clusters[c], boxes_.clusters[c], parts[chunk]);
            if (any) renamed.store(true, std::memory_order_relaxed);
        },
        k_clusters);
    for (const Numbers& part : parts) degenerate.insert(degenerate.end(), part.begin(), part.end());
    renamed_ = renamed_ || renamed;
    unite_boxes(shape_, boxes_);
}

template <class Scalar>
bool Refit<Scalar>::all(Scene<Scalar>& scene, const PointsView<Scalar>& positions, const BuildOptions& options,
                        const Executor& executor) {
    const bool plain = positions.data() != nullptr && positions.stride() == std::ptrdiff_t{3 * sizeof(Scalar)};
    each_chunk(executor, scene.vertex_count, [&](std::size_t, std::size_t begin, std::size_t end) {
        if (plain)
            std::memcpy(&next_[3 * begin], positions.data() + 3 * begin, 3 * (end - begin) * sizeof(Scalar));
        else
            for (std::size_t v = begin; v < end; ++v)
                std::memcpy(&next_[3 * v], positions[v].data(), 3 * sizeof(Scalar));
    });
    check_positions(view(next_), executor);
    for (const std::uint32_t triangle : homeless_)
        if (has_area(mesh(scene, next_), triangle)) return false;

    Numbers degenerate = homeless_;
    rewrite_all(scene, next_, degenerate, executor);
    const QuadBox<Scalar> box = box_of_all();
    const auto restore = [&] {
        Numbers none;
        rewrite_all(scene, now_, none, executor);
    };
    const std::optional<double> unit = unit_or_undo(box, restore);
    if (!unit) return false;
    std::swap(now_, next_);
    set_bounds(scene, box, frame_around(in_scene_units<Scalar>(box.low, box.high, *unit), *unit));
    if (scene.broadphase == Broadphase::tree) write_bounds(shape_, boxes_, scene.frame, scene.tree, executor);
    set_names(scene);
    if (scene.broadphase == Broadphase::grid) make_new_grid(scene, options, executor);
    keep_degenerate(scene, degenerate);
    return true;
}

template <class Scalar>
QuadBox<Scalar> Refit<Scalar>::box_of_all() const {
    if (!shape_.nodes.empty()) return boxes_.nodes[0];
    QuadBox<Scalar> all;
    for (const ClusterBox<Scalar>& box : boxes_.clusters) all.add(box_of<Scalar>(box));
    return all;
}

/// Of the clusters that have triangles now.
template <class Scalar>
void Refit<Scalar>::set_names(Scene<Scalar>& scene) {
    if (!renamed_) return;
    const auto has_triangles = [&](const ClusterBox<Scalar>& box) { return box.ref != scene.clusters.empty; };
    scene.cluster_refs = RawArray<ClusterRef>(
        static_cast<std::size_t>(std::count_if(boxes_.clusters.begin(), boxes_.clusters.end(), has_triangles)));
    ClusterRef* to = scene.cluster_refs.begin();
    for (const ClusterBox<Scalar>& box : boxes_.clusters)
        if (has_triangles(box)) *to++ = box.ref;
    renamed_ = false;
}

template <class Scalar>
void Refit<Scalar>::make_new_grid(Scene<Scalar>& scene, const BuildOptions& options, const Executor& executor) const {
    RawArray<ClusterBox<Scalar>> boxes(scene.cluster_refs.size());
    ClusterBox<Scalar>* to = boxes.begin();
    const auto unit = static_cast<Scalar>(scene.frame.unit);
    for (const ClusterBox<Scalar>& box : boxes_.clusters) {
        if (box.ref == scene.clusters.empty) continue;
        const QuadBox<Scalar> whole = box_of<Scalar>(box);
        *to = box;
        set_box(*to++, QuadBox<Scalar>{whole.low * unit, whole.high * unit});
    }
    scene.grid = make_grid<Scalar>({boxes.data(), boxes.size()}, scene.frame, options, executor);
}

template <class Scalar>
void Refit<Scalar>::keep_degenerate(Scene<Scalar>& scene, Numbers& degenerate) const {
    std::sort(degenerate.begin(), degenerate.end());
    scene.degenerate.clear();
    const PlainMesh<Scalar> at = mesh(scene, now_);
    for (const std::uint32_t number : degenerate) {
        const IndexTriple& t = at.triangles[number];
        scene.degenerate.push_back(
            {number, {to_point(at.positions[t[0]]), to_point(at.positions[t[1]]), to_point(at.positions[t[2]])}});
    }
}

template <class Scalar>
double Refit<Scalar>::cost(const Scene<Scalar>& scene) const {
    return cost_when_built_ > 0 ? expected_cost(shape_, boxes_, scene.frame.unit) / cost_when_built_ : 1;
}

template <class Scalar>
std::size_t Refit<Scalar>::bytes() const {
    const auto bytes_of = [](const Numbers& numbers) { return numbers.capacity() * sizeof(std::uint32_t); };
    return sizeof(*this) + shape_.bytes() + boxes_.bytes() + bytes_of(numbers_) + bytes_of(homeless_) + now_.bytes() +
           next_.bytes() + bytes_of(first_of_vertex_) + bytes_of(clusters_of_vertex_) + touched_.bytes() +
           dirty_.bytes();
}

template class Refit<float>;
template class Refit<double>;

}  // namespace pierce::detail
