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

/// For each of four triangles, whether it is certain that its area is not zero. Edges p, q from one corner and
/// n = p x q, computed: with u twice the half unit of the numbers and M the largest |component| of p and q, each
/// component of n is within 8u M^2 (kernel/meeting.h: 4u of sums of two products, each at most M^2). M is kept to where
/// products lose less than a thousandth of u M^2 to underflow, and none overflows. `rows`: a.x, a.y, a.z, b.x, ... c.z
/// of the four.
template <class Number>
[[nodiscard, gnu::always_inline]] inline auto certainly_have_area(const Quad<Number> (&rows)[9]) {
    constexpr bool k_float = std::is_same_v<Number, float>;
    constexpr Number k_least = k_float ? Number(0x1p-40) : Number(0x1p-300);
    const auto size_of = [](Quad<Number> x, Quad<Number> y, Quad<Number> z) {
        return most(most(most(x, -x), most(y, -y)), most(z, -z));
    };
    Quad<Number> p[3], q[3], n[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = rows[3 + k] - rows[k];
        q[k] = rows[6 + k] - rows[k];
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = p[i] * q[j] - p[j] * q[i];
    }
    const Quad<Number> size = most(size_of(p[0], p[1], p[2]), size_of(q[0], q[1], q[2]));
    const Quad<Number> least_normal = all_of(8 * std::numeric_limits<Number>::epsilon()) * (size * size);
    return (size >= all_of(k_least)) & (size <= all_of(1 / k_least)) &
           (size_of(n[0], n[1], n[2]) > least_normal);  // false for NaN
}

using HasZeroArea = bool (*)(const Corners&);

/// `Entry`: of the order, whose low four bytes are a triangle's number.
template <class Scalar, class Entry = std::uint64_t>
class ClusterWriter {
  public:
    /// `unit` makes the scene about 1 wide; what has a larger `large_area` then is split where that pays.
    ClusterWriter(const CornerReader<Scalar>& reader, const Entry* entries, Scalar unit, Scalar large_area,
                  HasZeroArea has_zero_area, Scalar* records)
        : reader_(reader),
          entries_(entries),
          unit_(unit),
          large_area_(large_area),
          has_zero_area_(has_zero_area),
          records_(records) {}

    /// The triangles of entries [begin, end), eight at most, which are more than none. `last`: of the entries that may
    /// be asked of memory ahead. Numbers of those without area are added to `degenerate`.
    void write(std::uint32_t begin, std::uint32_t end, std::uint32_t key, std::uint32_t last,
               std::vector<ClusterBox<Scalar>>& boxes, std::vector<std::uint32_t>& degenerate) {
        const QuadBox<Scalar> all = gather_all(begin, end, last, degenerate);
        if (count_ == 0) return;
        if (const Scalar a = area(all); count_ > 1 && a > large_area_) {
            find_boxes();
            split(0, count_, all, begin, key, boxes);
        } else {
            write_rows(begin);
            add_box(all, cluster_ref(begin, count_), key, boxes);
        }
    }

    /// The same for what is one record in any case, at the place `begin`. False: none of them has an area, and nothing
    /// is written but `degenerate`.
    bool rewrite(std::uint32_t begin, std::uint32_t end, std::uint32_t last, ClusterBox<Scalar>& box,
                 std::vector<std::uint32_t>& degenerate) {
        const QuadBox<Scalar> all = gather_all(begin, end, last, degenerate);
        if (count_ == 0) return false;
        write_rows(begin);
        set_box(box, all);
        box.ref = cluster_ref(begin, count_);
        return true;
    }

  private:
    // Returns the box of those that have area.
    [[gnu::always_inline]] QuadBox<Scalar> gather_all(std::uint32_t begin, std::uint32_t end, std::uint32_t last,
                                                      std::vector<std::uint32_t>& degenerate) {
        count_ = end - begin;
        QuadBox<Scalar> all;
        for (unsigned i = 0; i < count_; i += 4) gather(begin, i, last, all);
        if (!all_have_area_) {
            all_have_area_ = true;
            leave_out_degenerate(degenerate);
            find_boxes();
            all = box_of_part(0, count_);
        }
        return all;
    }
    // Four triangles from `from` on, or the last ones, to the rows; lanes behind the last have it as well.
    [[gnu::always_inline]] void gather(std::uint32_t begin, unsigned from, std::uint32_t last, QuadBox<Scalar>& all) {
        const CornerReader<Scalar> reader = reader_;
        const Entry* const entries = entries_;
        const auto number_at = [&](std::uint32_t i) {
            return static_cast<std::uint32_t>(entries[std::min(i, last - 1)]);
        };
        const unsigned behind = count_ - 1;
        std::uint32_t numbers[4];
        Quad<Scalar> corners[3][4];
#pragma GCC unroll 4
        for (unsigned i = 0; i < 4; ++i) {
            const std::uint32_t number = numbers[i] = number_at(begin + std::min(from + i, behind));
            const IndexTriple& triangle = reader.triangle(number);
            const Quad<Scalar> a = reader.corner(triangle[0]);
            const Quad<Scalar> b = reader.corner(triangle[1]);
            const Quad<Scalar> c = reader.corner(triangle[2]);
            all.add({least(a, least(b, c)), most(a, most(b, c))});
            corners[0][i] = a, corners[1][i] = b, corners[2][i] = c;
            // Some are asked for twice: a branch that can't be predicted costs more.
            reader.ask_for_triangle(number_at(begin + from + i + 3 * k_ahead));
            reader.ask_for_corners(number_at(begin + from + i + 3 * k_ahead / 2));
        }
        std::memcpy(&numbers_[from], numbers, sizeof numbers);
        Quad<Scalar> rows[9];
        for (int c = 0; c < 3; ++c) transpose(corners[c], rows + 3 * c);
        for (std::size_t r = 0; r < 9; ++r) std::memcpy(&rows_[r][from], &rows[r], sizeof rows[r]);
        const auto have_area = certainly_have_area<Scalar>(rows);
        all_have_area_ = all_have_area_ && (have_area[0] & have_area[1] & have_area[2] & have_area[3]) != 0;
    }
    // Of those that it is not certain of, too: these are few.
    void leave_out_degenerate(std::vector<std::uint32_t>& degenerate) {
        unsigned kept = 0;
        for (unsigned i = 0; i < count_; ++i) {
            Corners corners;
            for (std::size_t r = 0; r < 9; ++r) corners[r / 3][r % 3] = static_cast<double>(rows_[r][i]);
            Quad<double> rows[9];
            for (std::size_t r = 0; r < 9; ++r) rows[r] = all_of(corners[r / 3][r % 3]);
            if (certainly_have_area<double>(rows)[0] == 0 && has_zero_area_(corners)) {
                degenerate.push_back(numbers_[i]);
                continue;
            }
            for (auto& row : rows_) row[kept] = row[i];
            numbers_[kept++] = numbers_[i];
        }
        count_ = kept;
    }
    [[nodiscard]] Scalar area(const QuadBox<Scalar>& box) const {
        return QuadBox<Scalar>{box.low * unit_, box.high * unit_}.area();
    }
    void add_box(const QuadBox<Scalar>& box, ClusterRef ref, std::uint32_t key,
                 std::vector<ClusterBox<Scalar>>& boxes) const {
        ClusterBox<Scalar> out;
        set_box(out, box);
        out.ref = ref;
        out.key = key;
        boxes.push_back(out);
    }

