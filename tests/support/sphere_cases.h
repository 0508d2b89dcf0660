// Sweeps of spheres that are hard to judge: aimed at faces, edges and corners, grazing, in contact at the start,
// inside, with radii much smaller and much larger than the triangles, far away, on a lattice where all of it comes out
// even.
#pragma once

#include <Eigen/Geometry>

#include <pierce/triangle_soup.h>
#include <point.h>
#include <sphere/nearest.h>
#include <support/meshes.h>
#include <support/random.h>

namespace pierce::test {

template <class Scalar>
struct SphereCase {
    Segment<Scalar> step;
    Scalar radius;
};

/// A few triangles: one alone, a sliver, a roof, two that coincide, a box, shards, a fan.
inline TriangleSoup<double> small_mesh(Random& random) {
    TriangleSoup<double> soup;
    const auto corner = [&] { return random.in_cube(); };
    const auto on_lattice = [&]() -> Vec3<double> {
        const int x = random.between_ints(-4, 4), y = random.between_ints(-4, 4), z = random.between_ints(-4, 4);
        return Vec3<double>(x, y, z) / 4;
    };
    const std::size_t kind = random.below(8);
    const auto one = [&](const auto& place) {
        const Vec3<double> a = place(), b = place(), c = place();
        add_triangle(soup, a, b, c);
    };
    if (kind == 0) one(corner);
    if (kind == 1) one(on_lattice);
    if (kind == 2) {
        const Vec3<double> a = corner(), b = corner(), u = random.direction();
        add_triangle(soup, a, b, Vec3<double>(a + random.unit() * (b - a) + 1e-5 * u));
    }
    if (kind == 3) {
        const Vec3<double> a = on_lattice(), b = on_lattice(), c = on_lattice(), d = on_lattice();
        add_triangle(soup, a, b, c);
        add_triangle(soup, b, a, d);
    }
    if (kind == 4) {
        one(corner);
        const TriangleSoup<double> copy = soup;
        append(soup, copy);
        add_triangle(soup, soup.positions[0], soup.positions[1], soup.positions[1]);
    }
    if (kind == 5) soup = polycube(1, 1, 1, 1);
    if (kind == 6) soup = shards(4, random.below(1000));
    if (kind == 7) {
        const Vec3<double> tip = corner();
        for (int i = 0; i < 5; ++i) {
            const double x = 1.3 * i;
            add_triangle(soup, tip, {std::cos(x), std::sin(x), 0}, {std::cos(x + 1.3), std::sin(x + 1.3), 0.1});
        }
    }
    return soup;
}

/// A place of a triangle: on its face, an edge, or a corner.
template <class Scalar>
Vec3<double> place_on(const TriangleSoup<Scalar>& soup, Random& random, std::size_t triangle) {
    const IndexTriple& t = soup.triangles[triangle];
    const std::size_t kind = random.below(3);
    const double x = random.unit();
    const Vec3<double> w = kind == 0 ? random.weights() : kind == 1 ? Vec3<double>(x, 1 - x, 0) : Vec3<double>(0, 1, 0);
    Vec3<double> place = Vec3<double>::Zero();
    for (int k = 0; k < 3; ++k)
        place +=
            w[k] *
            soup.positions[t[static_cast<std::size_t>((k + static_cast<int>(triangle)) % 3)]].template cast<double>();
    return place;
}

/// Whether the center is nearer to a triangle than the radius, about.
template <class Scalar>
bool overlaps_about(const TriangleSoup<Scalar>& soup, const SphereCase<Scalar>& c) {
    using detail::to_point;
    return std::any_of(soup.triangles.begin(), soup.triangles.end(), [&](const IndexTriple& t) {
        const detail::Corners corners = {to_point(soup.positions[t[0]]), to_point(soup.positions[t[1]]),
                                         to_point(soup.positions[t[2]])};
        const detail::Point from = to_point(c.step.from);
        const detail::Point away = detail::minus(from, detail::nearest_of(corners, from).point);
        return std::sqrt(detail::dot(away, away)) < static_cast<double>(c.radius) * (1 - 1e-6);
    });
}

template <class Scalar>
SphereCase<Scalar> any_sphere_case(const TriangleSoup<Scalar>& soup, Random& random, double size) {
    SphereCase<Scalar> out;
    const std::size_t triangle = random.below(soup.triangles.size());
    const IndexTriple& t = soup.triangles[triangle];
    const auto corner = [&](std::size_t k) { return Vec3<double>(soup.positions[t[k]].template cast<double>()); };
    const bool even = random.chance(0.2);
    double r = size * std::pow(10.0, random.between(-2, 1.3));
    if (even) r = size * std::ldexp(1.0, random.between_ints(-4, 1));
    if (random.chance(0.05)) r = size * std::pow(10.0, random.between(-5, 4));
    out.radius = static_cast<Scalar>(r);
    r = static_cast<double>(out.radius);
    const Vec3<double> target = place_on(soup, random, triangle);
    Vec3<double> n = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    if (!(n.squaredNorm() > 0.5)) n = random.direction();
    if (random.chance(0.5)) n = (n + random.unit() * random.direction()).normalized();
    if (random.chance(0.5)) n = -n;
    if (even) n = Vec3<double>::Unit(static_cast<int>(random.below(3))) * (random.chance(0.5) ? 1 : -1);
    // Where it touches, and the way there: any, grazing, or straight in.
    const Vec3<double> touching = target + r * n;
    Vec3<double> d = random.direction();
    const std::size_t kind = random.below(6);
    if (kind >= 2 && kind <= 4) d = (d - d.dot(n) * n).normalized();
    if (kind == 3) d = (d + std::pow(10.0, random.between(-9, -1)) * (random.chance(0.7) ? -1 : 1) * n).normalized();
    if (kind == 5) d = -n;
    if (even) d = Vec3<double>::Unit(static_cast<int>(random.below(3))) * (random.chance(0.5) ? 1 : -1);
    const double length = size *
                          (random.chance(0.2)   ? 0.001
                           : random.chance(0.2) ? 10
                                                : 1) *
                          (even ? 1 : random.unit());
    const double before = random.chance(0.25) ? 0 : even ? 1 : random.unit();
    const double after = random.chance(0.1) ? 0 : even ? 1 : random.unit();
    Vec3<double> from = touching - before * length * d;
    if (random.chance(0.1)) from = target + random.unit() * r * random.direction();  // overlapping
    if (random.chance(0.02)) from = target;
    const Vec3<double> to = touching + after * length * d;
    out.step = {from.cast<Scalar>(), to.cast<Scalar>()};
    if (random.chance(0.01)) out.step.to = out.step.from;
    return out;
}

/// `size`: about that of the mesh. One in ten of those that overlap at the start is taken.
template <class Scalar>
SphereCase<Scalar> sphere_case(const TriangleSoup<Scalar>& soup, Random& random, double size) {
    for (;;) {
        const SphereCase<Scalar> c = any_sphere_case(soup, random, size);
        if (random.chance(0.1) || !overlaps_about(soup, c)) return c;
    }
}

}  // namespace pierce::test
