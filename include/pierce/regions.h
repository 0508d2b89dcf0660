// Regions: what lies in front of each face and behind it, and which regions a flight goes through. For particle
// transport, and for bullets that go on behind a wall.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <pierce/collision_mesh.h>
#include <pierce/export.h>
#include <pierce/label_report.h>
#include <pierce/ray.h>
#include <pierce/result.h>
#include <pierce/types.h>

namespace pierce {

/// A part of a flight that lies in one region. Parameters are those of hits: fractions of a segment, in [0, 1], or the
/// t of a ray, in [0, limit], each within 1 ulp of the true one. Equal parameters have equal bits, and none is smaller
/// than one before it. A leg of length zero is one that a flight through an edge or a vertex has, or one between faces
/// that coincide.
template <class Scalar>
struct Leg {
    Scalar entry;          ///< where it begins
    Scalar exit;           ///< where it ends; not less than `entry`
    std::uint32_t region;  ///< that all of it lies in
    /// The region behind the face that the leg ends at, seen along the flight: that of the next leg. The same as
    /// `region` where the flight ends.
    std::uint32_t next;
    std::uint32_t face;      ///< the caller's number of the face at `exit`; `no_face` where the flight ends
    std::uint32_t triangle;  ///< as in `Hit`; `no_face` where the flight ends
    Sides side;              ///< that the flight comes to the face from
    /// Whether the face at `exit` has `region` on this side. If not, the labels are wrong (`Regions::check` says
    /// where): the flight came to this region by one face, and leaves another by the next.
    bool consistent;
};

/// A place for a particle, and the region that it lies in: always that of the point as it is, rounded.
template <class Scalar>
struct RegionPlace {
    Vec3<Scalar> point;    ///< representable, as it is
    std::uint32_t region;  ///< the region of `point`: `region_at(point)`
    /// Whether that is the region asked for, with nothing else on the way. If not, it is too thin here for any number
    /// that was tried.
    bool reached;
};

/// The regions of a mesh with labels. Faces may be shared by two volumes, and edges by any number of faces.
///
/// **The rule.** Every question is decided as `CollisionMesh::crossings` is: exactly, with each point moved by one
/// infinitesimal vector, the same for all. So no point lies on a face, no flight meets an edge or a vertex, and each
/// point and flight has one answer: a point on a face lies in one of its two regions, a flight through an edge where
/// many regions meet crosses one face after the other, and where a flight ends the next one goes on. In a model whose
/// labels agree (`check`) and whose faces do not pass through each other (volumes that overlap have such faces) that
/// means: the region behind the last face that a flight crosses is the region of its end, always, so that a particle's
/// region and its position never disagree and no particle is lost.
///
/// **A transport loop.** The particle is at `point`, in `region`; the next collision is at `distance`:
///
///     const Ray<double> ray{point, direction, distance};
///     Leg<double> leg;
///     regions.walk(ray, {&leg, 1});                        // leg.region == region
///     const bool collides = leg.face == no_face;
///     const bool stays = collides || is_mirror(leg.face);
///     const RegionPlace<double> place = stays ? regions.stop(ray, leg) : regions.cross(ray, leg);
///     point = place.point;
///     region = place.region;
///
/// Refers to the mesh, which must live longer and keep its positions (after `refit` or `rebuild` make new ones); moving
/// it does no harm. Copies the labels. Queries are thread-safe, allocate nothing and end for every input. What was
/// moved from can be assigned to and destroyed, no more.
template <class Scalar>
class PIERCE_EXPORT Regions {
  public:
    /// Stands for none: give it to no region.
    static constexpr std::uint32_t no_region = std::numeric_limits<std::uint32_t>::max();

    /// `labels[f]` is for the caller's face f (`MeshView::faces`). `outside`: the region around the model. Throws
    /// std::invalid_argument where a face has no label. Takes time and memory in proportion to the triangles.
    Regions(const CollisionMesh<Scalar>& mesh, std::span<const FaceRegions> labels, std::uint32_t outside = 0);
    /// The same without exceptions: nothing, a status and the exception's text where the constructor throws.
    [[nodiscard]] static Result<std::optional<Regions>> try_make(const CollisionMesh<Scalar>& mesh,
                                                                 std::span<const FaceRegions> labels,
                                                                 std::uint32_t outside = 0) noexcept;
    ~Regions();
    Regions(Regions&&) noexcept;
    Regions& operator=(Regions&&) noexcept;
    Regions(const Regions&) = delete;
    Regions& operator=(const Regions&) = delete;

    /// The region of a point: that on the near side of the first face on a way out; `outside` if there is none. Not
    /// finite: `outside`. Costs about a `first_hit`.
    [[nodiscard]] std::uint32_t region_at(const Vec3<Scalar>& point) const noexcept;

    /// Writes the first `out.size()` legs of a flight, in order, and returns how many that are. They begin with the
    /// flight; the last one ends with it if its face is `no_face`, else there may be more. The first one's region is
    /// that on the near side of its face, or `region_at` the start if there is no face on the flight. Where faces
    /// coincide, the one that leads on from the current region comes first (up to 32 in one place), else that of the
    /// smallest number. Costs what a query up to the last leg costs, times log n for n legs. An invalid flight (`Ray`)
    /// has no legs.
    std::size_t walk(const Segment<Scalar>& flight, std::span<Leg<Scalar>> out) const noexcept;
    std::size_t walk(const Ray<Scalar>& flight, std::span<Leg<Scalar>> out) const noexcept;

    /// Where a particle that goes to the end of a flight's **first** leg stops: before the face at its end, or at the
    /// end of the flight, in the leg's region. The way from the flight's start to the point crosses no face. Before a
    /// face that is the true point moved off the plane by a grain (`Hit::point`), rounded, or two, four or eight
    /// grains; where none of these will do, one on the way back to the start; in the end the start.
    [[nodiscard]] RegionPlace<Scalar> stop(const Segment<Scalar>& flight, const Leg<Scalar>& first) const noexcept;
    [[nodiscard]] RegionPlace<Scalar> stop(const Ray<Scalar>& flight, const Leg<Scalar>& first) const noexcept;

    /// Where a particle that goes through the face at the end of a flight's **first** leg goes on from: beyond the
    /// face, in the region `next`. The way from the flight's start to the point crosses this one surface only. That is
    /// the true point moved off the plane by a grain, rounded, or two, four or eight grains; else one further along the
    /// flight. Where the next region is too thin for these the point lies in another, which `region` names: as a rule
    /// the one that the flight comes to behind it. A leg without a face, and one of another flight or mesh,
    /// whose face this flight does not cross: the end of the flight, as for `stop`.
    [[nodiscard]] RegionPlace<Scalar> cross(const Segment<Scalar>& flight, const Leg<Scalar>& first) const noexcept;
    [[nodiscard]] RegionPlace<Scalar> cross(const Ray<Scalar>& flight, const Leg<Scalar>& first) const noexcept;

    /// Whether the labels agree wherever two faces bound one region: `LabelReport`. Looks at the faces around each
    /// edge, in exact order; faces that pass through each other are not looked for. Takes memory for them; n log n time
    /// for n triangles, and the square of their number for triangles that coincide.
    [[nodiscard]] LabelReport check() const;

    /// The region around the model, as it was given.
    [[nodiscard]] std::uint32_t outside() const noexcept;

  private:
    struct PIERCE_HIDDEN Impl;
    std::unique_ptr<Impl> impl_;
};

extern template class PIERCE_EXPORT Regions<float>;
extern template class PIERCE_EXPORT Regions<double>;

}  // namespace pierce
