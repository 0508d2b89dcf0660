// Corners from the caller's memory, and the keys of triangles: their places on a lattice of 1024 cells along each axis,
// in Z-order (Morton 1966).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <cluster/quad.h>
#include <plain_mesh.h>

namespace pierce::detail {

/// By pointers of its own: copied to where they are used, they stay in registers.
template <class Scalar>
class CornerReader {
  public:
    explicit CornerReader(const PlainMesh<Scalar>& mesh)
        : positions_(mesh.positions.data()),
          triangles_(mesh.triangles.data()),
          last_(static_cast<std::uint32_t>(mesh.positions.size() - 1)) {}

    /// Four numbers are read where one more vertex follows, never beyond the last.
    [[nodiscard, gnu::always_inline]] Quad<Scalar> corner(std::uint32_t vertex) const {
        const Scalar* from = positions_[vertex].data();
        if (vertex == last_) return Quad<Scalar>{from[0], from[1], from[2], 0};
        Quad<Scalar> quad;
        std::memcpy(&quad, from, sizeof quad);
        return quad;
    }
    [[nodiscard, gnu::always_inline]] QuadBox<Scalar> box(std::size_t triangle) const {
        const IndexTriple& t = triangles_[triangle];
        const Quad<Scalar> a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
        return {least(a, least(b, c)), most(a, most(b, c))};
    }
    [[nodiscard, gnu::always_inline]] const IndexTriple& triangle(std::size_t triangle) const {
        return triangles_[triangle];
    }
    [[gnu::always_inline]] void ask_for_triangle(std::size_t triangle) const {
        __builtin_prefetch(&triangles_[triangle]);
    }
    [[gnu::always_inline]] void ask_for_corners(std::size_t triangle) const {
        for (const std::uint32_t vertex : triangles_[triangle]) __builtin_prefetch(&positions_[vertex]);
    }

  private:
    const Vec3<Scalar>* positions_;
    const IndexTriple* triangles_;
    std::uint32_t last_;
};

/// The power of two that brings a positive number to [2^exponent, 2^(exponent + 1)), or as near as powers that are not
/// subnormal can.
template <class Scalar>
[[nodiscard]] Scalar power_to_reach(int exponent, Scalar x) {
    using Limits = std::numeric_limits<Scalar>;
    return std::ldexp(Scalar(1),
                      std::clamp(exponent - std::ilogb(x), Limits::min_exponent - 1, Limits::max_exponent - 1));
}

/// Half of a box's centre: neither the sum nor a difference of two of them overflows.
template <class Scalar>
[[gnu::always_inline]] inline Quad<Scalar> half_center(const QuadBox<Scalar>& box) {
    return box.low * Scalar(0.25) + box.high * Scalar(0.25);
}

/// Cubic cells over all the half centres that there are.
template <class Scalar>
class KeyRaster {
  public:
    KeyRaster(Quad<Scalar> low, Quad<Scalar> high) : low_(low) {
        const Scalar extent = largest_of<Scalar>(high - low);
        flat_ = !(extent > 0);
        if (flat_) return;
        unit_ = power_to_reach(0, extent);
        scale_ = Scalar(1023) / (extent * unit_);
    }
    [[nodiscard]] bool flat() const { return flat_; }  ///< all in one place

    /// Of four triangles, whose half centres are given as rows of x, y and z: 30 bits each. Rounding may move what lies
    /// at a cell's end to the next one: keys are a good order, no more.
    [[nodiscard, gnu::always_inline]] IntQuad keys(const Quad<Scalar> (&half_centers)[3]) const {
        IntQuad cells[3];
        for (int k = 0; k < 3; ++k) {
            const Quad<Scalar> cell = (half_centers[k] - all_of(low_[k])) * all_of(unit_) * all_of(scale_);
            IntQuad x = __builtin_convertvector(least(most(cell, all_of<Scalar>(0)), all_of<Scalar>(1023)), IntQuad);
            x = (x | x << 16) & 0x030000ff;
            x = (x | x << 8) & 0x0300f00f;
            x = (x | x << 4) & 0x030c30c3;
            cells[k] = (x | x << 2) & 0x09249249;
        }
        return cells[0] | cells[1] << 1 | cells[2] << 2;
    }

  private:
    Quad<Scalar> low_;
    Scalar unit_ = 1;
    Scalar scale_ = 0;
    bool flat_ = false;
};

/// Entries of up to four triangles, whose half centres are `center(lane)` and whose numbers `number(lane)`.
template <class Scalar, class Center, class Number>
[[gnu::always_inline]] inline void put_keys(const KeyRaster<Scalar>& raster, std::size_t count, std::uint64_t* entries,
                                            Center&& center, Number&& number) {
    Quad<Scalar> centers[4];
    for (std::size_t lane = 0; lane < 4; ++lane) centers[lane] = center(std::min(lane, count - 1));
    Quad<Scalar> rows[3];
    transpose(centers, rows);
    const IntQuad keys = raster.keys(rows);
    for (std::size_t lane = 0; lane < count; ++lane)
        entries[lane] = std::uint64_t{static_cast<std::uint32_t>(keys[lane])} << 32 | number(lane);
}

}  // namespace pierce::detail
