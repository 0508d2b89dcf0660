// A binary tree from the leaves up: neighbours in Morton order that are each other's best are joined, round by round
// (Meister and Bittner 2018).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include <raw_array.h>
#include <tree/binary.h>

namespace pierce::detail {

/// Joins `count` items (whose `at` is kept in the leaves, with a `count` that is not 0) to a tree with its root at
/// `root` and other nodes from `next` on. False if that takes too many rounds, as where the items' sizes grow along the
/// order: each round would join one pair.
template <class Scalar>
class Ploc {
  public:
    explicit Ploc(std::size_t count)
        : items_(count), other_(count), rows_(count), best_(count + k_radius), areas_(count + k_radius) {}

    [[nodiscard]] Binary<Scalar>* items() { return items_.data(); }

    [[nodiscard]] bool join(Binary<Scalar>* nodes, std::uint32_t root, std::uint32_t next) {
        std::size_t n = items_.size();
        std::size_t work = 24 * n + 4096;  // in items; rounds that each leave five sixths take 6 n
        while (n > 1) {
            if (work < n) return false;
            work -= n;
            find_best(n);
            std::size_t kept = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t j = best_[i];
                if (best_[j] != i) {
                    other_[kept++] = items_[i];
                } else if (i < j) {
                    nodes[next] = items_[i];
                    nodes[next + 1] = items_[j];
                    QuadBox<Scalar> box = box_of<Scalar>(items_[i]);
                    box.add(box_of<Scalar>(items_[j]));
                    Binary<Scalar>& joined = other_[kept++];
                    set_box(joined, box);
                    joined.at = next;
                    joined.count = 0;
                    next += 2;
                }
            }
            std::swap(items_, other_);
            n = kept;
        }
        nodes[root] = items_[0];
        return true;
    }

  private:
    static constexpr std::size_t k_radius = 8;
    static constexpr std::size_t k_lanes = 4;

    // The items' boxes, with some behind the last that are infinitely large.
    struct Rows {
        std::array<RawArray<Scalar>, 6> bounds;  // low x, y, z, high x, y, z
        explicit Rows(std::size_t count) {
            for (RawArray<Scalar>& row : bounds) row = RawArray<Scalar>(count + k_radius);
        }
    };

    // Of those that are equally good the first: then the first of the best pairs is joined in every round, and rounds
    // end. Four neighbours at a time.
    void find_best(std::size_t n) {
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                rows_.bounds[k][i] = items_[i].low[k];
                rows_.bounds[3 + k][i] = items_[i].high[k];
            }
        constexpr Scalar k_far = std::numeric_limits<Scalar>::infinity();
        for (std::size_t k = 0; k < 6; ++k) std::fill_n(&rows_.bounds[k][n], k_radius, k < 3 ? -k_far : k_far);
        std::fill_n(areas_.data(), n + k_radius, k_far);
        for (std::size_t i = 0; i < n; ++i) best_[i] = static_cast<std::uint32_t>(i == 0 ? 1 : i - 1);
        for (std::size_t i = 0; i < n; ++i) {
            Quad<Scalar> own[6];
            for (std::size_t k = 0; k < 6; ++k) own[k] = all_of(rows_.bounds[k][i]);
            Quad<Scalar> least_areas = all_of(areas_[i]);
            IntQuad least_at = all_ints(static_cast<std::int32_t>(best_[i]));
            const IntQuad self = all_ints(static_cast<std::int32_t>(i));
            for (std::size_t part = 0; part < k_radius / k_lanes; ++part) {
                const std::size_t j = i + 1 + part * k_lanes;
                Quad<Scalar> d[3];
                for (std::size_t k = 0; k < 3; ++k)
                    d[k] = most(own[3 + k], at<Quad<Scalar>>(&rows_.bounds[3 + k][j])) -
                           least(own[k], at<Quad<Scalar>>(&rows_.bounds[k][j]));
                const Quad<Scalar> area = d[0] * d[1] + (d[1] * d[2] + d[2] * d[0]);
                const IntQuad places = all_ints(static_cast<std::int32_t>(j)) + IntQuad{0, 1, 2, 3};
                const auto nearer = narrow(area < least_areas);
                least_areas = least(area, least_areas);
                least_at = (nearer & places) | (~nearer & least_at);
                const Quad<Scalar> theirs = at<Quad<Scalar>>(&areas_[j]);
                const auto nearer_to_them = narrow(area < theirs);
                const Quad<Scalar> less = least(area, theirs);
                const IntQuad best = (nearer_to_them & self) | (~nearer_to_them & at<IntQuad>(&best_[j]));
                std::memcpy(&areas_[j], &less, sizeof less);
                std::memcpy(&best_[j], &best, sizeof best);
            }
            Scalar area = least_areas[0];
            std::int32_t place = least_at[0];
            for (std::size_t lane = 1; lane < k_lanes; ++lane) {
                const bool first = least_areas[lane] < area || (least_areas[lane] == area && least_at[lane] < place);
                area = first ? least_areas[lane] : area;
                place = first ? least_at[lane] : place;
            }
            best_[i] = static_cast<std::uint32_t>(place);
        }
    }

    template <class Q, class Number>
    [[gnu::always_inline]] static Q at(const Number* from) {
        Q q;
        std::memcpy(&q, from, sizeof q);
        return q;
    }
    [[gnu::always_inline]] static IntQuad all_ints(std::int32_t x) { return IntQuad{x, x, x, x}; }
    template <class Mask>
    [[gnu::always_inline]] static IntQuad narrow(Mask mask) {
        return __builtin_convertvector(mask, IntQuad);
    }

    RawArray<Binary<Scalar>> items_;
    RawArray<Binary<Scalar>> other_;
    Rows rows_;
    RawArray<std::uint32_t> best_;
    RawArray<Scalar> areas_;
};

}  // namespace pierce::detail
