// Triangles sorted by key, the order cut into ranges of at most eight, each written as a record.
#include <cluster/make_clusters.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <string>

#include <chunks.h>
#include <cluster/morton_order.h>
#include <cluster/write_cluster.h>
#include <pierce/mesh_error.h>

namespace pierce::detail {

namespace {

// So many triangles are cut and written as one part of the work. (The same for any executor.)
constexpr std::uint32_t k_part = 1U << 12;
// Clusters with more than ten times the area that one has when the scene's is shared out, with one for five triangles,
// are split where that pays.
constexpr double k_large = 10 * 5;

template <class Scalar>
struct Part {
    Range range;
    std::vector<ClusterBox<Scalar>> boxes;
    std::vector<std::uint32_t> degenerate;
    std::size_t first = 0;  // of its boxes among all
    std::exception_ptr failure;
};

template <class Scalar>
void write_part(Part<Scalar>& part, const CornerReader<Scalar>& reader, std::uint64_t* entries,
                ClusterWriter<Scalar> writer) {
    const Executor alone;
    RangeCutter<Scalar> cutter(reader, entries, alone);
    part.boxes.reserve(part.range.size() / 4 + 8);
    cutter.template cut_small<k_most_in_cluster>(
        part.range, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t key) {
            writer.write(begin, end, key, part.range.end, part.boxes, part.degenerate);
        });
}

// The scene's largest extent times this is in [0.5, 1), halved first since the difference of the largest numbers
// overflows; but half of the least number is 0. For the largest scenes it is subnormal, which is exact as well: a scene
// of several units would have larger errors than slab tests allow for.
template <class Scalar>
Scalar unit_by_extent(const QuadBox<Scalar>& box) {
    const Scalar half_extent = largest_of<Scalar>(box.high * Scalar(0.5) - box.low * Scalar(0.5));
    if (half_extent >= 1) return std::ldexp(Scalar(1), -2 - std::ilogb(half_extent));
    if (half_extent > 0) return power_to_reach(-2, half_extent);
    const Scalar extent = largest_of<Scalar>(box.high - box.low);
    return extent > 0 ? power_to_reach(-1, extent) : Scalar(1);
}

template <class Scalar>
void write_empty_record(Clusters<Scalar>& clusters, std::size_t place) {
    Scalar* record = clusters.records.data() + k_row_count * place;
    std::fill_n(record, k_row_count + k_beyond_records, Scalar(0));
    std::memcpy(record + 9, &k_no_triangle, sizeof k_no_triangle);
    clusters.empty = cluster_ref(static_cast<std::uint32_t>(place), 1);
}

// Of the parts' boxes one list, in scene units.
template <class Scalar>
void join(std::vector<Part<Scalar>>& parts, ClusterBuild<Scalar>& build, const Executor& executor) {
    std::vector<QuadBox<Scalar>> bounds(parts.size());
    executor(parts.size(), [&](std::size_t p) {
        for (const ClusterBox<Scalar>& box : parts[p].boxes) bounds[p].add(box_of<Scalar>(box));
    });
    std::size_t count = 0;
    QuadBox<Scalar> all;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        parts[p].first = count;
        count += parts[p].boxes.size();
        build.degenerate.insert(build.degenerate.end(), parts[p].degenerate.begin(), parts[p].degenerate.end());
        all.add(bounds[p]);
    }
    std::sort(build.degenerate.begin(), build.degenerate.end());
    if (count == 0) return;
    for (int k = 0; k < 3; ++k) {
        build.low[k] = all.low[k];
        build.high[k] = all.high[k];
        build.largest = std::max({build.largest, std::abs(build.low[k]), std::abs(build.high[k])});
    }
    const Scalar unit = scene_unit(all);
    build.unit = unit;
    build.boxes = RawArray<ClusterBox<Scalar>>(count);
    executor(parts.size(), [&](std::size_t p) {
        ClusterBox<Scalar>* to = build.boxes.data() + parts[p].first;
        for (ClusterBox<Scalar> box : parts[p].boxes) {
            for (int k = 0; k < 3; ++k) {
                box.low[k] *= unit;
                box.high[k] *= unit;
            }
            *to++ = box;
        }
        std::vector<ClusterBox<Scalar>>().swap(parts[p].boxes);
    });
}

}  // namespace

// A mesh in a plane across an axis may be so small beside its distance from the origin that its coordinates overflow in
// this unit. (Where it has an extent along each axis that is at most 2^53 times as much.)
template <class Scalar>
Scalar scene_unit(const QuadBox<Scalar>& box) {
    const Scalar unit = unit_by_extent(box);
    Scalar largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
    constexpr int k_most = std::numeric_limits<Scalar>::max_exponent - 4;
    if (largest >= 1 && std::ilogb(largest) + std::ilogb(unit) >= k_most)
        throw MeshError("the mesh is too small for its distance from the origin: a coordinate is more than 2^" +
                        std::to_string(k_most - 1) + " times its largest extent");
    return unit;
}

template <class Scalar>
ClusterBuild<Scalar> make_clusters(const PlainMesh<Scalar>& mesh, bool (*has_zero_area)(const Corners&),
                                   const Executor& executor) {
    ClusterBuild<Scalar> build;
    const std::size_t count = mesh.triangles.size();
    build.clusters.records = RawArray<Scalar>(k_row_count * (count + 1) + k_beyond_records);
    write_empty_record(build.clusters, count);
    if (count == 0) return build;
    MortonOrder<Scalar> order = morton_order(mesh, executor);
    const CornerReader<Scalar> reader(mesh);
    std::uint64_t* entries = order.entries.data();

    std::vector<Part<Scalar>> parts;
    RangeCutter<Scalar>(reader, entries, executor)
        .cut({0, static_cast<std::uint32_t>(count), 0, false, false}, k_part, [&](const Range& range) {
            parts.push_back({});
            parts.back().range = range;
        });

    const QuadBox<Scalar>& box = order.box;
    const Scalar unit = unit_by_extent(box);
    const Scalar area = QuadBox<Scalar>{box.low * unit, box.high * unit}.area();
    const ClusterWriter<Scalar> writer(reader, entries, unit,
                                       static_cast<Scalar>(k_large / static_cast<double>(count)) * area, has_zero_area,
                                       build.clusters.records.data());
    executor(parts.size(), [&](std::size_t p) {
        try {
            write_part(parts[p], reader, entries, writer);
        } catch (...) {
            parts[p].failure = std::current_exception();
        }
    });
    for (const Part<Scalar>& part : parts)
        if (part.failure) std::rethrow_exception(part.failure);
    order.entries = {};
    join(parts, build, executor);
    return build;
}

template float scene_unit(const QuadBox<float>&);
template double scene_unit(const QuadBox<double>&);
template ClusterBuild<float> make_clusters(const PlainMesh<float>&, bool (*)(const Corners&), const Executor&);
template ClusterBuild<double> make_clusters(const PlainMesh<double>&, bool (*)(const Corners&), const Executor&);

}  // namespace pierce::detail
