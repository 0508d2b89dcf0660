// Ways in which closed meshes move on and on: a beating ball, a twisting box, a waving sheet.
#pragma once

#include <cmath>
#include <vector>

#include <pierce/triangle_soup.h>

namespace pierce::test {

using Shape = Vec3<double> (*)(const Vec3<double>&, double time);

inline Vec3<double> beating(const Vec3<double>& p, double time) {
    const double beat = 1 + 0.35 * std::sin(3 * time) + 0.1 * std::sin(7 * time + 5 * p[0]);
    return beat * p;
}
inline Vec3<double> twisting(const Vec3<double>& p, double time) {
    const Vec3<double> box = p / p.cwiseAbs().maxCoeff();
    const double angle = 1.2 * std::sin(2 * time) * box[2];
    return {std::cos(angle) * box[0] - std::sin(angle) * box[1], std::sin(angle) * box[0] + std::cos(angle) * box[1],
            box[2]};
}
inline Vec3<double> waving(const Vec3<double>& p, double time) {
    return {2 * p[0], 2 * p[1], 0.3 * p[2] + 0.4 * std::sin(2 * p[0] + 3 * time) + 0.2 * std::cos(3 * p[1] - 2 * time)};
}

template <class Scalar>
std::vector<Vec3<Scalar>> shaped(const TriangleSoup<double>& rest, Shape shape, double time, double offset) {
    std::vector<Vec3<Scalar>> out;
    for (const Vec3<double>& p : rest.positions)
        out.push_back((shape(p, time) + Vec3<double>::Constant(offset)).template cast<Scalar>());
    return out;
}

}  // namespace pierce::test
