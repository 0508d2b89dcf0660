// Records and boxes of kept clusters, their order, and whether they are to be kept.
#include <query/rebuild.h>

#include <chunks.h>
#include <cluster/frame.h>
#include <cluster/morton_key.h>
#include <cluster/sort_entries.h>
#include <query/refit_cluster.h>
#include <tree/make_tree.h>

namespace pierce::detail {

namespace {

// Clusters of a part of the work: about as many triangles as k_chunk.
constexpr std::size_t k_clusters = k_chunk / 4;

// Clusters are kept while their spread is within this of what it was. It grows where they are torn apart; where it
// shrinks triangles were, and others may be nearer to one another. What it does not see is small: after so many times
// they are made anew in any case. Measured on a sphere of 100,000 and a terrain of 80,000 faces that wave, turn, are
// twisted or stretched: what a query may expect to go through (tree/refit.h: expected_cost) is 1 to 5 % more than in a
// fresh build, 8 % in the worst frame of a wave on the terrain.
constexpr double k_most_spread = 1.03;
constexpr double k_least_spread = 0.85;
constexpr unsigned k_most_times = 7;

/// The areas of clusters' boxes in parts of those of their triangles' boxes, of some that are evenly spread over all:
/// the same whatever the scene's size and place. `corner(ref, lane, k)` as four doubles. No number, or infinite, where
/// areas are.
template <class Scalar, class CornerOf>
double spread_of(const Scene<Scalar>& scene, CornerOf&& corner) {
    const std::size_t stride = std::max<std::size_t>(4, scene.cluster_refs.size() / 512);
    double whole = 0;
    double parts = 0;
    for (std::size_t c = 0; c < scene.cluster_refs.size(); c += stride) {
        const ClusterRef ref = scene.cluster_refs[c];
        QuadBox<double> box;
        for (unsigned lane = 0; lane < count_of(ref); ++lane) {
            QuadBox<double> own;
            for (unsigned k = 0; k < 3; ++k) {
                const Quad<double> x = corner(ref, lane, k);
                own.add({x, x});
            }
            parts += own.area();
            box.add(own);
        }
        whole += box.area();
    }
    return whole / parts;
}

template <class Scalar>
double spread_in_records(const Scene<Scalar>& scene) {
    return spread_of(scene, [&](ClusterRef ref, unsigned lane, unsigned k) {
        const Scalar* const x = scene.clusters.record(ref) + lane;
        const std::size_t n = count_of(ref);
        const auto at = [&](std::size_t axis) { return static_cast<double>(x[(3 * k + axis) * n]); };
        return Quad<double>{at(0), at(1), at(2), 0};
    });
}

template <class Scalar>
double spread_at(const Scene<Scalar>& scene, const PlainMesh<Scalar>& mesh) {
    const CornerReader<Scalar> reader(mesh);
    return spread_of(scene, [&](ClusterRef ref, unsigned lane, unsigned k) {
        const Quad<Scalar> x = reader.corner(reader.triangle(scene.clusters.triangle(ref, lane))[k]);
        return __builtin_convertvector(x, Quad<double>);
    });
}

template <class Scalar>
bool are_good(const Scene<Scalar>& scene, const PlainMesh<Scalar>& mesh, KeptClusters& kept) {
    if (kept.times == k_most_times) return false;
    if (kept.spread == 0) kept.spread = spread_in_records(scene);
    const double share = spread_at(scene, mesh) / kept.spread;
    return share >= k_least_spread && share <= k_most_spread;  // false for NaN
}

/// Of the triangle at each place: there is no place without one.
template <class Scalar>
RawArray<std::uint32_t> read_numbers(const Scene<Scalar>& scene, const Executor& executor) {
    RawArray<std::uint32_t> numbers(scene.triangles.size());
    each_chunk(
        executor, scene.cluster_refs.size(),
        [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const ClusterRef ref = scene.cluster_refs[c];
                for (unsigned lane = 0; lane < count_of(ref); ++lane)
                    numbers[first_of(ref) + lane] = scene.clusters.triangle(ref, lane);
            }
        },
        k_clusters);
    return numbers;
}

/// Records again, and the box of each cluster, in the caller's coordinates. False: a triangle has lost its area.
template <class Scalar>
bool write_records(Scene<Scalar>& scene, const PlainMesh<Scalar>& mesh, RawArray<ClusterBox<Scalar>>& boxes,
                   QuadBox<Scalar>& all, const Executor& executor) {
    const RawArray<std::uint32_t> numbers = read_numbers(scene, executor);
    std::vector<QuadBox<Scalar>> bounds(chunks_of(boxes.size(), k_clusters));
    std::atomic<bool> lost = false;
    each_chunk(
        executor, boxes.size(),
        [&](std::size_t chunk, std::size_t begin, std::size_t end) {
            RecordRewriter<Scalar> rewriter(mesh, {numbers.data(), numbers.size()}, scene.clusters);
            std::vector<std::uint32_t> degenerate;
            QuadBox<Scalar> sum;
            for (std::size_t c = begin; c < end && degenerate.empty(); ++c) {
                boxes[c].ref = scene.cluster_refs[c];
                rewriter.rewrite({boxes[c].ref, k_no_parent}, boxes[c], degenerate);
                sum.add(box_of<Scalar>(boxes[c]));
            }
            bounds[chunk] = sum;
            if (!degenerate.empty()) lost.store(true, std::memory_order_relaxed);
        },
        k_clusters);
    for (const QuadBox<Scalar>& part : bounds) all.add(part);
    return !lost;
}

/// In Morton order of their centres, with the keys of these, and in scene units.
template <class Scalar>
RawArray<ClusterBox<Scalar>> in_order(const RawArray<ClusterBox<Scalar>>& boxes, const QuadBox<Scalar>& all,
                                      Scalar unit, const Executor& executor) {
    const KeyRaster<Scalar> raster(all.low * Scalar(0.5), all.high * Scalar(0.5));
    RawArray<std::uint64_t> entries(boxes.size());
    RawArray<std::uint64_t> sorted(boxes.size());
    each_chunk(executor, boxes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; i += 4)
            put_keys<Scalar>(
                raster, std::min<std::size_t>(end - i, 4), &entries[i],
                [&](std::size_t lane) { return half_center(box_of<Scalar>(boxes[i + lane])); },
                [&](std::size_t lane) { return static_cast<std::uint32_t>(i + lane); });
    });
    sort_entries(entries.data(), sorted.data(), sorted.size(), executor);
    RawArray<ClusterBox<Scalar>> out(boxes.size());
    each_chunk(executor, boxes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            ClusterBox<Scalar> box = boxes[static_cast<std::uint32_t>(sorted[i])];
            box.key = static_cast<std::uint32_t>(sorted[i] >> 32);
            for (int k = 0; k < 3; ++k) {
                box.low[k] *= unit;
                box.high[k] *= unit;
            }
            out[i] = box;
        }
    });
    return out;
}

}  // namespace

