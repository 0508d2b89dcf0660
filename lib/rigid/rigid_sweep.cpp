// The chords of a curve in their order, those left out that can't come near the mesh; and what is said of the first
// hit.
//
// A part of the curve, from one chord's end to another's, stays within `bend` 4^-level of its own chord (turn.h), and
// each of the points between which the chords lie within `rounding` of the curve: so all chords of the part are in the
// box of its ends, widened by the sum of the first and two of the second. Four are added, which allows for the rounding
// of the sums here. Parts whose box is apart from the mesh's have no hit, and are not cut further; so it makes no
// difference to the answer.
#include <rigid/rigid_sweep.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <query/end_place.h>
#include <query/engine.h>
#include <query/grain.h>

namespace pierce::detail {

namespace {

template <class Scalar>
Coordinates<Scalar> to_coordinates(const Point& x) {
    return {static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2])};
}

/// The largest number that is less; `x` is more than 0.
template <class Scalar>
Scalar before(Scalar x) {
    using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Scalar>(std::bit_cast<Bits>(x) - Bits{1});
}

template <class Scalar>
class ChordSweep {
  public:
    ChordSweep(const Scene<Scalar>& scene, const Turn& turn, const Curve& curve, const QueryOptions& options,
               QueryCounters& counters)
        : scene_(scene), turn_(turn), curve_(curve), options_(options), here_(options), counters_(counters) {
        if (options.accept)
            here_.accept = [this](const Contact& contact) {
                Contact in_time = contact;
                in_time.fraction = whole_ * (index_ + contact.fraction);
                return options_.accept(in_time);
            };
        here_.counters = nullptr;
        whole_ = std::ldexp(1.0, -curve.level);
    }
    // here_ refers to it.
    ChordSweep(const ChordSweep&) = delete;
    ChordSweep& operator=(const ChordSweep&) = delete;

    /// Whether there is a hit: `hit()`, on the way from `from()`, which is clear.
    bool run() { return !scene_.empty() && walk(0, 0, curve_.end[0], curve_.end[1], {}); }

    [[nodiscard]] const Hit<Scalar>& hit() const { return *hit_; }
    [[nodiscard]] const Point& from() const { return from_; }

    [[nodiscard]] Scalar time() const {
        if (hit_->at_start && index_ == 0) return 0;
        const double part = hit_->exact_fraction > 0 ? static_cast<double>(before(hit_->exact_fraction)) : 0;
        double sum = index_ + part;
        if (sum - index_ > part) sum = before(sum);  // the difference is exact
        return rounded_down<Scalar>(std::min(sum * whole_, 1.0));
    }
    [[nodiscard]] double middle_time() const { return (index_ + static_cast<double>(hit_->exact_fraction)) * whole_; }
    [[nodiscard]] bool at_start() const { return hit_->at_start && index_ == 0; }

    /// The first hit on the way from `from()` to another point, whole.
    [[nodiscard]] std::optional<Hit<Scalar>> stop_on_way_to(const Point& to) {
        here_.max_fraction = std::numeric_limits<double>::infinity();
        return first_hit(scene_, Segment<Scalar>{to_vector<Scalar>(from_), to_vector<Scalar>(to)}, here_, counters_);
    }
    [[nodiscard]] bool is_stopped_on_way_to(const Point& to) {
        here_.max_fraction = std::numeric_limits<double>::infinity();
        return any_hit(scene_, Segment<Scalar>{to_vector<Scalar>(from_), to_vector<Scalar>(to)}, here_, counters_);
    }

  private:
    /// Part `index` of 2^level of the curve; `q`: the turn at its start.
    bool walk(int level, double index, const Point& left, const Point& right, const Quaternion& q) {
        if (is_apart(level, left, right)) return false;
        if (level == curve_.level) return test(index, left, right);
        const double middle = 2 * index + 1;
        const Quaternion turned_on = product(q, turn_.part[static_cast<std::size_t>(level) + 1]);
        const Point at = curve_.at<Scalar>(turn_, std::ldexp(middle, -level - 1), turned_on);
        return walk(level + 1, 2 * index, left, at, q) || walk(level + 1, middle, at, right, turned_on);
    }

