// From coordinates to cells: one monotone function, the same for triangles and for queries.
//
// Whatever the rounding does to it, a function that never decreases maps a point that lies in two boxes into both of their images: so
// boxes that touch share a step, with no margin, at any distance from the origin and for any size.
#pragma once

#include <packed_box.h>
#include <point.h>

namespace pierce::detail {

/// A closed box; `low <= high` on every axis.
struct Box {
    Point low;
    Point high;
};

[[nodiscard]] inline bool overlap(const Box& x, const Box& y) {
    for (std::size_t k = 0; k < 3; ++k)
        if (x.low[k] > y.high[k] || x.high[k] < y.low[k]) return false;
    return true;
}

class Raster {
  public:
    Raster() = default;
    /// The cells that cover `box`, cubes of the given size, at most `k_most_cells` along an axis. A size of 0 or infinity, or one that
    /// would need more: larger cells, not cubes if need be.
    Raster(const Box& box, double size);

    static constexpr int k_most_cells = 1 << 20;

    [[nodiscard]] const std::array<int, 3>& cells() const { return cells_; }
    /// The edge of a cell along an axis; infinite for cells beyond the range of a double.
    [[nodiscard]] double size(std::size_t axis) const { return 2 * k_steps / scale_[axis]; }

    [[nodiscard]] double least_size() const { return std::min({size(0), size(1), size(2)}); }

    /// Where a coordinate is, in steps, not rounded to whole ones: may be far outside of the cells, or infinite. `half`: half of the
    /// coordinate, so that the difference of two huge ones does not overflow.
    [[nodiscard]] double place(std::size_t axis, double half) const { return (half - half_low_[axis]) * scale_[axis]; }
    [[nodiscard]] double half_low(std::size_t axis) const { return half_low_[axis]; }
    [[nodiscard]] double scale(std::size_t axis) const { return scale_[axis]; }
    /// The number of steps along an axis.
    [[nodiscard]] double most(std::size_t axis) const { return most_[axis]; }

    /// The steps that a box is in; -1 below all cells, the number of steps above them.
    template <class Scalar>
    [[nodiscard]] Steps steps(const std::array<Scalar, 3>& low, const std::array<Scalar, 3>& high) const {
        return {step(low), step(high)};
    }
    [[nodiscard]] bool outside(const Steps& box) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (box.high[k] < 0 || box.low[k] >= cells_[k] * k_steps) return true;
        return false;
    }
    /// The cell of a place in steps; the outermost one for a place outside.
    [[nodiscard]] std::array<int, 3> cell_of(const Ints& step) const {
        std::array<int, 3> cell{};
        for (std::size_t k = 0; k < 3; ++k) cell[k] = std::min(std::max(step[k], 0) >> k_step_bits, cells_[k] - 1);
        return cell;
    }

  private:
    template <class Scalar>
    [[nodiscard]] Ints step(const std::array<Scalar, 3>& x) const {
        const auto along = [&](std::size_t k) {
            const double g = place(k, 0.5 * static_cast<double>(x[k]));
            return g >= 0 ? static_cast<int>(std::min(g, most_[k])) : -1;
        };
        return Ints{along(0), along(1), along(2), 0};
    }

    Point half_low_ = {0, 0, 0};
    Point scale_ = {0, 0, 0};  ///< steps for each half unit
    Point most_ = {k_steps, k_steps, k_steps};
    std::array<int, 3> cells_ = {1, 1, 1};
};

}  // namespace pierce::detail
