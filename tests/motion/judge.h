// The judge of moving points and triangles: rational arithmetic, from the definition, by another way than the library's. Weights are
// the quartics n . (A x B), roots are isolated by Sturm's chains, signs at them found by common divisors.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <motion/moving.h>

namespace pierce::test {

using detail::Contact;
using detail::MovingPoint;
using detail::MovingTriangle;

/// sum of c[i] t^i, with no zeros at the end; empty for 0.
using Polynomial = std::vector<mpq_class>;

inline void trim(Polynomial& p) {
    while (!p.empty() && p.back() == 0) p.pop_back();
}
inline Polynomial operator+(const Polynomial& x, const Polynomial& y) {
    Polynomial sum(std::max(x.size(), y.size()));
    for (std::size_t i = 0; i < x.size(); ++i) sum[i] += x[i];
    for (std::size_t i = 0; i < y.size(); ++i) sum[i] += y[i];
    trim(sum);
    return sum;
}
inline Polynomial operator-(const Polynomial& x) {
    Polynomial out = x;
    for (auto& c : out) c = -c;
    return out;
}
inline Polynomial operator-(const Polynomial& x, const Polynomial& y) { return x + -y; }
inline Polynomial operator*(const Polynomial& x, const Polynomial& y) {
    if (x.empty() || y.empty()) return {};
    Polynomial product(x.size() + y.size() - 1);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < y.size(); ++j) product[i + j] += x[i] * y[j];
    trim(product);
    return product;
}
inline mpq_class value_of(const Polynomial& p, const mpq_class& t) {
    mpq_class value = 0;
    for (std::size_t i = p.size(); i-- > 0;) value = value * t + p[i];
    return value;
}
inline int sign_of(const Polynomial& p, const mpq_class& t) { return sgn(value_of(p, t)); }
inline Polynomial slope_of(const Polynomial& p) {
    Polynomial slope;
    for (std::size_t i = 1; i < p.size(); ++i) slope.push_back(p[i] * mpq_class(static_cast<unsigned long>(i)));
    return slope;
}
/// Quotient and remainder; y is not 0.
inline std::pair<Polynomial, Polynomial> divide(Polynomial x, const Polynomial& y) {
    Polynomial quotient(x.size() >= y.size() ? x.size() - y.size() + 1 : 0);
    while (x.size() >= y.size()) {
        const std::size_t at = x.size() - y.size();
        quotient[at] = x.back() / y.back();
        for (std::size_t i = 0; i < y.size(); ++i) x[at + i] -= quotient[at] * y[i];
        trim(x);
    }
    return {quotient, x};
}
/// A positive multiple with short whole coefficients.
inline Polynomial primitive(Polynomial p) {
    mpz_class factor = 1;
    for (const auto& c : p) factor = lcm(factor, c.get_den());
    mpz_class content = 0;
    for (auto& c : p) {
        c *= factor;
        content = gcd(content, c.get_num());
    }
    if (content != 0)
        for (auto& c : p) c /= content;
    return p;
}
inline Polynomial common_divisor(Polynomial x, Polynomial y) {
    while (!y.empty()) {
        Polynomial rest = primitive(divide(x, y).second);
        x = std::move(y);
        y = std::move(rest);
    }
    return x;
}
/// Each root once.
inline Polynomial without_repetition(const Polynomial& p) {
    return primitive(p.size() < 3 ? p : divide(p, common_divisor(p, slope_of(p))).first);
}

/// Sturm's chain of a polynomial without repeated roots: how many of its roots are in (a, b].
class Sturm {
  public:
    explicit Sturm(const Polynomial& p) {
        chain_ = {p, slope_of(p)};
        while (!chain_.back().empty())
            chain_.push_back(primitive(-divide(chain_[chain_.size() - 2], chain_.back()).second));
        chain_.pop_back();
    }
    int roots(const mpq_class& a, const mpq_class& b) const { return changes(a) - changes(b); }

  private:
    int changes(const mpq_class& t) const {
        int count = 0;
        int last = 0;
        for (const Polynomial& p : chain_) {
            const int sign = sign_of(p, t);
            if (sign == 0) continue;
            if (last != 0 && sign != last) ++count;
            last = sign;
        }
        return count;
    }
    std::vector<Polynomial> chain_;
};

