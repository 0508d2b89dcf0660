// The judge of moving points and triangles: rational arithmetic, from the definition, by another way than the
// library's. Weights are the quartics n . (A x B).
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <motion/moving.h>
#include <motion/rational.h>

namespace pierce::test {

using detail::ContactRule;
using detail::MovingPoint;
using detail::MovingTriangle;

struct Judgement {
    bool hit = false;
    Sides side = Sides::front;
    Feature feature = Feature::face;
    int index = 0;
    Time time;
    int roots = 0;  ///< of f in [0, 1]
    bool always_in_plane = false;
};

class Judge {
  public:
    Judge(const MovingPoint& point, const MovingTriangle& triangle) {
        // In units of which all coordinates are whole multiples: faster, and times stay the same.
        int lowest = 2000;
        const auto look = [&lowest](const detail::Point& p) {
            for (const double x : p)
                if (x != 0) lowest = std::min(lowest, std::ilogb(x) - 52);
        };
        for (int i = 0; i < 2; ++i) {
            look(point.at[i]);
            for (const detail::Point& p : triangle.at[i]) look(p);
        }
        const auto whole = [lowest](double x) {
            mpq_class q(x);
            if (lowest < 0)
                mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<unsigned long>(-lowest));
            else
                mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<unsigned long>(lowest));
            return q;
        };
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t k = 0; k < 3; ++k) {
                const mpq_class start = whole(triangle.at[0][corner][k]) - whole(point.at[0][k]);
                const mpq_class end = whole(triangle.at[1][corner][k]) - whole(point.at[1][k]);
                corner_[corner][k] = {start, end - start};
                trim(corner_[corner][k]);
            }
        const Triple n = cross(minus(corner_[1], corner_[0]), minus(corner_[2], corner_[0]));
        normal_ = n;
        f_ = -dot(corner_[0], n);  // n . (0 - A)
        for (std::size_t k = 0; k < 3; ++k) {
            area_[k] = cross(corner_[(k + 1) % 3], corner_[(k + 2) % 3]);
            weight_[k] = dot(n, area_[k]);
            along_[k] = dot(corner_[k], corner_[(k + 1) % 3]);
        }
    }

    /// The first contact that counts, by the words of detail::ContactRule.
    Judgement decide(ContactRule contact) const {
        Judgement out;
        out.always_in_plane = f_.empty();
        std::vector<Time> times = roots_of(f_);
        out.roots = static_cast<int>(times.size());
        if (f_.empty()) {
            if (contact != ContactRule::closed) return out;
            const std::optional<Time> first = first_in_plane();
            if (first) times = {*first};
        }
        for (const Time& time : times) {
            Place place = place_at(time);
            if (!place.inside) continue;
            const bool start = time.exact() && time.low == 0;
            const bool end = time.exact() && time.low == 1;
            const int before = start ? 0 : side_near(time, false);
            const int after = end ? 0 : side_near(time, true);
            if (!counts(contact, start, end, before, after, place.feature)) continue;
            out.hit = true;
            out.feature = place.feature;
            out.index = place.index;
            out.time = time;
            if (contact == ContactRule::front || contact == ContactRule::back)
                out.side = contact == ContactRule::front ? Sides::front : Sides::back;
            else
                out.side = (start ? after < 0 : before > 0) ? Sides::front : Sides::back;
            return out;
        }
        return out;
    }

  private:
    using Triple = std::array<Polynomial, 3>;
    struct Place {
        bool inside = false;
        Feature feature = Feature::face;
        int index = 0;
    };

    static Triple minus(const Triple& x, const Triple& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
    static Triple cross(const Triple& x, const Triple& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    static Polynomial dot(const Triple& x, const Triple& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

    static bool counts(ContactRule contact, bool start, bool end, int before, int after, Feature feature) {
        const bool border = feature != Feature::face;
        switch (contact) {
            case ContactRule::closed:
                return true;
            case ContactRule::front:
                if (start || end) return start && after < 0;
                return (before > 0 && after < 0) || (border && !(before < 0 && after > 0));
            case ContactRule::back:
                if (start || end) return start && after > 0;
                return (before < 0 && after > 0) || (border && !(before > 0 && after < 0));
            case ContactRule::both:
                if (start) return after < 0;
                if (end) return before < 0;
                return before * after < 0 || border;
        }
        return false;
    }

    // The side of the point just before or after a root of f.
    int side_near(const Time& time, bool after) const {
        if (f_.empty()) return 0;
        if (!time.exact()) return sign_of(f_, after ? time.high : time.low);
        int turned = 1;
        for (Polynomial p = f_;; p = slope_of(p)) {
            if (const int sign = sign_of(p, time.low); sign != 0) return sign * turned;
            if (!after) turned = -turned;
        }
    }

    Place place_at(const Time& time) const {
        bool flat = true;
        for (const Polynomial& n : normal_) flat = flat && time.sign(n) == 0;
        if (!flat) {
            int zeros = 0;
            int last_zero = 0;
            int last_other = 0;
            for (int k = 0; k < 3; ++k) {
                const int sign = time.sign(weight_[static_cast<std::size_t>(k)]);
                if (sign < 0) return {};
                (sign == 0 ? last_zero : last_other) = k;
                zeros += sign == 0 ? 1 : 0;
            }
            if (zeros == 0) return {true, Feature::face, 0};
            if (zeros == 1) return {true, Feature::edge, (last_zero + 1) % 3};
            return {true, Feature::vertex, last_other};
        }
        for (std::size_t k = 0; k < 3; ++k) {
            bool here = true;
            for (const Polynomial& x : corner_[k]) here = here && time.sign(x) == 0;
            if (here) return {true, Feature::vertex, static_cast<int>(k)};
        }
        for (std::size_t k = 0; k < 3; ++k) {
            bool on = time.sign(along_[k]) <= 0;
            for (const Polynomial& x : area_[(k + 2) % 3]) on = on && time.sign(x) == 0;
            if (on) return {true, Feature::edge, static_cast<int>(k)};
        }
        return {};
    }

    // In the plane all the time: what is inside can change only where one of these is 0.
    std::optional<Time> first_in_plane() const {
        std::optional<Time> first;
        const auto try_roots = [&](const Polynomial& p) {
            for (const Time& time : roots_of(p)) {
                if (first && first->compare(time) <= 0) return;
                if (!place_at(time).inside) continue;
                first = time;
                return;
            }
        };
        try_roots({0, 1});
        if (first) return first;
        for (std::size_t k = 0; k < 3; ++k) {
            try_roots(weight_[k]);
            try_roots(along_[k]);
            try_roots(normal_[k]);
            for (std::size_t i = 0; i < 3; ++i) {
                try_roots(area_[k][i]);
                try_roots(corner_[k][i]);
            }
        }
        return first;
    }

    Triple corner_[3], area_[3], normal_;
    Polynomial f_, weight_[3], along_[3];
};

}  // namespace pierce::test
