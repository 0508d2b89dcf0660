// Cuts a sorted list of keys into clusters, and writes their records.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include <chunks.h>
#include <cluster/clusters.h>
#include <cluster/morton_order.h>

namespace pierce::detail {

struct Range {
    std::size_t begin;
    std::size_t end;
};

/// Where the highest bit that differs changes; the middle where none does.
[[nodiscard]] inline std::size_t cut_place(const Keyed* keyed, const Range& range) {
    const Keyed different = (keyed[range.begin] ^ keyed[range.end - 1]) >> 32;
    if (different == 0) return range.begin + (range.end - range.begin) / 2;
    const int bit = 32 + static_cast<int>(std::bit_width(different)) - 1;
    const Keyed* end = keyed + range.end;
    const Keyed* first = std::partition_point(keyed + range.begin, end, [&](Keyed x) { return (x >> bit & 1) == 0; });
    return static_cast<std::size_t>(first - keyed);
}

/// Subtrees of the keys' radix tree that are tasks for a thread, in order.
[[nodiscard]] inline std::vector<Range> cut_into_parts(const Keyed* keyed, std::size_t count) {
    constexpr std::size_t k_part = std::size_t{1} << 13;
    std::vector<Range> parts;
    std::vector<Range> stack{{0, count}};
    while (!stack.empty()) {
        Range range = stack.back();
        stack.pop_back();
        while (range.end - range.begin > k_part && ((keyed[range.begin] ^ keyed[range.end - 1]) >> 32) != 0) {
            const std::size_t middle = cut_place(keyed, range);
            stack.push_back({middle, range.end});
            range.end = middle;
        }
        parts.push_back(range);
    }
    return parts;
}

/// Calls `use(range)` for the largest subtrees with at most eight triangles, in order (Lauterbach et al. 2009 cut in the same way). Where more than
/// eight share a key they get keys of a grid in their own box, which changes `keyed`; where that does not part them either they are
/// halved.
template <class Scalar, class Use>
void cut_into_clusters(const MeshView<Scalar>& mesh, Keyed* keyed, const Range& part, Use&& use) {
    struct Task {
        Range range;
        bool again;  ///< keys of their own were of no use
    };
    std::vector<Task> stack{{part, false}};
    while (!stack.empty()) {
        Task task = stack.back();
        stack.pop_back();
        while (task.range.end - task.range.begin > k_most_in_cluster) {
            Range& range = task.range;
            if (((keyed[range.begin] ^ keyed[range.end - 1]) >> 32) == 0 && !task.again) {
                const auto box_of = [&](Keyed x) {
                    Box4<Scalar> box = Box4<Scalar>::none();
                    for (const std::uint32_t vertex : mesh.triangles[static_cast<std::uint32_t>(x)]) box.add(three(mesh.positions[vertex].data()));
                    return box;
                };
                Box4<Scalar> centers = Box4<Scalar>::none();
                for (std::size_t i = range.begin; i < range.end; ++i) {
                    const Box4<Scalar> box = box_of(keyed[i]);
                    centers.add(box.low + box.high);
                }
                const MortonGrid<Scalar> grid(centers.low, centers.high);
                for (std::size_t i = range.begin; i < range.end; ++i) {
                    const Box4<Scalar> box = box_of(keyed[i]);
                    keyed[i] = Keyed{grid.key(box.low + box.high)} << 32 | static_cast<std::uint32_t>(keyed[i]);
                }
                std::sort(keyed + range.begin, keyed + range.end);
                task.again = ((keyed[range.begin] ^ keyed[range.end - 1]) >> 32) == 0;
            }
            const std::size_t middle = cut_place(keyed, range);
            stack.push_back({{middle, range.end}, task.again});
            range.end = middle;
        }
        use(task.range);
    }
}

/// Writes records and boxes.
template <class Scalar>
struct RecordWriter {
    const MeshView<Scalar>& mesh;
    const Keyed* keyed;
    std::size_t count;
    Scalar* records;
    Scalar unit;
    Scalar large;  ///< clusters of a larger half area are split where that pays
    std::vector<ClusterBox<Scalar>>& boxes;

