// Keys, then three counting passes of ten bits each (Knuth, volume 3, 5.2.5), in parts that know where each of their
// digits goes.
#include <cluster/morton_order.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <chunks.h>
#include <cluster/morton_key.h>

namespace pierce::detail {

namespace {

constexpr int k_digit_bits = 10;
constexpr std::size_t k_digits = std::size_t{1} << k_digit_bits;

// One part where there is one thread, since each has counters of its own. The order does not depend on it: each pass is
// stable.
std::size_t part_size(std::size_t count, const Executor& executor) {
    return executor ? std::max<std::size_t>(std::size_t{1} << 15, count / 32 + 1) : std::max<std::size_t>(count, 1);
}

template <class Scalar>
QuadBox<Scalar> box_of_positions(const MeshView<Scalar>& mesh, const CornerReader<Scalar>& reader,
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
        for (std::size_t i = begin; i < end; ++i) {
            const QuadBox<Scalar> b = reader.box(i);
            sum.add(b);
            entries[i] = std::uint64_t{raster.key(half_center(b))} << 32 | i;
        }
        boxes[chunk] = sum;
    });
    QuadBox<Scalar> all;
    for (const QuadBox<Scalar>& part : boxes) all.add(part);
    return all;
}

// One pass; `next` has k_digits places for each part. The shift is a constant: one in a register is read from memory again
// after each store.
template <int shift>
void sort_by_digit(RawArray<std::uint64_t>& entries, RawArray<std::uint64_t>& other, std::vector<std::uint32_t>& next,
                   std::size_t part, const Executor& executor) {
    constexpr auto digit = [](std::uint64_t entry) { return entry >> shift & (k_digits - 1); };
    const std::size_t parts = next.size() / k_digits;
    each_chunk(
        executor, entries.size(),
        [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* counts = &next[p * k_digits];
            std::fill_n(counts, k_digits, 0);
            const std::uint64_t* from = entries.data();
            for (std::size_t i = begin; i < end; ++i) ++counts[digit(from[i])];
        },
        part);
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d < k_digits; ++d)
        for (std::size_t p = 0; p < parts; ++p) sum += std::exchange(next[p * k_digits + d], sum);
    each_chunk(
        executor, entries.size(),
        [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* places = &next[p * k_digits];
            const std::uint64_t* from = entries.data();
            std::uint64_t* to = other.data();
            for (std::size_t i = begin; i < end; ++i) to[places[digit(from[i])]++] = from[i];
        },
        part);
    std::swap(entries, other);
}

void sort_entries(RawArray<std::uint64_t>& entries, const Executor& executor) {
    const std::size_t part = part_size(entries.size(), executor);
    RawArray<std::uint64_t> other(entries.size());
    std::vector<std::uint32_t> next(chunks_of(entries.size(), part) * k_digits);
    sort_by_digit<32>(entries, other, next, part, executor);
    sort_by_digit<32 + k_digit_bits>(entries, other, next, part, executor);
    sort_by_digit<32 + 2 * k_digit_bits>(entries, other, next, part, executor);
}

}  // namespace

template <class Scalar>
MortonOrder<Scalar> morton_order(const MeshView<Scalar>& mesh, const Executor& executor) {
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
    sort_entries(order.entries, executor);
    return order;
}

template MortonOrder<float> morton_order(const MeshView<float>&, const Executor&);
template MortonOrder<double> morton_order(const MeshView<double>&, const Executor&);

}  // namespace pierce::detail
