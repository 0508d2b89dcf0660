// The façade of a step: what is asked of it, in standard arithmetic, and what is counted.
#include <pierce/deforming_mesh.h>

#include <environment.h>
#include <query/along.h>
#include <query/batch_sizes.h>
#include <query/collision_mesh_impl.h>
#include <query/deformation_step_impl.h>
#include <query/parts.h>

#include <query/moving_sweep.h>

namespace pierce {

using namespace detail;

namespace {

/// Never destroyed: steps may be used until the very end of a program.
template <class Scalar>
const CollisionMesh<Scalar>& no_mesh() {
    static const auto* const mesh = new CollisionMesh<Scalar>();
    return *mesh;
}

}  // namespace

template <class Scalar>
DeformationStep<Scalar>::DeformationStep() noexcept = default;
template <class Scalar>
DeformationStep<Scalar>::DeformationStep(std::shared_ptr<const Impl> impl) noexcept : impl_(std::move(impl)) {}
template <class Scalar>
DeformationStep<Scalar>::~DeformationStep() = default;
template <class Scalar>
DeformationStep<Scalar>::DeformationStep(const DeformationStep&) noexcept = default;
template <class Scalar>
DeformationStep<Scalar>::DeformationStep(DeformationStep&&) noexcept = default;
template <class Scalar>
DeformationStep<Scalar>& DeformationStep<Scalar>::operator=(const DeformationStep&) noexcept = default;
template <class Scalar>
DeformationStep<Scalar>& DeformationStep<Scalar>::operator=(DeformationStep&&) noexcept = default;

template <class Scalar>
const CollisionMesh<Scalar>& DeformationStep<Scalar>::before() const noexcept {
    return impl_ ? impl_->ends[0]->mesh : no_mesh<Scalar>();
}
template <class Scalar>
const CollisionMesh<Scalar>& DeformationStep<Scalar>::after() const noexcept {
    return impl_ ? impl_->ends[1]->mesh : no_mesh<Scalar>();
}

template <class Scalar>
std::optional<SweepHit<Scalar>> DeformationStep<Scalar>::sweep(const Segment<Scalar>& way,
                                                               const QueryOptions& options) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_ || !before().impl_->valid(way) || !is_limit(options.max_fraction)) return std::nullopt;
    return detail::sweep(impl_->scene, way, options, counters);
}

template <class Scalar>
bool DeformationStep<Scalar>::any_hit(const Segment<Scalar>& way, const QueryOptions& options) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl_ || !before().impl_->valid(way) || !is_limit(options.max_fraction)) return false;
    return detail::any_sweep(impl_->scene, way, options, counters);
}

template <class Scalar>
std::size_t DeformationStep<Scalar>::sweeps(const Segments<Scalar>& ways,
                                            std::span<std::optional<SweepHit<Scalar>>> out, const QueryOptions& options,
                                            const Executor& executor) const {
    check_sizes("sweeps", ways, out.size());
    const bool nothing = !impl_ || asks_nothing(options);
    return in_parts(
        ways.size(), options.counters, executor, [&](std::size_t count) { before().impl_->count_invalid(count); },
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            std::size_t hits = 0;
            for (std::size_t i = first; i < last; ++i) {
                out[i].reset();
                const Segment<Scalar> way = ways[i];
                if (!is_valid(way)) {
                    ++invalid;
                } else if (!nothing) {
                    out[i] = detail::sweep(impl_->scene, way, options, counters);
                    if (out[i]) ++hits;
                }
            }
            return hits;
        });
}

template class DeformationStep<float>;
template class DeformationStep<double>;

}  // namespace pierce
