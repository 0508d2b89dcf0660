// Floors that stand anywhere and look anywhere, for tests of where hits are placed.
#pragma once

#include <pierce/pierce.h>
#include <support/meshes.h>
#include <Eigen/Geometry>

namespace pierce::test {

template <class Scalar>
double largest_of(const TriangleSoup<Scalar>& soup) {
    double largest = 0;
    for (const Vec3<Scalar>& p : soup.positions) largest = std::max(largest, double(p.cwiseAbs().maxCoeff()));
    return largest;
}

// A floor around `middle`; `walls`: with a second one that looks down, in the same place.
template <class Scalar>
TriangleSoup<Scalar> floor_at(const Vec3<double>& middle, const Vec3<double>& up, double size, bool walls) {
    TriangleSoup<Scalar> soup;
    const Vec3<double> x = up.unitOrthogonal() * size;
    const Vec3<double> y = up.cross(x);
    add_triangle(soup, middle - x - y, middle + x - y, middle + x + y);
    add_triangle(soup, middle - x - y, middle + x + y, middle - x + y);
    const std::size_t count = soup.triangles.size();
    for (std::size_t i = 0; walls && i < count; ++i)
        soup.triangles.push_back({soup.triangles[i][0], soup.triangles[i][2], soup.triangles[i][1]});
    return soup;
}

}  // namespace pierce::test