// Where coordinates that are not 0 are within 2^45 of 1 (double: 2^450), their differences that are not 0 are above
// 2^-69 (2^-503), so a mesh is at most 2^114 (2^953) of its extents from the origin; 2^121 (2^1017) are too many
// (cluster/make_clusters.cpp).
template <class Scalar>
bool always_builds(std::span<const Vec3<Scalar>> positions) {
    constexpr Scalar k_most = sizeof(Scalar) == sizeof(float) ? Scalar(0x1p45) : Scalar(0x1p450);
    const std::size_t count = positions.size();
    if (count == 0) return true;
    const Scalar* const from = positions[0].data();
    const auto sound = [](const Quad<Scalar>& x) __attribute__((always_inline)) {
        const Quad<Scalar> size = most(x, -x);
        return (size <= k_most) & ((size >= 1 / k_most) | (x == Scalar(0)));
    };
    auto all = Quad<Scalar>{} == Quad<Scalar>{};
    std::size_t i = 0;
    for (; i + 4 <= 3 * count; i += 4) {
        Quad<Scalar> x;
        std::memcpy(&x, from + i, sizeof x);
        all &= sound(x);
    }
    for (; i < 3 * count; ++i) all &= sound(all_of(from[i]));
    return (all[0] & all[1] & all[2] & all[3]) != 0;
}

template <class Scalar>
bool rebuild_on_clusters(Scene<Scalar>& scene, std::span<const Vec3<Scalar>> positions, const BuildOptions& options,
                         KeptClusters& kept, const Executor& executor) {
    // Without area a triangle is in no record: who gets it or loses it has no place.
    if (scene.empty() || !scene.degenerate.empty()) return false;
    const PlainMesh<Scalar> mesh{positions, {scene.triangles.data(), scene.triangles.size()}, {}};
    if (!are_good(scene, mesh, kept)) return false;
    ++kept.times;

    RawArray<ClusterBox<Scalar>> written(scene.cluster_refs.size());
    QuadBox<Scalar> all;
    if (!write_records(scene, mesh, written, all, executor)) return false;
    scene.tree = {};
    scene.grid = {};
    const Scalar unit = scene_unit(all);
    set_bounds(
        scene, all,
        frame_around(in_scene_units<Scalar>(all.low, all.high, static_cast<double>(unit)), static_cast<double>(unit)));
    RawArray<ClusterBox<Scalar>> boxes = in_order(written, all, unit, executor);
    const std::span span(boxes.data(), boxes.size());
    if (scene.broadphase == Broadphase::grid)
        scene.grid = make_grid<Scalar>(span, scene.frame, options, executor);
    else
        scene.tree = make_tree(span, scene.clusters.empty, scene.frame, executor);
    return true;
}

template bool always_builds(std::span<const Vec3<float>>);
template bool always_builds(std::span<const Vec3<double>>);
template bool rebuild_on_clusters(Scene<float>&, std::span<const Vec3<float>>, const BuildOptions&, KeptClusters&,
                                  const Executor&);
template bool rebuild_on_clusters(Scene<double>&, std::span<const Vec3<double>>, const BuildOptions&, KeptClusters&,
                                  const Executor&);

}  // namespace pierce::detail
