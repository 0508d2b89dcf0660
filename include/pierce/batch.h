// What batches are asked, and where they write their answers: views of the caller's memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include <pierce/hit.h>
#include <pierce/points_view.h>
#include <pierce/types.h>

namespace pierce {

/// Many segments: a `std::vector<Segment<Scalar>>` or span of them; or their starts and their ends, each a `PointsView`
/// or anything that makes one: `first_hits({starts, ends}, ...)`. Not owned.
template <class Scalar>
class Segments {
  public:
    Segments() = default;
    Segments(const PointsView<Scalar>& starts, const PointsView<Scalar>& ends) : starts_(starts), ends_(ends) {}
    template <detail::SpanOf<Segment<Scalar>> Range>
    Segments(const Range& segments) {
        static_assert(sizeof(Segment<Scalar>) == 6 * sizeof(Scalar));
        const std::span<const Segment<Scalar>> all(segments);
        if (all.empty()) return;
        starts_ = {all[0].from.data(), all.size(), sizeof(Segment<Scalar>)};
        ends_ = {all[0].to.data(), all.size(), sizeof(Segment<Scalar>)};
    }

    [[nodiscard]] std::size_t size() const { return starts_.size(); }
    [[nodiscard]] const PointsView<Scalar>& starts() const { return starts_; }
    [[nodiscard]] const PointsView<Scalar>& ends() const { return ends_; }

  private:
    PointsView<Scalar> starts_;
    PointsView<Scalar> ends_;
};

/// Hits as one array for each of their members: entry i of each is of query i. Null arrays are not written. Points and
/// vectors are three numbers in a row. For a miss `hit` is 0, `face` and `triangle` are `no_face`, and all others are
/// 0.
template <class Scalar>
struct HitArrays {
    std::size_t count = 0;  ///< how many entries each array has
    std::uint8_t* hit = nullptr;
    Scalar* fraction = nullptr;
    Scalar* exact_fraction = nullptr;
    Scalar* point = nullptr;
    Scalar* position = nullptr;
    Scalar* normal = nullptr;
    Scalar* barycentric = nullptr;
    std::uint32_t* face = nullptr;
    std::uint32_t* triangle = nullptr;
    Sides* side = nullptr;
    Feature* feature = nullptr;
    std::uint8_t* feature_index = nullptr;
    std::uint8_t* at_start = nullptr;
};

/// Where a batch writes its hits; the bits are the same in each:
///   std::vector<std::optional<Hit>>, or a span of them
///   std::vector<Hit>, or a span of them: plain memory, in which a miss is `no_hit`
///   HitArrays
template <class Scalar>
using HitsOut = std::variant<std::span<std::optional<Hit<Scalar>>>, std::span<Hit<Scalar>>, HitArrays<Scalar>>;

}  // namespace pierce
