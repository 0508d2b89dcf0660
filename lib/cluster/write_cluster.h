// Triangles of one range gathered, those without area left out, and written as one record; as several where the range
// is large and that pays.
#pragma once

#include <array>
#include <cstring>
#include <type_traits>
#include <vector>

#include <chunks.h>
#include <cluster/clusters.h>
#include <cluster/cut_ranges.h>

namespace pierce::detail {

/// Certain that the area is not zero. Edges p, q from one corner and n = p x q, computed: with u twice the half unit of
/// the numbers and M the largest
/// |component| of p and q, each component of n is within 8u M^2 (kernel/meeting.h: 4u of sums of two products, each at most M^2). M is kept to where
/// products lose less than a
/// thousandth of u M^2 to underflow, and none overflows.
template <class Number>
[[nodiscard, gnu::always_inline]] inline bool certainly_has_area(Quad<Number> a, Quad<Number> b, Quad<Number> c) {
    constexpr bool k_float = std::is_same_v<Number, float>;
    constexpr Number k_least = k_float ? Number(0x1p-40) : Number(0x1p-300);
    const Quad<Number> p = b - a, q = c - a;
    const Quad<Number> n = __builtin_shufflevector(p, p, 1, 2, 0, 3) * __builtin_shufflevector(q, q, 2, 0, 1, 3) -
                           __builtin_shufflevector(p, p, 2, 0, 1, 3) * __builtin_shufflevector(q, q, 1, 2, 0, 3);
    const Number size = largest_of<Number>(most(most(p, -p), most(q, -q)));
    const Number normal = largest_of<Number>(most(n, -n));
    return size >= k_least && size <= 1 / k_least &&
           normal > 8 * std::numeric_limits<Number>::epsilon() * (size * size);  // false for NaN
}

using HasZeroArea = bool (*)(const Corners&);

template <class Scalar>
class ClusterWriter {
  public:
    /// `unit` makes the scene about 1 wide; what has a larger `large_area` then is split where that pays.
    ClusterWriter(const CornerReader<Scalar>& reader, const std::uint64_t* entries, Scalar unit, Scalar large_area,
                  HasZeroArea has_zero_area, Scalar* records)
        : reader_(reader),
          entries_(entries),
          unit_(unit),
          large_area_(large_area),
          has_zero_area_(has_zero_area),
          records_(records) {}

    /// `end`: of the entries that may be asked of memory ahead. Returns the number of triangles without area.
    std::size_t write(const Range& range, std::uint32_t key, std::uint32_t end,
                      std::vector<ClusterBox<Scalar>>& boxes) {
        count_ = 0;
        QuadBox<Scalar> all;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            ask_ahead(i, end);
            gather(static_cast<std::uint32_t>(entries_[i]), all);
        }
        for (unsigned i = 0; i < count_; ++i) order_[i] = static_cast<std::uint8_t>(i);
        if (count_ > 0) split(0, count_, all, range.begin, key, boxes);
        return range.size() - count_;
    }

  private:
    [[gnu::always_inline]] void ask_ahead(std::uint32_t i, std::uint32_t end) const {
        const MeshView<Scalar>& mesh = reader_.mesh();
        const auto triangle = [&](std::uint32_t at) -> const IndexTriple& {
            return mesh.triangles[static_cast<std::uint32_t>(entries_[std::min(at, end - 1)])];
        };
        __builtin_prefetch(&triangle(i + 3 * k_ahead));
        for (const std::uint32_t vertex : triangle(i + 3 * k_ahead / 2)) __builtin_prefetch(&mesh.positions[vertex]);
    }
    [[gnu::always_inline]] void gather(std::uint32_t number, QuadBox<Scalar>& all) {
        const IndexTriple& t = reader_.mesh().triangles[number];
        const Quad<Scalar> a = reader_.corner(t[0]), b = reader_.corner(t[1]), c = reader_.corner(t[2]);
        if (!certainly_has_area<Scalar>(a, b, c) && has_no_area(t)) return;
        std::array<Quad<Scalar>, 3>& corners = corners_[count_];
        corners = {a, b, c};
        boxes_[count_] = {least(a, least(b, c)), most(a, most(b, c))};
        all.add(boxes_[count_]);
        numbers_[count_++] = number;
    }
    [[nodiscard]] bool has_no_area(const IndexTriple& t) const {
        const auto& x = reader_.mesh().positions;
        const Corners corners = {to_point(x[t[0]]), to_point(x[t[1]]), to_point(x[t[2]])};
        const auto quad = [](const Point& p) { return Quad<double>{p[0], p[1], p[2], 0}; };
        return !certainly_has_area<double>(quad(corners[0]), quad(corners[1]), quad(corners[2])) &&
               has_zero_area_(corners);
    }
    [[nodiscard]] Scalar area(const QuadBox<Scalar>& box) const {
        return QuadBox<Scalar>{box.low * unit_, box.high * unit_}.area();
    }