    void write(const Range& range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const IndexTriple& later = mesh.triangles[number(std::min(i + 3 * k_ahead, count - 1))];
            __builtin_prefetch(&later);
            for (const std::uint32_t vertex : mesh.triangles[number(std::min(i + k_ahead, count - 1))]) __builtin_prefetch(&mesh.positions[vertex]);
        }
        const auto size = static_cast<unsigned>(range.end - range.begin);
        std::array<std::uint32_t, k_most_in_cluster> numbers;
        std::array<Box4<Scalar>, k_most_in_cluster> triangle_boxes;
        Box4<Scalar> box = Box4<Scalar>::none();
        for (unsigned i = 0; i < size; ++i) {
            numbers[i] = number(range.begin + i);
            triangle_boxes[i] = Box4<Scalar>::none();
            for (const std::uint32_t vertex : mesh.triangles[numbers[i]]) triangle_boxes[i].add(three(mesh.positions[vertex].data()));
            box.add(triangle_boxes[i]);
        }
        split(numbers.data(), triangle_boxes.data(), size, box, range.begin);
    }

  private:
    [[nodiscard]] std::uint32_t number(std::size_t i) const { return static_cast<std::uint32_t>(keyed[i]); }

    void split(std::uint32_t* numbers, Box4<Scalar>* each, unsigned size, const Box4<Scalar>& box, std::size_t place) {
        if (size > 1 && box.half_area() > large) {
            Scalar best = Scalar(0.75) * box.half_area();
            unsigned best_order = 0;
            unsigned cut = 0;
            for (unsigned order = 0; order < 4; ++order) {
                arrange(numbers, each, size, order);
                for (unsigned i = 1; i < size; ++i) {
                    const Scalar areas = united(each, i).half_area() + united(each + i, size - i).half_area();
                    if (!(areas < best)) continue;
                    best = areas;
                    best_order = order;
                    cut = i;
                }
            }
            if (cut > 0) {
                arrange(numbers, each, size, best_order);
                split(numbers, each, cut, united(each, cut), place);
                split(numbers + cut, each + cut, size - cut, united(each + cut, size - cut), place + cut);
                return;
            }
        }
        emit(numbers, size, box, place);
    }
    static Box4<Scalar> united(const Box4<Scalar>* each, unsigned size) {
        Box4<Scalar> box = each[0];
        for (unsigned i = 1; i < size; ++i) box.add(each[i]);
        return box;
    }
    // By the centre along an axis, or by size; then by number, so that it does not matter how they were arranged before.
    static void arrange(std::uint32_t* numbers, Box4<Scalar>* each, unsigned size, unsigned order) {
        const auto value = [&](const Box4<Scalar>& box) { return order < 3 ? box.low[order] + box.high[order] : box.half_area(); };
        for (unsigned i = 1; i < size; ++i)
            for (unsigned k = i; k > 0; --k) {
                const Scalar x = value(each[k]);
                const Scalar y = value(each[k - 1]);
                if (!(x < y || (x == y && numbers[k] < numbers[k - 1]))) break;
                std::swap(each[k], each[k - 1]);
                std::swap(numbers[k], numbers[k - 1]);
            }
    }
    void emit(const std::uint32_t* numbers, unsigned size, const Box4<Scalar>& box, std::size_t place) {
        Scalar* record = records + k_row_count * place;
        for (unsigned i = 0; i < size; ++i) {
            const IndexTriple& t = mesh.triangles[numbers[i]];
            Scalar* to = record + i;
            for (const std::uint32_t vertex : t) {
                const Scalar* from = mesh.positions[vertex].data();
                for (std::size_t k = 0; k < 3; ++k, to += size) *to = from[k];
            }
            if constexpr (sizeof(Scalar) > sizeof(std::uint32_t)) *to = 0;
            std::memcpy(to, numbers + i, sizeof(std::uint32_t));
        }
        ClusterBox<Scalar> out;
        for (int k = 0; k < 3; ++k) {
            out.low[k] = box.low[k] * unit;
            out.high[k] = box.high[k] * unit;
        }
        out.ref = cluster_ref(static_cast<std::uint32_t>(place), size);
        out.key = static_cast<std::uint32_t>(keyed[place] >> 32);
        boxes.push_back(out);
    }
};

}  // namespace pierce::detail