    [[nodiscard]] bool is_apart(int level, const Point& left, const Point& right) const {
        const double off = level == curve_.level ? 0 : std::ldexp(curve_.bend, -2 * level) + 4 * curve_.rounding;
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::max(left[k], right[k]) + off < scene_.bounds.low[k]) return true;
            if (std::min(left[k], right[k]) - off > scene_.bounds.high[k]) return true;
        }
        return false;
    }

    bool test(double index, const Point& left, const Point& right) {
        // Both exact: a power of two, and a difference that takes no more bits than the larger one.
        const double most = std::ldexp(options_.max_fraction, curve_.level) - index;
        if (most < 0) return false;
        here_.max_fraction = most;
        index_ = index;
        hit_ = first_hit(scene_, Segment<Scalar>{to_vector<Scalar>(left), to_vector<Scalar>(right)}, here_, counters_);
        from_ = left;
        return hit_.has_value();
    }

    const Scene<Scalar>& scene_;
    const Turn& turn_;
    const Curve& curve_;
    const QueryOptions& options_;
    QueryOptions here_;
    QueryCounters& counters_;
    double whole_ = 1;  ///< the time that a chord takes
    double index_ = 0;
    Point from_{};
    std::optional<Hit<Scalar>> hit_;
};

/// The plane of a hit, seen from where it came.
template <class Scalar>
Guard guard_of(const Hit<Scalar>& hit) {
    const double side = hit.side == Sides::back ? -1 : 1;
    const Point n = to_point(hit.normal.vec());
    return {to_point(hit.position.vec()), {side * n[0], side * n[1], side * n[2]}, hit.triangle};
}

/// A place in the world whose image can be reached, and that image.
template <class Scalar>
bool find_rigid_place(const Scene<Scalar>& scene, const Turn& turn, ChordSweep<Scalar>& sweep, QueryCounters& counters,
                      RigidHit<Scalar>& out) {
    const Hit<Scalar>& hit = sweep.hit();
    const auto ask = [&](const Point& to, Guard* stop) {
        const Point place = rounded_to<Scalar>(out_of(turn.after, to));
        if (!are_finite(place)) return false;
        const Point local = image_of<Scalar>(turn.after, place);
        if (!are_finite(local)) return false;
        if (stop == nullptr) {
            if (sweep.is_stopped_on_way_to(local)) return false;
        } else if (const auto in_the_way = sweep.stop_on_way_to(local)) {
            *stop = guard_of(*in_the_way);
            return false;
        }
        out.place = to_coordinates<Scalar>(place);
        out.local = to_coordinates<Scalar>(local);
        return true;
    };
    const Point verified = to_point(hit.point.vec());
    Guard unused;
    if (ask(verified, &unused)) return true;
    ++counters.retreats;
    // What the world's numbers do to a point there, on top of the mesh's own.
    double largest = 0;
    for (const double x : out_of(turn.after, verified)) largest = std::max(largest, std::abs(x));
    const double grain = std::max(scene.grain, grain_of<Scalar>(largest));
    return find_end_place(to_point(hit.position.vec()), sweep.from(), guard_of(hit), grain, counters, ask);
}

}  // namespace

template <class Scalar>
std::optional<RigidHit<Scalar>> sweep_chords(const Scene<Scalar>& scene, const Turn& turn, const Point& start,
                                             const Point& end, const QueryOptions& options, QueryCounters& counters) {
    const Curve curve = Curve::between<Scalar>(turn, start, end);
    if (!std::isfinite(curve.rounding)) return std::nullopt;
    ChordSweep<Scalar> sweep(scene, turn, curve, options, counters);
    if (!sweep.run()) return std::nullopt;
    const Hit<Scalar> hit = sweep.hit();
    RigidHit<Scalar> out{};
    out.time = sweep.time();
    out.at_start = sweep.at_start();
    out.local_position = hit.position;
    out.local_normal = hit.normal;
    out.barycentric = hit.barycentric;
    out.face = hit.face;
    out.triangle = hit.triangle;
    out.side = hit.side;
    out.feature = hit.feature;
    out.feature_index = hit.feature_index;
    const Point position = to_point(hit.position.vec());
    out.position = to_coordinates<Scalar>(out_at(turn, position, sweep.middle_time()));
    out.normal = to_coordinates<Scalar>(turned_at(turn, to_point(hit.normal.vec()), sweep.middle_time()));
    const Point first = out_of(turn.before, position);
    const Point last = out_of(turn.after, position);
    out.surface_motion = to_coordinates<Scalar>(Point{last[0] - first[0], last[1] - first[1], last[2] - first[2]});
    out.place_verified = find_rigid_place(scene, turn, sweep, counters, out);
    if (!out.place_verified) {
        out.local = hit.point;
        out.place = to_coordinates<Scalar>(out_of(turn.after, to_point(hit.point.vec())));
    }
    return out;
}

template std::optional<RigidHit<float>> sweep_chords(const Scene<float>&, const Turn&, const Point&, const Point&,
                                                     const QueryOptions&, QueryCounters&);
template std::optional<RigidHit<double>> sweep_chords(const Scene<double>&, const Turn&, const Point&, const Point&,
                                                      const QueryOptions&, QueryCounters&);

}  // namespace pierce::detail
