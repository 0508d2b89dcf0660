// What batches are asked, and where they write their answers: views of the caller's memory.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include <pierce/hit.h>
#include <pierce/points_view.h>
#include <pierce/ray.h>
#include <pierce/types.h>

namespace pierce {

/// Many segments: a `std::vector<Segment<Scalar>>` or span of them; or their starts and their ends, each a `PointsView`
/// or anything that makes one: `first_hits({starts, ends}, ...)`. Not owned.
template <class Scalar>
class Segments {
  public:
    Segments() = default;
    /// Starts and ends; a batch refuses a different number of them.
    Segments(const PointsView<Scalar>& starts, const PointsView<Scalar>& ends) : starts_(starts), ends_(ends) {}
    /// A vector, an array or a span of segments.
    template <detail::SpanOf<Segment<Scalar>> Range>
    Segments(const Range& segments) {
        static_assert(sizeof(Segment<Scalar>) == 6 * sizeof(Scalar));
        const std::span<const Segment<Scalar>> all(segments);
        if (all.empty()) return;
        starts_ = {all[0].from.data(), all.size(), sizeof(Segment<Scalar>)};
        ends_ = {all[0].to.data(), all.size(), sizeof(Segment<Scalar>)};
    }

    /// How many segments there are: as many as starts.
    [[nodiscard]] std::size_t size() const { return starts_.size(); }
    /// Where they begin.
    [[nodiscard]] const PointsView<Scalar>& starts() const { return starts_; }
    /// Where they end.
    [[nodiscard]] const PointsView<Scalar>& ends() const { return ends_; }
    /// A copy of segment i, which must be below `size()`.
    [[nodiscard]] Segment<Scalar> operator[](std::size_t i) const { return {starts_[i], ends_[i]}; }

  private:
    PointsView<Scalar> starts_;
    PointsView<Scalar> ends_;
};

/// Many rays: a `std::vector<Ray<Scalar>>` or span of them; or their origins and directions, each a `PointsView` or
/// anything that makes one, with one limit for all of them or an array of limits. Not owned.
template <class Scalar>
class Rays {
  public:
    Rays() = default;
    /// Origins and directions, with one limit for all; a batch refuses a different number of them.
    Rays(const PointsView<Scalar>& origins, const PointsView<Scalar>& directions,
         Scalar limit = std::numeric_limits<Scalar>::infinity())
        : origins_(origins), directions_(directions), limit_(limit) {}
    /// `stride`: bytes from one limit to the next one's. There must be as many as origins.
    Rays(const PointsView<Scalar>& origins, const PointsView<Scalar>& directions, const Scalar* limits,
         std::ptrdiff_t stride = sizeof(Scalar))
        : origins_(origins),
          directions_(directions),
          limits_(reinterpret_cast<const std::byte*>(limits)),
          limit_stride_(stride) {}
    /// A vector, an array or a span of rays.
    template <detail::SpanOf<Ray<Scalar>> Range>
    Rays(const Range& rays) {
        const std::span<const Ray<Scalar>> all(rays);
        if (all.empty()) return;
        origins_ = {all[0].origin.data(), all.size(), sizeof(Ray<Scalar>)};
        directions_ = {all[0].direction.data(), all.size(), sizeof(Ray<Scalar>)};
        limits_ = reinterpret_cast<const std::byte*>(&all[0].limit);
        limit_stride_ = sizeof(Ray<Scalar>);
    }

    /// How many rays there are: as many as origins.
    [[nodiscard]] std::size_t size() const { return origins_.size(); }
    /// Where they begin.
    [[nodiscard]] const PointsView<Scalar>& origins() const { return origins_; }
    /// Where they go.
    [[nodiscard]] const PointsView<Scalar>& directions() const { return directions_; }
    /// A copy of ray i, which must be below `size()`.
    [[nodiscard]] Ray<Scalar> operator[](std::size_t i) const {
        Ray<Scalar> ray{origins_[i], directions_[i], limit_};
        if (limits_ != nullptr)
            std::memcpy(&ray.limit, limits_ + static_cast<std::ptrdiff_t>(i) * limit_stride_, sizeof ray.limit);
        return ray;
    }

  private:
    PointsView<Scalar> origins_;
    PointsView<Scalar> directions_;
    Scalar limit_ = std::numeric_limits<Scalar>::infinity();
    const std::byte* limits_ = nullptr;  ///< null: `limit_` is that of all
    std::ptrdiff_t limit_stride_ = 0;
};

namespace detail {

/// What is a batch of rays and not one of segments.
template <class Range, class Scalar>
concept RaysOf =
    std::convertible_to<const Range&, Rays<Scalar>> && !std::convertible_to<const Range&, Segments<Scalar>>;

}  // namespace detail

/// Hits as one array for each of their members: entry i of each is of query i. Null arrays are not written. Points and
/// vectors are three numbers in a row. For a miss `hit` is 0, `face` and `triangle` are `no_face`, and all others are
/// 0.
template <class Scalar>
struct HitArrays {
    std::size_t count = 0;                  ///< how many entries each array has
    std::uint8_t* hit = nullptr;            ///< 1 or 0
    Scalar* fraction = nullptr;             ///< `Hit::fraction`
    Scalar* exact_fraction = nullptr;       ///< `Hit::exact_fraction`
    Scalar* point = nullptr;                ///< `Hit::point`, three numbers a hit
    Scalar* position = nullptr;             ///< `Hit::position`, three numbers a hit
    Scalar* normal = nullptr;               ///< `Hit::normal`, three numbers a hit
    Scalar* barycentric = nullptr;          ///< `Hit::barycentric`, three numbers a hit
    std::uint32_t* face = nullptr;          ///< `Hit::face`
    std::uint32_t* triangle = nullptr;      ///< `Hit::triangle`
    Sides* side = nullptr;                  ///< `Hit::side`
    Feature* feature = nullptr;             ///< `Hit::feature`
    std::uint8_t* feature_index = nullptr;  ///< `Hit::feature_index`
    std::uint8_t* at_start = nullptr;       ///< `Hit::at_start`, 1 or 0
};

/// Where a batch writes its hits; the bits are the same in each:
/// - `std::vector<std::optional<Hit>>`, or a span of them;
/// - `std::vector<Hit>`, or a span of them: plain memory, in which a miss is `no_hit`;
/// - `HitArrays`.
template <class Scalar>
using HitsOut = std::variant<std::span<std::optional<Hit<Scalar>>>, std::span<Hit<Scalar>>, HitArrays<Scalar>>;

}  // namespace pierce
