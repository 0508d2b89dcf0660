// Triangles in the order of a Z-shaped curve through the cells of a fine grid, so that what is near in space is near in memory.
#pragma once

#include <cstdint>
#include <limits>

#include <pierce/executor.h>
#include <pierce/mesh_view.h>
#include <raw_array.h>
#include <vector4.h>

namespace pierce::detail {

/// The key of a triangle in bits 32-61, its number in the lower half.
using Keyed = std::uint64_t;
constexpr int k_key_bits = 30;

/// Keys of boxes' centres: a cell of the grid along each axis, ten bits each, interleaved. (Morton 1966.)
template <class Scalar>
class MortonGrid {
  public:
    /// Of cubes: `low` and `high` are twice the least and the greatest centre.
    MortonGrid(const Vector4<Scalar>& low, const Vector4<Scalar>& high) : low_(low) {
        Scalar widest = 0;
        for (int k = 0; k < 3; ++k) widest = high[k] - low[k] > widest ? high[k] - low[k] : widest;
        // Finite whatever the numbers; a single point gets key 0.
        scale_ = widest > 0 && 1023 / widest <= std::numeric_limits<Scalar>::max() ? 1023 / widest : 0;
    }
    [[nodiscard]] std::uint32_t key(const Vector4<Scalar>& twice_center) const {
        const Vector4<Scalar> cell = (twice_center - low_) * scale_;
        return spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
    }

  private:
    // NaN, from infinite differences, is 0 as well.
    static std::uint32_t spread(Scalar x) {
        std::uint32_t b = x > 0 ? x < 1023 ? static_cast<std::uint32_t>(x) : 1023 : 0;
        b = (b | b << 16) & 0x030000ff;
        b = (b | b << 8) & 0x0300f00f;
        b = (b | b << 4) & 0x030c30c3;
        b = (b | b << 2) & 0x09249249;
        return b;
    }

    Vector4<Scalar> low_;
    Scalar scale_;
};

/// Sorts by key, stably.
void sort_by_key(RawArray<Keyed>& keyed, const Executor& executor);

}  // namespace pierce::detail
