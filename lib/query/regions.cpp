// The façade of regions.
#include <pierce/regions.h>

#include <stdexcept>

#include <environment.h>
#include <query/collision_mesh_impl.h>
#include <query/label_check.h>
#include <query/region_place.h>
#include <query/region_walk.h>
#include <without_exceptions.h>

namespace pierce {

using namespace detail;

template <class Scalar>
struct Regions<Scalar>::Impl {
    const typename CollisionMesh<Scalar>::Impl& mesh;
    RegionScene<Scalar> scene;
};

template <class Scalar>
Regions<Scalar>::Regions(const CollisionMesh<Scalar>& mesh, std::span<const FaceRegions> labels, std::uint32_t outside)
    : impl_(
          std::make_unique<Impl>(Impl{*mesh.impl_, {mesh.impl_->scene, {labels.begin(), labels.end()}, {}, outside}})) {
    const Scene<Scalar>& scene = mesh.impl_->scene;
    RawArray<TriangleRef>& where = impl_->scene.where;
    where = RawArray<TriangleRef>(scene.triangles.size());
    std::fill(where.begin(), where.end(), k_nowhere);
    for (std::uint32_t number = 0; number < scene.triangles.size(); ++number)
        if (scene.face_of_number(number) >= labels.size())
            throw std::invalid_argument("labels: face " + std::to_string(scene.face_of_number(number)) +
                                        " has none (there are " + std::to_string(labels.size()) + ")");
    scene.each_triangle([&](TriangleRef triangle) { where[scene.number_of(triangle)] = triangle; });
}

template <class Scalar>
Result<std::optional<Regions<Scalar>>> Regions<Scalar>::try_make(const CollisionMesh<Scalar>& mesh,
                                                                 std::span<const FaceRegions> labels,
                                                                 std::uint32_t outside) noexcept {
    Result<std::optional<Regions>> result;
    result.status =
        without_exceptions([&] { result.value.emplace(mesh, labels, outside); }, Status::bad_mesh, result.message);
    return result;
}
template <class Scalar>
Regions<Scalar>::~Regions() = default;
template <class Scalar>
Regions<Scalar>::Regions(Regions&&) noexcept = default;
template <class Scalar>
Regions<Scalar>& Regions<Scalar>::operator=(Regions&&) noexcept = default;

template <class Scalar>
std::uint32_t Regions<Scalar>::region_at(const Vec3<Scalar>& point) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(point)) return impl_->scene.outside;
    return detail::region_at(impl_->scene, to_point(point), counters);
}

template <class Scalar>
std::size_t Regions<Scalar>::walk(const Segment<Scalar>& flight, std::span<Leg<Scalar>> out) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(flight)) return 0;
    return detail::walk(impl_->scene, flight, out, counters);
}

template <class Scalar>
std::size_t Regions<Scalar>::walk(const Ray<Scalar>& flight, std::span<Leg<Scalar>> out) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(flight)) return 0;
    return detail::walk(impl_->scene, flight, out, counters);
}

template <class Scalar>
RegionPlace<Scalar> Regions<Scalar>::stop(const Segment<Scalar>& flight, const Leg<Scalar>& first) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(flight)) return {flight.from, first.region, false};
    return detail::stop(impl_->scene, flight, first, counters);
}

template <class Scalar>
RegionPlace<Scalar> Regions<Scalar>::stop(const Ray<Scalar>& flight, const Leg<Scalar>& first) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(flight)) return {flight.origin, first.region, false};
    return detail::stop(impl_->scene, flight, first, counters);
}

template <class Scalar>
RegionPlace<Scalar> Regions<Scalar>::cross(const Segment<Scalar>& flight, const Leg<Scalar>& first) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(flight)) return {flight.from, first.region, false};
    return detail::cross(impl_->scene, flight, first, counters);
}

template <class Scalar>
RegionPlace<Scalar> Regions<Scalar>::cross(const Ray<Scalar>& flight, const Leg<Scalar>& first) const noexcept {
    const StandardArithmetic standard;
    QueryCounters counters;
    if (!impl_->mesh.valid(flight)) return {flight.origin, first.region, false};
    return detail::cross(impl_->scene, flight, first, counters);
}

template <class Scalar>
LabelReport Regions<Scalar>::check() const {
    const StandardArithmetic standard;
    return check_labels(impl_->scene);
}

template <class Scalar>
std::uint32_t Regions<Scalar>::outside() const noexcept {
    return impl_->scene.outside;
}

template class Regions<float>;
template class Regions<double>;

}  // namespace pierce
