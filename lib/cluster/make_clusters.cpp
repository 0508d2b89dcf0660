// From a mesh to clusters: bounds and areas, keys, their order, then records, a part of the order at a time.
#include <cluster/make_clusters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <chunks.h>
#include <cluster/cut.h>
#include <cluster/morton_order.h>

namespace pierce::detail {

namespace {

template <class Scalar>
struct Gathered {
    Box4<Scalar> bounds = Box4<Scalar>::none();
    Box4<Scalar> centers = Box4<Scalar>::none();  ///< of boxes, twice
    std::vector<std::uint32_t> degenerate;
};

template <class Scalar>
struct TriangleCorners {
    Vector4<Scalar> a, b, c;

    TriangleCorners(const MeshView<Scalar>& mesh, const IndexTriple& t)
        : a(three(mesh.positions[t[0]].data())), b(three(mesh.positions[t[1]].data())), c(three(mesh.positions[t[2]].data())) {}
    [[nodiscard]] Box4<Scalar> box() const { return {least(least(a, b), c), greatest(greatest(a, b), c)}; }
};

// Whether the area is certainly not 0. Each edge is rounded once, and so is each product: a component of the normal p x q is within
// 2 * 3u M^2 + u 2M^2 = 8u M^2 of the exact one, M being the largest |component| of p and q and u the unit, for any rounding mode epsilon. Nothing underflows
// or overflows where M is in the range below. NaN: no.
template <class Scalar>
bool has_area(const TriangleCorners<Scalar>& t) {
    const Vector4<Scalar> p = t.b - t.a;
    const Vector4<Scalar> q = t.c - t.a;
    Scalar size = 0;
    for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(p[k]), std::abs(q[k])});
    const Scalar x = p[1] * q[2] - p[2] * q[1];
    const Scalar y = p[2] * q[0] - p[0] * q[2];
    const Scalar z = p[0] * q[1] - p[1] * q[0];
    constexpr Scalar most = sizeof(Scalar) == sizeof(float) ? Scalar(0x1p60) : Scalar(0x1p300);
    const Scalar bound = 9 * std::numeric_limits<Scalar>::epsilon() * (size * size);
    return size < most && size > 1 / most && std::max({std::abs(x), std::abs(y), std::abs(z)}) > bound;
}

template <class Scalar>
void gather(const MeshView<Scalar>& mesh, std::size_t begin, std::size_t end, bool (*has_zero_area)(const Corners&), Gathered<Scalar>& out) {
    for (std::size_t i = begin; i < end; ++i) {
        const IndexTriple& t = mesh.triangles[i];
        const TriangleCorners<Scalar> corners(mesh, t);
        if (!has_area(corners) &&
            has_zero_area({to_point(mesh.positions[t[0]]), to_point(mesh.positions[t[1]]), to_point(mesh.positions[t[2]])})) {
            out.degenerate.push_back(static_cast<std::uint32_t>(i));
            continue;
        }
        const Box4<Scalar> box = corners.box();
        out.bounds.add(box);
        out.centers.add(box.low + box.high);
    }
}

// A power of two that makes the widest extent about 1: between 1/2 and 1.9, where the scalar has such a power.
template <class Scalar>
double unit_of(const Box4<Scalar>& bounds) {
    double half = 0;
    for (int k = 0; k < 3; ++k) half = std::max(half, static_cast<double>(bounds.high[k]) / 2 - static_cast<double>(bounds.low[k]) / 2);
    constexpr int k_most = sizeof(Scalar) == sizeof(float) ? 127 : 1023;
    if (!(half > 0)) return std::ldexp(1.0, k_most);
    int power = -std::ilogb(half) - 1;
    if (std::ldexp(half, power) > 0.95) --power;
    return std::ldexp(1.0, std::clamp(power, 1 - k_most, k_most));
}

}  // namespace

template <class Scalar>
ClusterBuild<Scalar> make_clusters(const MeshView<Scalar>& mesh, bool (*has_zero_area)(const Corners&), const Executor& executor) {
    const std::size_t count = mesh.triangles.size();
    std::vector<Gathered<Scalar>> gathered(chunks_of(count));
    each_chunk(executor, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        gather(mesh, begin, end, has_zero_area, gathered[chunk]);
    });
    ClusterBuild<Scalar> build;
    Gathered<Scalar> all;
    for (const Gathered<Scalar>& some : gathered) {
        all.bounds.add(some.bounds);
        all.centers.add(some.centers);
        build.degenerate += some.degenerate.size();
    }
    const std::size_t listed = count - build.degenerate;
    for (int k = 0; k < 3 && listed > 0; ++k) {
        build.low[k] = static_cast<double>(all.bounds.low[k]);
        build.high[k] = static_cast<double>(all.bounds.high[k]);
        build.largest = std::max({build.largest, std::abs(build.low[k]), std::abs(build.high[k])});
    }
    build.unit = unit_of(all.bounds);

    const MortonGrid<Scalar> grid(all.centers.low, all.centers.high);
    RawArray<Keyed> keyed(listed);
    std::vector<std::size_t> places(gathered.size());
    for (std::size_t c = 0, skipped = 0; c < gathered.size(); ++c) {
        places[c] = c * k_chunk - skipped;
        skipped += gathered[c].degenerate.size();
    }
    each_chunk(executor, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        auto skip = gathered[chunk].degenerate.begin();
        std::size_t place = places[chunk];
        for (std::size_t i = begin; i < end; ++i) {
            if (skip != gathered[chunk].degenerate.end() && *skip == i) {
                ++skip;
                continue;
            }
            const Box4<Scalar> box = TriangleCorners<Scalar>(mesh, mesh.triangles[i]).box();
            keyed[place++] = Keyed{grid.key(box.low + box.high)} << 32 | i;
        }
    });
    sort_by_key(keyed, executor);

    RawArray<Scalar>& records = build.clusters.records;
    records = RawArray<Scalar>(k_row_count * (listed + 1) + k_beyond_records);
    std::fill(records.begin() + k_row_count * listed, records.end(), Scalar{0});
    std::memcpy(records.data() + k_row_count * listed + 9, &k_no_triangle, sizeof k_no_triangle);
    build.clusters.empty = cluster_ref(static_cast<std::uint32_t>(listed), 1);
    if (listed == 0) return build;

    const std::vector<Range> parts = cut_into_parts(keyed.data(), listed);
    std::vector<std::vector<ClusterBox<Scalar>>> made(parts.size());
    // Clusters of five triangles or so share ten times the scene's area.
    const Scalar large = 50 * all.bounds.half_area() / static_cast<Scalar>(listed);
    executor(parts.size(), [&](std::size_t part) {
        made[part].reserve((parts[part].end - parts[part].begin) / 4 + 1);
        RecordWriter<Scalar> writer{mesh, keyed.data(), listed, records.data(), static_cast<Scalar>(build.unit), large, made[part]};
        cut_into_clusters(mesh, keyed.data(), parts[part], [&](const Range& range) { writer.write(range); });
    });
    std::size_t clusters = 0;
    for (const auto& some : made) clusters += some.size();
    build.boxes = RawArray<ClusterBox<Scalar>>(clusters);
    ClusterBox<Scalar>* to = build.boxes.data();
    for (const auto& some : made) to = std::copy(some.begin(), some.end(), to);
    return build;
}

template ClusterBuild<float> make_clusters(const MeshView<float>&, bool (*)(const Corners&), const Executor&);
template ClusterBuild<double> make_clusters(const MeshView<double>&, bool (*)(const Corners&), const Executor&);

}  // namespace pierce::detail
