// What the façades of meshes and worlds ask about spheres: in standard arithmetic, of what has a meaning, and counted.
#pragma once

#include <environment.h>
#include <query/along.h>
#include <query/batch_sizes.h>
#include <query/parts.h>
#include <query/spheres.h>
#include <query/ways.h>

namespace pierce::detail {

// `impl`, `Options` and `Answer` are as in along.h.

/// A query with a radius: what has no meaning is counted.
template <class Impl, class Asked, class Scalar>
bool is_valid_sphere(const Impl& impl, const Asked& asked, const Scalar& radius) {
    if (is_valid(asked) && is_radius(radius)) return true;
    impl.count_invalid(1);
    return false;
}

/// `ask(counters)` of what has a meaning.
template <class Answer, class Impl, class Asked, class Scalar, class Options, class Ask>
Answer ask_sphere(const Impl& impl, const Asked& asked, const Scalar& radius, const Options& options, Ask&& ask) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!is_valid_sphere(impl, asked, radius) || !is_limit(options.max_fraction)) return {};
    return ask(counters);
}

/// `radius_of(i)`: of query i.
template <class Impl, class Scalar, class Answer, class Options, class RadiusOf>
std::size_t sweep_all(const Impl& impl, const Segments<Scalar>& steps, std::span<std::optional<Answer>> out,
                      const Options& options, const Executor& executor, RadiusOf&& radius_of) {
    const auto count_invalid = [&](std::size_t count) { impl.count_invalid(count); };
    return in_parts(steps.size(), options.counters, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        std::size_t hits = 0;
                        for (std::size_t i = first; i < last; ++i) {
                            out[i].reset();
                            const Segment<Scalar> step = steps[i];
                            const Scalar radius = radius_of(i);
                            if (!is_valid(step) || !is_radius(radius)) {
                                ++invalid;
                                continue;
                            }
                            if (is_limit(options.max_fraction))
                                out[i] = sweep_sphere(impl.scene, step, radius, options, counters);
                            hits += std::size_t{out[i].has_value()};
                        }
                        return hits;
                    });
}

template <class Impl, class Scalar, class Answer, class Options>
std::size_t sweep_spheres_of(const Impl& impl, const Segments<Scalar>& steps, Scalar radius,
                             std::span<std::optional<Answer>> out, const Options& options, const Executor& executor) {
    check_sizes("sweep_spheres", steps, out.size());
    return sweep_all(impl, steps, out, options, executor, [radius](std::size_t) { return radius; });
}

template <class Impl, class Scalar, class Answer, class Options>
std::size_t sweep_spheres_of(const Impl& impl, const Segments<Scalar>& steps, std::span<const Scalar> radii,
                             std::span<std::optional<Answer>> out, const Options& options, const Executor& executor) {
    check_sizes("sweep_spheres", steps, out.size());
    check_sizes("sweep_spheres", steps.size(), "segments", radii.size(), "radii");
    return sweep_all(impl, steps, out, options, executor, [radii](std::size_t i) { return radii[i]; });
}

}  // namespace pierce::detail
