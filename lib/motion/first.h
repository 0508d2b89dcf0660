// The first contact of a moving point and a moving triangle that counts, in exact arithmetic.
#pragma once

#include <motion/counting.h>
#include <motion/course.h>
#include <motion/root.h>

namespace pierce::detail {

/// What of a triangle a point lies on.
struct Place {
    bool inside = false;
    Feature feature = Feature::face;
    std::uint8_t index = 0;
};

/// Where the point lies at a time when it is in the plane (f = 0). `sign(q)`: the sign of a quadratic then.
template <class Course, class Polynomial, class Sign>
[[nodiscard]] Place place_of(const Course& course, Polynomial& q, Sign&& sign) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        int zeros = 0;
        int last_zero = 0;
        int last_other = 0;
        bool plus = false;
        bool minus = false;
        for (int k = 0; k < 3; ++k) {
            course.set_area(k, axis, q);
            const int s = sign(q);
            plus = plus || s > 0;
            minus = minus || s < 0;
            if (s == 0) {
                ++zeros;
                last_zero = k;
            } else {
                last_other = k;
            }
            // Outside, whether the triangle has area or not: a line without the point gives opposite signs, too.
            if (plus && minus) return {};
        }
        if (zeros == 3) continue;
        if (zeros == 0) return {true, Feature::face, 0};
        if (zeros == 1) return {true, Feature::edge, static_cast<std::uint8_t>((last_zero + 1) % 3)};
        return {true, Feature::vertex, static_cast<std::uint8_t>(last_other)};
    }
    // All corners are on one line with the point: no area.
    for (int k = 0; k < 3; ++k) {
        course.set_dot(k, k, q);
        if (sign(q) == 0) return {true, Feature::vertex, static_cast<std::uint8_t>(k)};
    }
    for (int k = 0; k < 3; ++k) {
        course.set_dot(k, (k + 1) % 3, q);
        if (sign(q) < 0) return {true, Feature::edge, static_cast<std::uint8_t>(k)};
    }
    return {};
}

template <int S, int C>
class FirstContact {
  public:
    FirstContact(const MovingPoint& point, const MovingTriangle& triangle, const Lattice& lattice, ContactRule contact)
        : course_(point, triangle, lattice), counting_{contact} {
        course_.set_volume(f_);
        if (f_.zero()) {
            if (contact == ContactRule::closed) find_in_plane();
            return;
        }
        find();
    }
    FirstContact(const FirstContact&) = delete;
    FirstContact& operator=(const FirstContact&) = delete;
    ~FirstContact() = default;

    [[nodiscard]] const Impact& impact() const { return impact_; }
    [[nodiscard]] Enclosure enclosure() {
        if (when_ == When::between) return enclose(root_);
        return when_ == When::start ? Enclosure{0, 0} : Enclosure{1, 1};
    }

    /// Of two hits.
    friend int compare_times(FirstContact& x, FirstContact& y) {
        if (x.when_ != y.when_) return x.when_ < y.when_ ? -1 : 1;
        return x.when_ == When::between ? compare(x.root_, y.root_) : 0;
    }
    [[nodiscard]] int compare_with(double time) const {
        if (time < 0) return 1;
        if (time > 1) return -1;
        if (when_ == When::start) return time > 0 ? -1 : 0;
        if (when_ == When::end) return time < 1 ? 1 : 0;
        Lattice lattice;
        lattice.add(time);
        lattice.add(1.0);
        return compare_fraction(root_, whole<C>(time, lattice), whole<C>(1.0, lattice));
    }

  private:
    enum class When : std::uint8_t { start, between, end };

    void hit(When when, Sides side, const Place& place) {
        when_ = when;
        impact_ = {.hit = true,
                   .side = side,
                   .feature = place.feature,
                   .feature_index = place.index,
                   .at_start = when == When::start};
    }

    [[nodiscard]] Place place_at(bool end) {
        return place_of(course_, quadratic_, [end](const Bernstein<C>& q) { return q.b[end ? q.degree : 0].sign(); });
    }
    [[nodiscard]] Place place_at(Root<C>& root) {
        return place_of(course_, quadratic_, [&root](const Bernstein<C>& q) { return sign_at(root, q); });
    }

    bool try_start(int after) {
        if (!counting_.at_start(after)) return false;
        const Place place = place_at(false);
        if (!place.inside) return false;
        hit(When::start, counting_.side(-after), place);
        return true;
    }

    void find() {
        if (f_.b[0].zero() && try_start(f_.sign_after_start())) return;
        const bool between = each_root(f_, root_, [this](int before, int after) {
            if (!counting_.on_border(before, after)) return false;
            const Place place = place_at(root_);
            if (!place.inside) return false;
            if (place.feature == Feature::face && !counting_.on_face(before, after)) return false;
            hit(When::between, counting_.side(before), place);
            return true;
        });
        if (between || !f_.b[3].zero()) return;
        const int before = f_.sign_before_end();
        if (!counting_.at_end(before)) return;
        if (const Place place = place_at(true); place.inside) hit(When::end, counting_.side(before), place);
    }

    // In the plane all the time: they touch at the start, or first on an edge, whose ends are on a line with the point
    // then, on either side of it.
    void find_in_plane() {
        if (try_start(-1)) return;
        for (int edge = 0; edge < 3; ++edge) {
            const int next = (edge + 1) % 3;
            std::size_t axis = 0;
            while (axis < 3) {
                course_.set_area((edge + 2) % 3, axis, quadratic_);
                if (!quadratic_.zero()) break;
                ++axis;
            }
            if (axis == 3) course_.set_dot(edge, next, quadratic_);  // on that line all the time: until it is not > 0
            const Bernstein<C> line = quadratic_;
            if (axis == 3 && line.zero()) continue;  // a corner is the point all the time, so they touched at the start
            const auto on_edge = [&](auto&& sign) {
                for (std::size_t other = axis + 1; other < 3; ++other) {
                    course_.set_area((edge + 2) % 3, other, quadratic_);
                    if (sign(quadratic_) != 0) return false;
                }
                if (axis == 3) return true;
                course_.set_dot(edge, next, quadratic_);
                return sign(quadratic_) <= 0;
            };
            keep_earliest(line, on_edge);
        }
    }

    template <class OnEdge>
    void keep_earliest(const Bernstein<C>& line, OnEdge&& on_edge) {
        Root<C> root;
        if (each_root(line, root,
                      [&](int, int) { return on_edge([&root](const Bernstein<C>& q) { return sign_at(root, q); }); })) {
            if (impact_.hit && when_ == When::between && compare(root_, root) <= 0) return;
            const Place place = place_at(root);
            line_ = line;
            root_ = root;
            root_.of = &line_;
            hit(When::between, Sides::front, place);
            return;
        }
        if (impact_.hit || !line.b[2].zero() || !on_edge([](const Bernstein<C>& q) { return q.b[q.degree].sign(); }))
            return;
        hit(When::end, Sides::front, place_at(true));
    }

    Course<S, C> course_;
    Counting counting_;
    Bernstein<C> f_;
    Bernstein<C> line_;  ///< what root_ is of where f is 0
    Bernstein<C> quadratic_;
    Root<C> root_;
    When when_ = When::start;
    Impact impact_;
};

}  // namespace pierce::detail
