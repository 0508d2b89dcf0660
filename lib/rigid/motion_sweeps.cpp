// The façade of sweeps against a mesh that moves or turns.
#include <pierce/collision_mesh.h>

#include <environment.h>
#include <query/along.h>
#include <query/batch_sizes.h>
#include <query/inside.h>
#include <query/parts.h>
#include <rigid/glide.h>
#include <rigid/rigid_sweep.h>

namespace pierce {

using namespace detail;

namespace {

/// Images of a way's ends. False: one is not finite.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool set_images(const Turn& turn, const Segment<Scalar>& way, Point& start,
                                                Point& end) {
    start = image_of<Scalar>(turn.before, to_point(way.from));
    end = image_of<Scalar>(turn.after, to_point(way.to));
    return are_finite(start, end);
}
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool set_images(const Turn& turn, const Ride<Scalar>& way, Point& start, Point& end) {
    start = to_point(way.from);
    end = image_of<Scalar>(turn.after, to_point(way.to));
    return are_finite(start, end);
}

template <class Scalar, class Impl, class Way>
std::optional<RigidHit<Scalar>> sweep_turn(const Impl& impl, const Way& way, const Turn* turn,
                                           const QueryOptions& options) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    Point start{};
    Point end{};
    if (turn == nullptr || !is_limit(options.max_fraction)) return std::nullopt;
    if (!set_images(*turn, way, start, end)) {
        impl.count_invalid(1);
        return std::nullopt;
    }
    return sweep_chords(impl.scene, *turn, start, end, options, counters);
}

template <class Scalar>
const auto& impl_of(const MotionSweeps<Scalar>& sweeps) {
    return Inside::of(static_cast<const CollisionMesh<Scalar>&>(sweeps));
}

/// `ask(way, counters, valid)` for each.
template <class Impl, class Scalar, class Hit, class Ask>
std::size_t sweep_each(const Impl& impl, const Segments<Scalar>& ways, std::span<std::optional<Hit>> out,
                       const QueryOptions& options, const Executor& executor, Ask&& ask) {
    check_sizes("sweeps", ways, out.size());
    const bool nothing = asks_nothing(options);
    return in_parts(
        ways.size(), options.counters, executor, [&](std::size_t count) { impl.count_invalid(count); },
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            std::size_t hits = 0;
            for (std::size_t i = first; i < last; ++i) {
                out[i].reset();
                if (nothing) continue;
                bool valid = false;
                out[i] = ask(ways[i], counters, valid);
                hits += std::size_t{out[i].has_value()};
                invalid += std::size_t{!valid};
            }
            return hits;
        });
}

}  // namespace

template <class Scalar>
std::optional<SweepHit<Scalar>> MotionSweeps<Scalar>::sweep_straight(const Segment<Scalar>& way,
                                                                     const Translation<Scalar>& motion,
                                                                     const QueryOptions& options) const noexcept {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!is_limit(options.max_fraction)) return std::nullopt;
    bool valid = false;
    const auto& impl = impl_of(*this);
    std::optional<SweepHit<Scalar>> hit = sweep_glide(impl.scene, way, motion, options, counters, valid);
    if (!valid) impl.count_invalid(1);
    return hit;
}

template <class Scalar>
std::size_t MotionSweeps<Scalar>::sweeps_straight(const Segments<Scalar>& ways, const Translation<Scalar>& motion,
                                                  std::span<std::optional<SweepHit<Scalar>>> out,
                                                  const QueryOptions& options, const Executor& executor) const {
    const auto& impl = impl_of(*this);
    return sweep_each(impl, ways, out, options, executor,
                      [&](const Segment<Scalar>& way, QueryCounters& counters, bool& valid) {
                          return sweep_glide(impl.scene, way, motion, options, counters, valid);
                      });
}

template <class Scalar>
std::optional<RigidHit<Scalar>> MotionSweeps<Scalar>::sweep_turning(const Segment<Scalar>& way,
                                                                    const RigidMotion& motion,
                                                                    const QueryOptions& options) const noexcept {
    return sweep_turn<Scalar>(impl_of(*this), way, motion.turn_.get(), options);
}
template <class Scalar>
std::optional<RigidHit<Scalar>> MotionSweeps<Scalar>::sweep_turning(const Ride<Scalar>& way, const RigidMotion& motion,
                                                                    const QueryOptions& options) const noexcept {
    return sweep_turn<Scalar>(impl_of(*this), way, motion.turn_.get(), options);
}

template <class Scalar>
std::size_t MotionSweeps<Scalar>::sweeps_turning(const Segments<Scalar>& ways, const RigidMotion& motion,
                                                 std::span<std::optional<RigidHit<Scalar>>> out,
                                                 const QueryOptions& options, const Executor& executor) const {
    const auto& impl = impl_of(*this);
    const Turn* const turn = motion.turn_.get();
    return sweep_each(
        impl, ways, out, options, executor,
        [&](const Segment<Scalar>& way, QueryCounters& counters, bool& valid) -> std::optional<RigidHit<Scalar>> {
            Point start{};
            Point end{};
            valid = turn == nullptr || set_images(*turn, way, start, end);
            if (turn == nullptr || !valid) return std::nullopt;
            return sweep_chords(impl.scene, *turn, start, end, options, counters);
        });
}

template class MotionSweeps<float>;
template class MotionSweeps<double>;

}  // namespace pierce
