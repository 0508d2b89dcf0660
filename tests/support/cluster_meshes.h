// Meshes for tests of the build: soups that are as unlike one another as coordinates allow.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include <support/meshes.h>

namespace pierce::test {

/// Triangles of up to `size` in a cube of 2 about `center`, times `scale`; one in fifty has no area.
template <class Scalar>
TriangleSoup<Scalar> random_soup(int count, double size, double scale, double center, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(-1, 1);
    const auto point = [&](double width, const Vec3<Scalar>& about) {
        return Vec3<Scalar>(about + Vec3<double>(in(random), in(random), in(random))
                                        .cwiseProduct(Vec3<double>::Constant(width * scale))
                                        .template cast<Scalar>());
    };
    TriangleSoup<Scalar> soup;
    const Vec3<Scalar> middle = Vec3<double>::Constant(center * scale).cast<Scalar>();
    for (int i = 0; i < count; ++i) {
        const Vec3<Scalar> a = point(1, middle);
        const Vec3<Scalar> b = point(size, a);
        const Vec3<Scalar> c = i % 50 == 7 ? a : point(size, a);
        add_triangle<Scalar>(soup, a.template cast<double>(), b.template cast<double>(), c.template cast<double>());
    }
    return soup;
}

/// One triangle of each size, by powers of two, all with a corner at the origin or close to it.
template <class Scalar>
TriangleSoup<Scalar> nested_soup(int least_exponent, int largest_exponent, int copies) {
    TriangleSoup<Scalar> soup;
    for (int e = least_exponent; e <= largest_exponent; ++e)
        for (int i = 0; i < copies; ++i) {
            const double s = std::ldexp(1.0, e);
            add_triangle<Scalar>(soup, {s, 0, 0}, {s, i % 2 == 0 ? s : -s, 0}, {0, 0, i % 3 == 0 ? s : -s});
        }
    return soup;
}

template <class Scalar>
TriangleSoup<Scalar> nested_soup_of_all_sizes(int copies) {
    using Limits = std::numeric_limits<Scalar>;
    return nested_soup<Scalar>(Limits::min_exponent - Limits::digits + 1, Limits::max_exponent - 1, copies);
}

/// Far from the origin, and at both ends of the range of numbers: `use(soup, what)` for each.
template <class Scalar, class Use>
void for_each_extreme_soup(const Use& use) {
    using Limits = std::numeric_limits<Scalar>;
    use(random_soup<Scalar>(3000, 0.1, 1, 1e4, 3), "far away");
    use(random_soup<Scalar>(3000, 0.05, static_cast<double>(Limits::max()) / 4, 0, 4), "the largest numbers");
    use(random_soup<Scalar>(500, 0.1, static_cast<double>(Limits::min()), 0, 5), "subnormal numbers");
    use(random_soup<Scalar>(500, 0.5, 100 * static_cast<double>(Limits::denorm_min()), 0, 6), "few different numbers");
}

/// A scene of large triangles, and in it many that are small: all of them less than a step of the scene's lattice.
template <class Scalar>
TriangleSoup<Scalar> teapot_in_stadium(int count, double teapot) {
    TriangleSoup<Scalar> soup = random_soup<Scalar>(count, 0.03, teapot, 0.1 / teapot, 4);
    append(soup, random_soup<Scalar>(count / 40, 0.3, 1, 0, 5));
    return soup;
}

}  // namespace pierce::test
