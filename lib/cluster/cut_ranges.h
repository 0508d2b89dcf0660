// The order of the triangles cut into ranges: subtrees of the radix tree of their keys, from the top.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <cluster/morton_key.h>

namespace pierce::detail {

/// `key`: of the scene's lattice, if the entries have other ones by now.
struct Range {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t key;
    bool has_key;  ///< entries have keys of a finer lattice
    bool flat;     ///< all of them have the same centre

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

template <class Scalar>
class RangeCutter {
  public:
    RangeCutter(const CornerReader<Scalar>& reader, std::uint64_t* entries) : reader_(reader), entries_(entries) {}

    /// Cuts until ranges have at most `size` triangles and calls `visit(range)` for each, in order. No more than
    /// `stack` holds memory.
    template <class Visit>
    void cut(const Range& whole, std::uint32_t size, std::vector<Range>& stack, Visit&& visit) {
        stack.assign(1, whole);
        while (!stack.empty()) {
            Range range = stack.back();
            stack.pop_back();
            while (range.size() > size) {
                const std::uint32_t middle = place_to_cut(range);
                Range behind = range;
                behind.begin = middle;
                range.end = middle;
                stack.push_back(behind);
            }
            visit(static_cast<const Range&>(range));
        }
    }
    [[nodiscard]] std::uint32_t key_of(const Range& range) const {
        return range.has_key ? range.key : static_cast<std::uint32_t>(entries_[range.begin] >> 32);
    }

  private:
    // Where the highest bit changes that is not the same in all keys; if all are the same, keys of a finer lattice are
    // made; if centres are the
    // same as well, in the middle. Each finer lattice tells the lowest centre from the highest, so this ends.
    std::uint32_t place_to_cut(Range& range) {
        const auto differing = [&] {
            return static_cast<std::uint32_t>((entries_[range.begin] ^ entries_[range.end - 1]) >> 32);
        };
        std::uint32_t bits = range.flat ? 0 : differing();
        if (bits == 0 && !range.flat) {
            make_finer_keys(range);
            bits = range.flat ? 0 : differing();
        }
        if (bits == 0) return range.begin + range.size() / 2;
        const int bit = 63 - std::countl_zero(bits);  // of an entry: 32 more than of a key
        std::uint32_t low = range.begin;
        std::uint32_t high = range.end;
        while (low < high) {
            const std::uint32_t at = low + (high - low) / 2;
            const bool one = entries_[at] >> bit & 1;
            high = one ? at : high;
            low = one ? low : at + 1;
        }
        return low;
    }

    void make_finer_keys(Range& range) {
        range.key = key_of(range);
        range.has_key = true;
        const auto center = [&](std::uint32_t i) {
            return half_center(reader_.box(static_cast<std::uint32_t>(entries_[i])));
        };
        QuadBox<Scalar> box;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const Quad<Scalar> c = center(i);
            box.add({c, c});
        }
        const KeyRaster<Scalar> raster(box.low, box.high);
        range.flat = raster.flat();
        if (range.flat) return;
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            entries_[i] = std::uint64_t{raster.key(center(i))} << 32 | static_cast<std::uint32_t>(entries_[i]);
        std::sort(entries_ + range.begin, entries_ + range.end);
    }

    const CornerReader<Scalar>& reader_;
    std::uint64_t* entries_;
};

}  // namespace pierce::detail