    // Triangles order_[begin, end), whose box is `box`, to the places from `place` on.
    void split(unsigned begin, unsigned end, const QuadBox<Scalar>& box, std::uint32_t place, std::uint32_t key,
               std::vector<ClusterBox<Scalar>>& boxes) {
        const unsigned n = end - begin;
        const Scalar a = area(box);
        if (n > 1 && a > large_area_) {
            if (const unsigned cut = best_cut(begin, end, a); cut > 0) {
                split(begin, begin + cut, box_of_part(begin, begin + cut), place, key, boxes);  // no deeper than 7
                split(begin + cut, end, box_of_part(begin + cut, end), place + cut, key, boxes);
                return;
            }
        }
        Scalar* const record = records_ + k_row_count * place;
        for (unsigned i = 0; i < n; ++i) {
            const unsigned t = order_[begin + i];
            Scalar* to = record + i;
            for (const Quad<Scalar>& corner : corners_[t])
                for (int k = 0; k < 3; ++k, to += n) *to = corner[k];
            *to = 0;
            std::memcpy(to, &numbers_[t], sizeof numbers_[t]);
        }
        ClusterBox<Scalar> out;
        set_box(out, box);
        out.ref = cluster_ref(place, n);
        out.key = key;
        boxes.push_back(out);
    }
    [[nodiscard]] QuadBox<Scalar> box_of_part(unsigned begin, unsigned end) const {
        QuadBox<Scalar> box;
        for (unsigned i = begin; i < end; ++i) box.add(boxes_[order_[i]]);
        return box;
    }

    // Tries to split by position along each axis and by size. Two boxes pay if they have less than three quarters of
    // the one's area: each costs
    // a place in a node. Returns how many go first, and puts these first; 0 if nothing pays.
    unsigned best_cut(unsigned begin, unsigned end, Scalar whole) {
        const unsigned n = end - begin;
        Scalar best = Scalar(0.75) * whole;
        unsigned cut = 0;
        std::array<std::uint8_t, k_most_in_cluster> best_order;
        for (int way = 0; way < 4; ++way) {
            std::array<Scalar, k_most_in_cluster> keys;  // of triangles
            std::array<std::uint8_t, k_most_in_cluster> order;
            for (unsigned i = 0; i < n; ++i) {
                const unsigned t = order_[begin + i];
                order[i] = static_cast<std::uint8_t>(t);
                keys[t] = way < 3 ? half_center(boxes_[t])[way] : area(boxes_[t]);
            }
            std::sort(order.begin(), order.begin() + n,
                      [&](unsigned i, unsigned j) { return keys[i] < keys[j] || (keys[i] == keys[j] && i < j); });
            std::array<Scalar, k_most_in_cluster> areas_behind;
            QuadBox<Scalar> sum;
            for (unsigned i = n; i-- > 1;) {
                sum.add(boxes_[order[i]]);
                areas_behind[i] = area(sum);
            }
            sum = {};
            for (unsigned i = 1; i < n; ++i) {
                sum.add(boxes_[order[i - 1]]);
                const Scalar both = area(sum) + areas_behind[i];
                if (!(both < best)) continue;
                best = both;
                cut = i;
                best_order = order;
            }
        }
        if (cut > 0) std::copy_n(best_order.begin(), n, order_.begin() + begin);
        return cut;
    }

    const CornerReader<Scalar>& reader_;
    const std::uint64_t* entries_;
    Scalar unit_;
    Scalar large_area_;
    HasZeroArea has_zero_area_;
    Scalar* records_;
    unsigned count_ = 0;
    std::array<std::array<Quad<Scalar>, 3>, k_most_in_cluster> corners_;
    std::array<QuadBox<Scalar>, k_most_in_cluster> boxes_;
    std::array<std::uint32_t, k_most_in_cluster> numbers_;
    std::array<std::uint8_t, k_most_in_cluster> order_;
};

}  // namespace pierce::detail
