// Meshes for tests of the build: soups that are as unlike one another as coordinates allow.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <pierce/mesh_view.h>

namespace pierce::test {

template <class Scalar>
struct Soup {
    std::vector<Vec3<Scalar>> positions;
    std::vector<IndexTriple> triangles;

    [[nodiscard]] MeshView<Scalar> view() const { return {positions, triangles}; }
    void add(const Vec3<Scalar>& a, const Vec3<Scalar>& b, const Vec3<Scalar>& c) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec3<Scalar>& x : {a, b, c}) positions.push_back(x);
        triangles.push_back({first, first + 1, first + 2});
    }
};

/// Triangles of up to `size` in a cube of 2 about `center`, times `scale`; one in fifty has no area.
template <class Scalar>
Soup<Scalar> random_soup(int count, double size, double scale, double center, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(-1, 1);
    const auto point = [&](double width, const Vec3<Scalar>& about) {
        return Vec3<Scalar>(about + Vec3<double>(in(random), in(random), in(random))
                                        .cwiseProduct(Vec3<double>::Constant(width * scale))
                                        .template cast<Scalar>());
    };
    Soup<Scalar> soup;
    const Vec3<Scalar> middle = Vec3<double>::Constant(center * scale).cast<Scalar>();
    for (int i = 0; i < count; ++i) {
        const Vec3<Scalar> a = point(1, middle);
        const Vec3<Scalar> b = point(size, a);
        soup.add(a, b, i % 50 == 7 ? a : point(size, a));
    }
    return soup;
}

/// One triangle of each size, by powers of two, all with a corner at the origin or close to it.
template <class Scalar>
Soup<Scalar> nested_soup(int least_exponent, int largest_exponent, int copies) {
    Soup<Scalar> soup;
    for (int e = least_exponent; e <= largest_exponent; ++e)
        for (int i = 0; i < copies; ++i) {
            const Scalar s = std::ldexp(Scalar(1), e);
            soup.add({s, 0, 0}, {s, i % 2 == 0 ? s : -s, 0}, {0, 0, i % 3 == 0 ? s : -s});
        }
    return soup;
}

/// A scene of large triangles, and in it many that are small: all of them less than a step of the scene's lattice.
template <class Scalar>
Soup<Scalar> teapot_in_stadium(int count, double teapot) {
    Soup<Scalar> soup = random_soup<Scalar>(count, 0.03, teapot, 0.1 / teapot, 4);
    const Soup<Scalar> stadium = random_soup<Scalar>(count / 40, 0.3, 1, 0, 5);
    for (const IndexTriple& t : stadium.triangles)
        soup.add(stadium.positions[t[0]], stadium.positions[t[1]], stadium.positions[t[2]]);
    return soup;
}

}  // namespace pierce::test
