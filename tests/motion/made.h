// Made queries of a moving point and a moving triangle, of every kind that is hard.
#pragma once

#include <cmath>
#include <random>

#include <motion/moving.h>

namespace pierce::test {

enum class Kind { lattice, touching, near_miss, in_plane, turning, flat, anywhere, unequal, folding };
inline constexpr Kind k_kinds[] = {Kind::lattice, Kind::touching, Kind::near_miss, Kind::in_plane, Kind::turning,
                                   Kind::flat,    Kind::anywhere, Kind::unequal,   Kind::folding};

struct Query {
    detail::MovingPoint point;
    detail::MovingTriangle triangle;
};

class QueryMaker {
  public:
    explicit QueryMaker(unsigned seed) : random_(seed) {}

    int number(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
    double real(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

    Query make(Kind kind) {
        Query q;
        switch (kind) {
            case Kind::lattice:
                return on_lattice(number(1, 3));
            case Kind::touching:
                return touching();
            case Kind::near_miss: {
                q = touching();
                for (int changes = number(1, 2); changes > 0; --changes) {
                    double& x = any_coordinate(q);
                    x = std::nextafter(x, number(0, 1) == 0 ? -1e9 : 1e9);
                }
                return q;
            }
            case Kind::in_plane: {
                q = on_lattice(2);
                each(q, [](detail::Point& p) { p[2] = 0; });
                return sheared(q);
            }
            case Kind::turning:
                return turning();
            case Kind::flat: {  // no area, at one time or always
                q = on_lattice(2);
                const int i = number(0, 1);
                q.triangle.at[i][2] = q.triangle.at[i][0];
                if (number(0, 1) == 0) q.triangle.at[1 - i][2] = q.triangle.at[1 - i][number(0, 1) == 0 ? 0 : 1];
                return q;
            }
            case Kind::anywhere: {
                each(q, [this](detail::Point& p) {
                    for (double& x : p) x = number(-1000000, 1000000) * 0x1p-20;
                });
                return q;
            }
            case Kind::unequal: {  // exponents far apart
                q = number(0, 1) == 0 ? on_lattice(1) : touching();
                for (int changes = number(1, 4); changes > 0; --changes)
                    any_coordinate(q) = std::ldexp(real(-1, 1), number(-60, 60));
                return q;
            }
            case Kind::folding:
                return folding();
        }
        return q;
    }

    template <class F>
    static void each(Query& q, F&& f) {
        for (int i = 0; i < 2; ++i) {
            f(q.point.at[i]);
            for (detail::Point& p : q.triangle.at[i]) f(p);
        }
    }

  private:
    double& any_coordinate(Query& q) {
        const int i = number(0, 1);
        const int which = number(0, 3);
        detail::Point& p = which == 3 ? q.point.at[i] : q.triangle.at[i][static_cast<std::size_t>(which)];
        return p[static_cast<std::size_t>(number(0, 2))];
    }
    Query on_lattice(int size) {
        Query q;
        each(q, [&](detail::Point& p) {
            for (double& x : p) x = number(-size, size);
        });
        return q;
    }
    // The same plane for all, along no axis.
    Query sheared(Query q) {
        const int a = number(-2, 2);
        const int b = number(-2, 2);
        each(q, [&](detail::Point& p) { p[2] += a * p[0] + b * p[1]; });
        const int turns = number(0, 2);
        each(q, [&](detail::Point& p) {
            p = {p[static_cast<std::size_t>(turns)], p[static_cast<std::size_t>((turns + 1) % 3)],
                 p[static_cast<std::size_t>((turns + 2) % 3)]};
        });
        return q;
    }
    // Exactly on a place of the triangle at a time i / 8: on multiples of 2^-20 all of it is exact.
    Query touching() {
        Query q;
        each(q, [&](detail::Point& p) {
            for (double& x : p) x = number(-1024, 1024) * 0x1p-10;
        });
        const int i = number(0, 7);
        const int weights[3][3] = {{number(1, 6), 1, 0}, {number(0, 8), 0, 0}, {8, 0, 0}};
        const int row = number(0, 2);
        int w[3] = {weights[row][0], weights[row][1], 0};
        w[2] = 8 - w[0] - w[1];
        std::swap(w[number(0, 2)], w[number(0, 2)]);
        for (std::size_t k = 0; k < 3; ++k) {
            double place = 0;
            for (std::size_t corner = 0; corner < 3; ++corner)
                place += w[corner] * ((8 - i) * q.triangle.at[0][corner][k] + i * q.triangle.at[1][corner][k]);
            place /= 64;
            // 8 place = (8 - i) p0 + i p1: choose the distance gone, a multiple of 8.
            const double way = number(-256, 256) * 0x1p-5;
            q.point.at[0][k] = place - i * way / 8;
            q.point.at[1][k] = place + (8 - i) * way / 8;
        }
        return q;
    }
    // Turns over, so that there are two or three roots, double ones among them.
    Query turning() {
        Query q = on_lattice(2);
        const double size = number(1, 4);
        q.triangle.at[0] = {detail::Point{-size, -1, 0}, {size, -1, 0}, {0, size, 0}};
        q.triangle.at[1] = q.triangle.at[0];
        for (int i = 0; i < 2; ++i)
            for (detail::Point& p : q.triangle.at[i]) p[2] += number(-2, 2);
        if (number(0, 2) == 0) q.point.at[1] = q.point.at[0];
        if (number(0, 1) == 0) std::swap(q.triangle.at[1][0], q.triangle.at[1][1]);
        return q;
    }

    // The triangle turns over about an edge while the point goes through that edge, along its plane then: a double
    // root.
    Query folding() {
        Query q;
        const int i = number(1, 7);
        const int size = number(0, 1) == 0 ? 1 : -1;
        const int turn = number(0, 1) == 0 ? 1 : -1;
        const int aside = number(-1, 1);
        for (int k = 0; k < 2; ++k) {
            const int gone = i - 8 * k;
            q.triangle.at[k] = {detail::Point{0, 0, 4}, {0, 0, -4}, {8.0 * size, 1.0 * turn * gone, 0}};
            q.point.at[k] = {1.0 * gone, 0, aside * 4.0 + number(0, 1)};
        }
        if (number(0, 1) == 0)
            for (auto& corners : q.triangle.at) std::swap(corners[0], corners[1]);
        if (number(0, 3) == 0) any_coordinate(q) += number(-1, 1);
        const auto axis = static_cast<std::size_t>(number(0, 2));
        each(q, [axis](detail::Point& p) { p = {p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]}; });
        return q;
    }

    std::mt19937 random_;
};

}  // namespace pierce::test
