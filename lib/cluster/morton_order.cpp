// Boxes, keys from them, and the entries sorted by those.
#include <cluster/morton_order.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <chunks.h>
#include <cluster/morton_key.h>
#include <cluster/sort_entries.h>

namespace pierce::detail {

namespace {

template <class Scalar>
QuadBox<Scalar> box_of_positions(const PlainMesh<Scalar>& mesh, const CornerReader<Scalar>& reader,
                                 const Executor& executor) {
    const std::size_t count = mesh.positions.size();
    std::vector<QuadBox<Scalar>> boxes(chunks_of(count));
    each_chunk(executor, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        QuadBox<Scalar> box;
        for (std::size_t i = begin; i < end; ++i) {
            const Quad<Scalar> x = reader.corner(static_cast<std::uint32_t>(i));
            box.add({x, x});
        }
        boxes[chunk] = box;
    });
    QuadBox<Scalar> box;
    for (const QuadBox<Scalar>& part : boxes) box.add(part);
    return box;
}

// Writes the entries in the caller's order; the box of the triangles.
template <class Scalar>
QuadBox<Scalar> make_keys(const CornerReader<Scalar>& reader, const QuadBox<Scalar>& box,
                          RawArray<std::uint64_t>& entries, const Executor& executor) {
    const KeyRaster<Scalar> raster(box.low * Scalar(0.5), box.high * Scalar(0.5));
    std::vector<QuadBox<Scalar>> boxes(chunks_of(entries.size()));
    each_chunk(executor, entries.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        QuadBox<Scalar> sum;
        for (std::size_t i = begin; i < end; i += 4)
            put_keys<Scalar>(
                raster, std::min<std::size_t>(end - i, 4), &entries[i],
                [&](std::size_t lane) {
                    const QuadBox<Scalar> b = reader.box(i + lane);
                    sum.add(b);
                    return half_center(b);
                },
                [&](std::size_t lane) { return static_cast<std::uint32_t>(i + lane); });
        boxes[chunk] = sum;
    });
    QuadBox<Scalar> all;
    for (const QuadBox<Scalar>& part : boxes) all.add(part);
    return all;
}

}  // namespace

template <class Scalar>
MortonOrder<Scalar> morton_order(const PlainMesh<Scalar>& mesh, const Executor& executor) {
    const CornerReader<Scalar> reader(mesh);
    MortonOrder<Scalar> order{RawArray<std::uint64_t>(mesh.triangles.size()), {}};
    // Positions are quicker to go through than corners. Where those without a triangle make the box larger, keys are
    // made again.
    const QuadBox<Scalar> all = box_of_positions(mesh, reader, executor);
    order.box = make_keys(reader, all, order.entries, executor);
    const auto half_extent = [](const QuadBox<Scalar>& box) {
        return largest_of<Scalar>(box.high * Scalar(0.5) - box.low * Scalar(0.5));
    };
    if (!(half_extent(order.box) >= Scalar(0.75) * half_extent(all)))
        make_keys(reader, order.box, order.entries, executor);
    RawArray<std::uint64_t> sorted(order.entries.size());
    sort_entries(order.entries.data(), sorted.data(), sorted.size(), executor);
    order.entries = std::move(sorted);
    return order;
}

template MortonOrder<float> morton_order(const PlainMesh<float>&, const Executor&);
template MortonOrder<double> morton_order(const PlainMesh<double>&, const Executor&);

}  // namespace pierce::detail
