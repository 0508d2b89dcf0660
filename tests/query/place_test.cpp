// The place of a hit: stopped points can leave, are near the true one; positions are correctly rounded.
//
// With points on the plane or nearer than a grain, half of the landings on a floor at z = 100 were stuck where both
// sides count, and steps in a floor's plane stopped at their start. The judges are rational numbers and the mesh itself
// (is there a clear place nearer?).
#include <gtest/gtest.h>
#include <pierce/pierce.h>
#include <query/place.h>
#include <support/floors.h>
#include <support/meshes.h>
#include <support/oracles.h>
#include <support/segments.h>
#include <Eigen/Geometry>

namespace pierce::test {
namespace {

using Q = RationalOracle::Q;
using V = Vec3<double>;

template <class Scalar>
void expect_landings_leave(int landings, bool walls) {
    Random random(51);
    int landed = 0;
    int stuck = 0;
    while (landed < landings) {
        const bool tilted = random.chance(0.5);
        const V up = tilted ? random.direction() : V(0, 0, random.chance(0.5) ? 1 : -1);
        const V middle = V(0, 0, std::array{0.0, 1.0, 8.0, 100.0}[random.below(4)]) +
                         (random.chance(0.5) ? 30 : 0) * random.in_cube();
        const CollisionMesh<Scalar> mesh(floor_at<Scalar>(middle, up, 5, walls).view());
        const QueryOptions options{.sides = walls ? Sides::front : Sides::both};
        const double from_behind = random.chance(0.5) ? -1 : 1;
        for (int i = 0; i < 200; ++i) {
            const V at = middle + 2 * random.in_cube();
            const auto point = [&](const V& p) -> Vec3<Scalar> { return p.cast<Scalar>(); };
            const V off = from_behind * std::exp(random.between(-10, 1)) * up;
            const Segment<Scalar> down{point(at + 8 * off), point(at - 8 * off + random.in_cube())};
            const auto hit = mesh.first_hit(down, options);
            if (!hit) continue;
            ++landed;
            const V normal = hit->normal.template cast<double>() * (hit->side == Sides::front ? 1 : -1);
            V aside = random.direction();
            if (aside.dot(normal) < 0) aside = -aside;
            const V here = hit->point.template cast<double>();
            const bool back = mesh.any_hit({hit->point, down.from}, options);
            const bool out = mesh.any_hit({hit->point, point(here + 3 * normal)}, options);
            const bool along = mesh.any_hit({hit->point, point(here + aside + 0.01 * normal)}, options);
            stuck += back || out || along ? 1 : 0;
        }
    }
    EXPECT_EQ(stuck, 0) << "of " << landed;
}

TEST(Place, stopped_points_can_leave) {
    expect_landings_leave<float>(30'000, false);
    expect_landings_leave<float>(30'000, true);
    expect_landings_leave<double>(30'000, false);
    expect_landings_leave<double>(30'000, true);
}
TEST(PlaceSoak, stopped_points_can_leave) {
    expect_landings_leave<float>(1'000'000, false);
    expect_landings_leave<float>(1'000'000, true);
    expect_landings_leave<double>(1'000'000, false);
    expect_landings_leave<double>(1'000'000, true);
}

// A floor whose corners are exactly in one plane, and steep walls on it; steps go exactly in the floor's plane, or all
// but.
struct Grazing {
    TriangleSoup<float> soup;
    static V at(double i, double j) { return {3 * i, 5 * j, 2 * i - 7 * j}; }
    Grazing() {
        const V n(-10, 21, 15);
        add_triangle(soup, at(0, 0), at(400, 0), at(400, 400));
        add_triangle(soup, at(0, 0), at(400, 400), at(0, 400));
        for (const double i : {300.0, 100.0}) {
            add_triangle(soup, at(i, -50), V(at(i, 200) + 40 * n), at(i, 450));
            add_triangle(soup, at(i, -50), at(i, 450), V(at(i, 200) - 40 * n));
        }
    }
    static Segment<float> step(Random& random) {
        const auto some = [&] { return static_cast<double>(random.between_ints(5, 395)); };
        V from = at(some(), some());
        V to = at(some(), some());
        if (random.chance(0.5)) from += 0.001 * random.unit() * V(-10, 21, 15);
        if (random.chance(0.7)) to -= std::exp(random.between(-12, 2)) * V(-10, 21, 15);
        return {from.cast<float>(), to.cast<float>()};
    }
};

struct Distances {
    int hits = 0;
    int beyond = 0;
    int at_start = 0;
};

// Is a place clear within a grain and eight units of the true point? Looked for at random.
template <class Scalar>
bool has_clear_place(const CollisionMesh<Scalar>& mesh, const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                     const QueryOptions& options, double most, double unit, Random& random) {
    for (int i = 0; i < 3000; ++i) {
        const V off = most * random.unit() * random.direction();
        const Vec3<Scalar> place = (hit.position.template cast<double>() + off).template cast<Scalar>();
        if ((place - hit.position).template cast<double>().norm() > most - unit) continue;
        const V n = hit.normal.template cast<double>() * (hit.side == Sides::front ? 1 : -1);
        if (n.dot((place - hit.position).template cast<double>()) < detail::k_grain_units * unit + unit) continue;
        if (place != segment.from && !mesh.any_hit({segment.from, place}, options)) return true;
    }
    return false;
}

template <class Scalar, class Step>
Distances distances(const TriangleSoup<Scalar>& soup, int count, Sides sides, Step&& step) {
    const CollisionMesh<Scalar> mesh(soup.view());
    const double unit = detail::last_place<Scalar>(largest_of(soup));
    const double most = detail::k_grain_units * unit + 8 * unit;
    Random random(52);
    Distances result;
    const QueryOptions options{.sides = sides};
    while (result.hits < count) {
        const Segment<Scalar> segment = step(random);
        const auto hit = mesh.first_hit(segment, options);
        if (!hit) continue;
        ++result.hits;
        if (hit->at_start) {
            ++result.at_start;
            EXPECT_EQ(hit->point, segment.from);
            continue;
        }
        const auto corner_at = [&](std::size_t k) {
            return detail::to_point(soup.positions[soup.triangles[hit->triangle][k]]);
        };
        const RationalOracle exact({detail::to_point(segment.from), detail::to_point(segment.to)},
                                   {corner_at(0), corner_at(1), corner_at(2)});
        Q square = 0;
        for (int k = 0; k < 3; ++k) {
            const Q at =
                Q(double(segment.from[k])) + exact.fraction() * (Q(double(segment.to[k])) - Q(double(segment.from[k])));
            const Q off = Q(double(hit->point[k])) - at;
            square += off * off;
        }
        EXPECT_FALSE(mesh.any_hit({segment.from, hit->point}, options));
        EXPECT_LE(Q(double(hit->fraction)), exact.fraction());
        if (square <= Q(most) * Q(most)) continue;
        ++result.beyond;
        EXPECT_FALSE(has_clear_place(mesh, segment, *hit, options, most, unit, random))
            << hit->point << " is " << std::sqrt(CGAL::to_double(square)) / unit << " units from " << hit->position;
    }
    std::cout << result.hits << " hits, " << result.at_start << " at their start, " << result.beyond
              << " points further than a grain and 8 units\n";
    return result;
}

void expect_near_points(int count) {
    for (const Sides sides : {Sides::front, Sides::both})
        EXPECT_EQ(distances(Grazing().soup, count, sides, Grazing::step).beyond, 0);
    const auto mixed = [count]<class Scalar>(const TriangleSoup<Scalar>& soup) {
        const Extent<Scalar> extent(soup.view());
        const auto step = [&](Random& random) { return mixed_segment(soup.view(), extent, random); };
        EXPECT_LE(distances(soup, count, Sides::front, step).beyond, count / 1000);
    };
    mixed(moved<float>(bumpy_sphere(16), 100, V(1e4, -1e5, 1e3)));
    mixed(moved<float>(polycube(4, 0.5, 1, 3), 0.1, V(0, 0, 0)));
    mixed(moved<double>(bumpy_sphere(16), 1, V(1e3, 1e6, 0)));
}
TEST(Place, points_are_near_the_true_ones) { expect_near_points(6'000); }
TEST(PlaceSoak, points_are_near_the_true_ones) { expect_near_points(1'000'000); }

template <class Scalar>
void expect_rounded_positions(int count) {
    Random random(53);
    int hits = 0;
    int ties = 0;
    while (hits < count) {
        TriangleSoup<Scalar> soup;
        const double size = std::array{1.0, 1.0, 1e-5, 1e7}[random.below(4)];
        const V middle = random.chance(0.5) ? V(0, 0, 0) : V(1e3 * random.in_cube());
        const bool whole = random.chance(0.3);  // coordinates of few digits: exact ones, and ties
        const auto some = [&]() -> V {
            const V p = size * random.in_cube() + middle;
            return whole ? V((p * 64 / size).array().round() * size / 64) : p;
        };
        add_triangle(soup, some(), some(), some());
        const CollisionMesh<Scalar> mesh(soup.view());
        const V inside = (soup.positions[0] + soup.positions[1] + soup.positions[2]).template cast<double>() / 3;
        const V far = random.chance(0.3) ? V(1e6 * size * random.in_cube()) : some();
        Segment<Scalar> segment{far.cast<Scalar>(),
                                (inside + (random.chance(0.5) ? 1 : 1e-3) * (inside - far)).cast<Scalar>()};
        if (random.chance(0.2)) segment.to = {segment.from[0], segment.to[1], segment.to[2]};
        const auto hit = mesh.first_hit(segment, {.sides = Sides::both});
        if (!hit) continue;
        ++hits;
        const auto p = [](const Vec3<Scalar>& v) { return detail::to_point(v); };
        const RationalOracle exact({p(segment.from), p(segment.to)},
                                   {p(soup.positions[0]), p(soup.positions[1]), p(soup.positions[2])});
        for (int k = 0; k < 3; ++k) {
            const Q at =
                Q(double(segment.from[k])) + exact.fraction() * (Q(double(segment.to[k])) - Q(double(segment.from[k])));
            const Scalar found = hit->position[k];
            constexpr Scalar k_infinity = std::numeric_limits<Scalar>::infinity();
            const Q above = (Q(double(found)) + Q(double(std::nextafter(found, k_infinity)))) / 2;
            const Q below = (Q(double(found)) + Q(double(std::nextafter(found, -k_infinity)))) / 2;
            ASSERT_LE(at, above) << found << " of " << CGAL::to_double(at);
            ASSERT_GE(at, below) << found << " of " << CGAL::to_double(at);
            if (at != above && at != below) continue;
            ++ties;
            const auto bits =
                std::bit_cast<std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>>(found);
            ASSERT_EQ(bits % 2, 0U) << "a tie goes to the even one";
        }
    }
    std::cout << hits << " hits, " << ties << " ties\n";
}
TEST(Place, positions_are_correctly_rounded) {
    expect_rounded_positions<float>(20'000);
    expect_rounded_positions<double>(20'000);
}
TEST(PlaceSoak, positions_are_correctly_rounded) {
    expect_rounded_positions<float>(500'000);
    expect_rounded_positions<double>(500'000);
}

TEST(Place, exact_positions_are_those_of_rational_numbers) {
    Random random(54);
    for (int i = 0; i < 3'000; ++i) {
        detail::Corners corners{};
        detail::Path path{};
        const int range = std::array{0, 40, 900}[random.below(3)];
        const auto some = [&] { return std::ldexp(random.between(-1, 1), random.between_ints(-range, range / 2)); };
        for (detail::Point* p : {&path.from, &path.to, &corners[0], &corners[1], &corners[2]})
            *p = {some(), some(), some()};
        const RationalOracle exact(path, corners);
        if (exact.from_side() == exact.to_side() || (exact.from_side() < 0) == (exact.to_side() < 0)) continue;
        const detail::Point near = random.chance(0.5) ? path.from : detail::Point{some(), some(), some()};
        const detail::Point found = detail::exact_position<double>(path, corners, near);
        for (std::size_t k = 0; k < 3; ++k) {
            const Q at = Q(path.from[k]) + exact.fraction() * (Q(path.to[k]) - Q(path.from[k]));
            constexpr double k_infinity = std::numeric_limits<double>::infinity();
            ASSERT_LE(at, (Q(found[k]) + Q(std::nextafter(found[k], k_infinity))) / 2);
            ASSERT_GE(at, (Q(found[k]) + Q(std::nextafter(found[k], -k_infinity))) / 2);
        }
    }
}

}  // namespace
}  // namespace pierce::test
