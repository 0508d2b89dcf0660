// A binary tree from the leaves up: neighbours in Morton order that are each other's best are joined, round by round
// (Meister and Bittner 2018).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include <raw_array.h>
#include <tree/binary.h>

namespace pierce::detail {

/// Joins `count` items (whose `at` is kept in the leaves, with a `count` that is not 0) to a tree with its root at
/// `root` and other nodes from
/// `next` on. False if that takes too many rounds, as where the items' sizes grow along the order: each round would
/// join one pair.
template <class Scalar>
class Ploc {
  public:
    explicit Ploc(std::size_t count) : items_(count), other_(count), best_(count), areas_(count) {}

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

    // Of those that are equally good the first: then the first of the best pairs is joined in every round, and rounds
    // end.
    void find_best(std::size_t n) {
        std::fill_n(areas_.data(), n, std::numeric_limits<Scalar>::infinity());
        for (std::size_t i = 0; i < n; ++i) best_[i] = static_cast<std::uint32_t>(i == 0 ? 1 : i - 1);
        for (std::size_t i = 0; i < n; ++i) {
            const QuadBox<Scalar> box = box_of<Scalar>(items_[i]);
            Scalar least_area = areas_[i];
            std::uint32_t best = best_[i];
            const std::size_t end = std::min(n, i + 1 + k_radius);
            for (std::size_t j = i + 1; j < end; ++j) {
                QuadBox<Scalar> both = box_of<Scalar>(items_[j]);
                both.add(box);
                const Scalar area = both.area();
                if (area < least_area) {
                    least_area = area;
                    best = static_cast<std::uint32_t>(j);
                }
                if (area < areas_[j]) {
                    areas_[j] = area;
                    best_[j] = static_cast<std::uint32_t>(i);
                }
            }
            best_[i] = best;
        }
    }

    RawArray<Binary<Scalar>> items_;
    RawArray<Binary<Scalar>> other_;
    RawArray<std::uint32_t> best_;
    RawArray<Scalar> areas_;
};

}  // namespace pierce::detail
