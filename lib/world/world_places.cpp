// The façade of points in worlds, passages, and why faces are hit.
#include <environment.h>
#include <query/along.h>
#include <query/parts.h>
#include <world/places.h>
#include <world/world_impl.h>

namespace pierce {

using namespace detail;

template <class Scalar>
int World<Scalar>::winding_number(const Vec3<Scalar>& point, const WorldCountOptions& options) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(point)) return 0;
    return detail::winding_number(impl_->scene, point, options.mask, counters);
}

template <class Scalar>
bool World<Scalar>::contains(const Vec3<Scalar>& point, const WorldCountOptions& options) const noexcept {
    return winding_number(point, options) != 0;
}

template <class Scalar>
std::size_t World<Scalar>::containing(const Vec3<Scalar>& point, std::span<MeshId> out,
                                      const WorldCountOptions& options) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(point)) return 0;
    return detail::containing(impl_->scene, point, out, options.mask, counters);
}

template <class Scalar>
Location World<Scalar>::locate(const Vec3<Scalar>& point, std::span<WorldTouch> faces,
                               const WorldCountOptions& options) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(point)) return {};
    return detail::locate(impl_->scene, point, faces, options.mask, counters);
}

template <class Scalar>
std::size_t World<Scalar>::passages(const Segment<Scalar>& segment, std::span<WorldPassage<Scalar>> out,
                                    const WorldPassageOptions& options, std::span<FaceTouch> faces) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(segment) || !is_limit(options.max_fraction)) return 0;
    return detail::passages(impl_->scene, segment, out, faces, options, counters);
}

template <class Scalar>
std::vector<WorldFaceVerdict> World<Scalar>::explain(const Segment<Scalar>& segment,
                                                     const WorldOptions& options) const {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_->valid(segment) || !is_limit(options.max_fraction)) return {};
    return detail::explain(impl_->scene, segment, options, counters);
}

#define PIERCE_PLACES(Scalar)                                                                                        \
    template int World<Scalar>::winding_number(const Vec3<Scalar>&, const WorldCountOptions&) const noexcept;        \
    template bool World<Scalar>::contains(const Vec3<Scalar>&, const WorldCountOptions&) const noexcept;             \
    template std::size_t World<Scalar>::containing(const Vec3<Scalar>&, std::span<MeshId>, const WorldCountOptions&) \
        const noexcept;                                                                                              \
    template Location World<Scalar>::locate(const Vec3<Scalar>&, std::span<WorldTouch>, const WorldCountOptions&)    \
        const noexcept;                                                                                              \
    template std::size_t World<Scalar>::passages(const Segment<Scalar>&, std::span<WorldPassage<Scalar>>,            \
                                                 const WorldPassageOptions&, std::span<FaceTouch>) const noexcept;   \
    template std::vector<WorldFaceVerdict> World<Scalar>::explain(const Segment<Scalar>&, const WorldOptions&) const
PIERCE_PLACES(float);
PIERCE_PLACES(double);
#undef PIERCE_PLACES

}  // namespace pierce