/// The only root of `of` in (low, high), neither of which is a root; or low, if both are equal.
struct Time {
    Polynomial of;  ///< without repetition
    mpq_class low, high;

    bool exact() const { return low == high; }
    void refine() {
        if (exact()) return;
        const mpq_class middle = (low + high) / 2;
        const int sign = sign_of(of, middle);
        if (sign == 0)
            low = high = middle;
        else if (sign == sign_of(of, high))
            high = middle;
        else
            low = middle;
    }
    int sign(const Polynomial& p) const {
        if (p.empty()) return 0;
        if (exact()) return sign_of(p, low);
        // Where p is further from 0 than its slope lets it come, no more is needed.
        Time time = *this;
        mpq_class steepest = 0;
        for (std::size_t i = 1; i < p.size(); ++i) steepest += abs(p[i]) * mpq_class(static_cast<unsigned long>(i));
        for (int i = 0; i < 30 && !time.exact(); ++i) {
            if (abs(value_of(p, time.high)) > (time.high - time.low) * steepest) return sign_of(p, time.high);
            time.refine();
        }
        if (time.exact()) return sign_of(p, time.low);
        const Polynomial both = common_divisor(of, p);
        if (both.size() > 1 && Sturm(both).roots(time.low, time.high) > 0) return 0;
        const Sturm sturm(without_repetition(p));
        while (!time.exact() && sturm.roots(time.low, time.high) > 0) time.refine();
        return sign_of(p, time.high);
    }
    /// The order of this time and a number.
    int compare(const mpq_class& t) const {
        if (exact()) return low < t ? -1 : low > t ? 1 : 0;
        if (t <= low) return 1;
        if (t >= high) return -1;
        const int sign = sign_of(of, t);
        return sign == 0 ? 0 : sign == sign_of(of, low) ? 1 : -1;
    }
    int compare(Time other) const {
        Time time = *this;
        const mpq_class low_end = std::max(low, other.low);
        const mpq_class high_end = std::min(high, other.high);
        const Polynomial both = common_divisor(of, other.of);
        if (low_end < high_end && both.size() > 1 && Sturm(both).roots(low_end, high_end) > 0) return 0;
        for (;;) {
            if (time.exact()) return -other.compare(time.low);
            if (other.exact()) return time.compare(other.low);
            if (time.high <= other.low) return -1;
            if (other.high <= time.low) return 1;
            time.refine();
            other.refine();
        }
    }
};

/// The roots in [0, 1], in their order.
inline std::vector<Time> roots_of(const Polynomial& p) {
    std::vector<Time> roots;
    if (p.size() < 2) return roots;
    const Polynomial once = without_repetition(p);
    const Sturm sturm(once);
    if (sign_of(once, 0) == 0) roots.push_back({once, 0, 0});
    // Those in (a, b].
    const auto isolate = [&](auto& self, const mpq_class& a, const mpq_class& b) -> void {
        const int count = sturm.roots(a, b);
        if (count == 0) return;
        if (count == 1 && sign_of(once, b) == 0) {
            roots.push_back({once, b, b});
            return;
        }
        if (count == 1 && sign_of(once, a) != 0) {
            roots.push_back({once, a, b});
            return;
        }
        const mpq_class middle = (a + b) / 2;
        self(self, a, middle);
        self(self, middle, b);
    };
    isolate(isolate, 0, 1);
    return roots;
}

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

    /// The first contact that counts, by the words of detail::Contact.
    Judgement decide(Contact contact) const {
        Judgement out;
        out.always_in_plane = f_.empty();
        std::vector<Time> times = roots_of(f_);
        out.roots = static_cast<int>(times.size());
        if (f_.empty()) {
            if (contact != Contact::closed) return out;
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
            if (contact == Contact::front || contact == Contact::back)
                out.side = contact == Contact::front ? Sides::front : Sides::back;
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

    static bool counts(Contact contact, bool start, bool end, int before, int after, Feature feature) {
        const bool border = feature != Feature::face;
        switch (contact) {
            case Contact::closed:
                return true;
            case Contact::front:
                if (start || end) return start && after < 0;
                return (before > 0 && after < 0) || (border && !(before < 0 && after > 0));
            case Contact::back:
                if (start || end) return start && after > 0;
                return (before < 0 && after > 0) || (border && !(before > 0 && after < 0));
            case Contact::both:
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