    // All of them, in their order. Rows are stored four or eight wide, and what is too much is overwritten by the next:
    // the ninth, 8 n + 4 or, from five on, 8 n + 8 wide with those before, ends within the record of 10 n.
    void write_rows(std::uint32_t place) const {
        Scalar* to = records_ + k_row_count * place;
        // Lines of the clusters after next: stores to memory that is not in the cache yet hold up all others.
        for (int line = 12; line < 16; ++line) __builtin_prefetch(reinterpret_cast<char*>(to) + 64 * line, 1);
        const std::size_t n = count_;
        if (n == 1) {
            for (std::size_t r = 0; r < 9; ++r) to[r] = rows_[r][0];
        } else if (n <= 4) {
#pragma GCC unroll 9
            for (std::size_t r = 0; r < 9; ++r) std::memcpy(to + r * n, rows_[r].data(), 4 * sizeof(Scalar));
        } else {
#pragma GCC unroll 9
            for (std::size_t r = 0; r < 9; ++r) std::memcpy(to + r * n, rows_[r].data(), 8 * sizeof(Scalar));
        }
        if (std::is_same_v<Scalar, float> && n >= 4) {
            std::memcpy(to + 9 * n, numbers_.data(), 4 * sizeof(std::uint32_t));
            std::memcpy(to + 10 * n - 4, &numbers_[n - 4], 4 * sizeof(std::uint32_t));
        } else {
            for (std::size_t i = 0; i < n; ++i) write_number(to + 9 * n + i, numbers_[i]);
        }
    }
    [[gnu::always_inline]] static void write_number(Scalar* to, std::uint32_t number) {
        *to = 0;
        std::memcpy(to, &number, sizeof number);
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
            for (std::size_t r = 0; r < 9; ++r) record[r * n + i] = rows_[r][t];
            write_number(record + 9 * n + i, numbers_[t]);
        }
        add_box(box, cluster_ref(place, n), key, boxes);
    }
    // Of the triangles, in the order they have: only what is split needs them.
    void find_boxes() {
        for (unsigned t = 0; t < count_; ++t) {
            const auto corner = [&](std::size_t r) {
                return Quad<Scalar>{rows_[r][t], rows_[r + 1][t], rows_[r + 2][t], 0};
            };
            const Quad<Scalar> a = corner(0), b = corner(3), c = corner(6);
            boxes_[t] = {least(a, least(b, c)), most(a, most(b, c))};
            order_[t] = static_cast<std::uint8_t>(t);
        }
    }
    [[nodiscard]] QuadBox<Scalar> box_of_part(unsigned begin, unsigned end) const {
        QuadBox<Scalar> box;
        for (unsigned i = begin; i < end; ++i) box.add(boxes_[order_[i]]);
        return box;
    }

    // Tries to split by position along each axis and by size. Two boxes pay if they have less than three quarters of
    // the one's area: each costs a place in a node. Returns how many go first, and puts these first; 0 if nothing pays.
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

    CornerReader<Scalar> reader_;
    const Entry* entries_;
    Scalar unit_;
    Scalar large_area_;
    HasZeroArea has_zero_area_;
    Scalar* records_;
    // What is gathered: rows as in a record, but of eight.
    unsigned count_ = 0;
    bool all_have_area_ = true;
    std::array<std::array<Scalar, k_most_in_cluster>, 9> rows_;
    std::array<QuadBox<Scalar>, k_most_in_cluster> boxes_;
    std::array<std::uint32_t, k_most_in_cluster> numbers_;
    std::array<std::uint8_t, k_most_in_cluster> order_;
};

}  // namespace pierce::detail
