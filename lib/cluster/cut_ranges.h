// The order of the triangles cut into ranges: subtrees of the radix tree of their keys.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <chunks.h>
#include <cluster/morton_key.h>
#include <cluster/sort_entries.h>
#include <raw_array.h>

namespace pierce::detail {

/// `key`: of the scene's lattice, if the entries have other ones by now.
struct Range {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t key;
    bool has_key;  ///< entries have keys of a finer lattice
    bool flat;     ///< all of them have the same centre
    /// The highest bit of an entry that is not the same in the one before: the range may have no less in common. Only
    /// `cut_small` knows it.
    int before = 63;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

template <class Scalar>
class RangeCutter {
  public:
    /// Threads are for keys of many triangles only.
    RangeCutter(const CornerReader<Scalar>& reader, std::uint64_t* entries, const Executor& executor)
        : reader_(reader), entries_(entries), executor_(executor) {}

    /// Cuts until ranges have at most `size` triangles and calls `visit(range)` for each, in order.
    template <class Visit>
    void cut(const Range& whole, std::uint32_t size, Visit&& visit) {
        stack_.assign(1, whole);
        while (!stack_.empty()) {
            Range range = stack_.back();
            stack_.pop_back();
            while (range.size() > size) {
                const std::uint32_t middle = place_to_cut(range);
                Range behind = range;
                behind.begin = middle;
                range.end = middle;
                stack_.push_back(behind);
            }
            visit(static_cast<const Range&>(range));
        }
    }

    /// The same for a size of a few, in one pass from the first to the last. The largest subtree that begins at i ends
    /// before the bits above two others' highest differing one change: i's and that before it, i's and that `size`
    /// behind it. Calls `visit(begin, end, key)`.
    template <std::uint32_t size, class Visit>
    void cut_small(const Range& whole, Visit&& visit) {
        stack_.assign(1, whole);
        while (!stack_.empty()) {
            Range range = stack_.back();
            stack_.pop_back();
            std::uint32_t i = range.begin;
            while (i < range.end) {
                const std::uint32_t left = range.end - i;
                const std::uint64_t* const at = entries_ + i;
                std::uint32_t count = 0;
                if (range.flat) {
                    count = std::min(left, size);
                } else if (left <= size) {
                    count = count_alike(at, range.before, left);
                } else if (const std::uint64_t bits = (at[0] ^ at[size]) >> 32; bits != 0) {
                    count = count_alike(at, std::min(range.before, 63 - std::countl_zero(bits << 32)), size);
                } else {
                    for (count = size + 1; count < left && (at[0] ^ at[count]) >> 32 == 0;) ++count;
                    Range behind = range;
                    behind.begin = i + count;
                    behind.before = behind.size() > 0 ? highest_differing(at + count) : 0;
                    stack_.push_back(behind);
                    range.begin = i;
                    range.end = i + count;
                    range.before = 63;
                    make_finer_keys(range);
                    continue;
                }
                visit(i, i + count, range.has_key ? range.key : static_cast<std::uint32_t>(at[0] >> 32));
                i += count;
                if (i < range.end) range.before = highest_differing(entries_ + i);
            }
        }
    }

  private:
    [[nodiscard, gnu::always_inline]] static int highest_differing(const std::uint64_t* at) {
        return 63 - std::countl_zero(at[-1] ^ at[0]);
    }
    // How many of so many entries, the first ones, have the first one's bits from `bit` on.
    [[nodiscard, gnu::always_inline]] static std::uint32_t count_alike(const std::uint64_t* at, int bit,
                                                                       std::uint32_t most) {
        std::uint32_t count = 1;
        for (std::uint32_t i = 1; i < most; ++i) count += (at[0] ^ at[i]) >> bit == 0;
        return count;
    }

    // Where the highest bit changes that is not the same in all keys; if all are the same, keys of a finer lattice are
    // made; if centres are the same as well, in the middle. Each finer lattice tells the lowest centre from the
    // highest, so this ends.
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
        if (!range.has_key) range.key = static_cast<std::uint32_t>(entries_[range.begin] >> 32);
        range.has_key = true;
        const auto center = [&](std::size_t i) {
            return half_center(reader_.box(static_cast<std::uint32_t>(entries_[i])));
        };
        // Of few, centres are kept from the first pass for the second.
        const bool few = range.size() < k_radix;
        if (few && centers_.size() == 0) centers_ = RawArray<Quad<Scalar>>(k_radix);
        boxes_.assign(chunks_of(range.size()), {});
        each_chunk(executor_, range.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
            QuadBox<Scalar> box;
            for (std::size_t i = range.begin + begin; i < range.begin + end; ++i) {
                const Quad<Scalar> c = center(i);
                box.add({c, c});
                if (few) centers_[i - range.begin] = c;
            }
            boxes_[chunk] = box;
        });
        QuadBox<Scalar> box;
        for (const QuadBox<Scalar>& part : boxes_) box.add(part);
        const KeyRaster<Scalar> raster(box.low, box.high);
        range.flat = raster.flat();
        if (range.flat) return;
        each_chunk(executor_, range.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = range.begin + begin; i < range.begin + end; i += 4)
                put_keys<Scalar>(
                    raster, std::min<std::size_t>(range.begin + end - i, 4), entries_ + i,
                    [&](std::size_t lane) { return few ? centers_[i + lane - range.begin] : center(i + lane); },
                    [&](std::size_t lane) { return static_cast<std::uint32_t>(entries_[i + lane]); });
        });
        std::uint64_t* const first = entries_ + range.begin;
        if (few) return std::sort(first, first + range.size());
        if (sorted_.size() < range.size()) sorted_ = RawArray<std::uint64_t>(range.size());
        sort_entries(first, sorted_.data(), range.size(), executor_);
        std::copy_n(sorted_.data(), range.size(), first);
    }

    // From so many on, three passes are faster than comparing.
    static constexpr std::uint32_t k_radix = 1024;

    const CornerReader<Scalar>& reader_;
    std::uint64_t* entries_;
    const Executor& executor_;
    std::vector<Range> stack_;
    std::vector<QuadBox<Scalar>> boxes_;
    RawArray<Quad<Scalar>> centers_;
    RawArray<std::uint64_t> sorted_;
};

}  // namespace pierce::detail
