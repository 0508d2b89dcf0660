// One way to ask one library: a column of the tables. What is timed is `ask`, and nothing else.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <pierce/collision_mesh.h>

namespace pierce::bench {

struct Answer {
    bool hit = false;
    double fraction = std::numeric_limits<double>::quiet_NaN();  ///< if the call says so
};

class Column {
  public:
    explicit Column(std::string_view name) : name_(name) {}
    Column(const Column&) = delete;
    Column& operator=(const Column&) = delete;
    virtual ~Column() = default;

    [[nodiscard]] std::string_view name() const { return name_; }

    /// Brings the segments into the form that the library takes.
    virtual void prepare(std::span<const Segment<float>> segments) = 0;
    /// Asks about segments begin .. end - 1 and returns how many hit.
    virtual std::size_t ask(std::size_t begin, std::size_t end) = 0;
    /// One answer, to compare it with those of others.
    virtual Answer answer(std::size_t i) { return {.hit = ask(i, i + 1) > 0}; }

  private:
    std::string_view name_;
};

using Columns = std::vector<std::unique_ptr<Column>>;

/// Names, as they stand in tables. What each calls is said in `k_columns_text`.
namespace column {
inline constexpr std::string_view pierce = "pierce";
inline constexpr std::string_view pierce_batch = "pierce batch";
inline constexpr std::string_view pierce_any = "pierce any";
inline constexpr std::string_view pierce_any_batch = "pierce any batch";
inline constexpr std::string_view fronts = "fronts";
inline constexpr std::string_view fronts_batch = "fronts batch";
inline constexpr std::string_view grid = "grid";
inline constexpr std::string_view grid_batch = "grid batch";
inline constexpr std::string_view pierce_double = "pierce double";
inline constexpr std::string_view pierce_double_batch = "double batch";
inline constexpr std::string_view pierce_two_threads = "two threads";
inline constexpr std::string_view embree = "Embree";
inline constexpr std::string_view embree_any = "Embree any";
inline constexpr std::string_view embree_stream = "Embree 1M";
inline constexpr std::string_view embree_robust = "Embree robust";
inline constexpr std::string_view embree_low = "Embree low";
inline constexpr std::string_view bullet = "Bullet";
inline constexpr std::string_view cgal_any = "CGAL any";
inline constexpr std::string_view cgal_first = "CGAL first";
}  // namespace column

inline constexpr std::string_view k_columns_text =
    R"(Both sides of a face count in every column but that of the fronts.

- **pierce**: `first_hit` in float; any: `any_hit`; batch: `first_hits` and `any_hits`, one thread; fronts:
  `Sides::front`; grid: the uniform grid as the broadphase; double: the same floats as doubles.
- **Embree**: `rtcIntersect1` from 0 to 1 along `to - from`, high quality, not robust, incoherent, one thread, denormals
  flushed as its manual advises. any: `rtcOccluded1`; 1M: `rtcIntersect1M` for 256 rays at a time; robust: high quality
  and `RTC_SCENE_FLAG_ROBUST`; low: low quality.
- **Bullet**: `performRaycast` of a `btBvhTriangleMeshShape` with a `btTriangleRaycastCallback`.
- **CGAL**: `AABB_tree`, exact predicates and inexact constructions, in double; any: `do_intersect`; first: the nearest
  of `all_intersections`, as it has no first hit of a segment.

Segments are in each library's own form before time is taken: peers are charged for the call and reading its result.
)";

template <class Scalar>
using SharedMesh = std::shared_ptr<const CollisionMesh<Scalar>>;

template <class Scalar>
void add_pierce_columns(Columns& columns, const SharedMesh<Scalar>& mesh);
void add_grid_columns(Columns& columns, const MeshView<float>& mesh);
/// `first_hits` for both sides.
std::unique_ptr<Column> pierce_batch_column(std::string_view name, const SharedMesh<float>& mesh, unsigned threads);

/// The robust and the low scene are built only if `all` is set.
void add_embree_columns(Columns& columns, const MeshView<float>& mesh, bool all);
void add_bullet_column(Columns& columns, const MeshView<float>& mesh);
void add_cgal_columns(Columns& columns, const MeshView<float>& mesh);

}  // namespace pierce::bench
