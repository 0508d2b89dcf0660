// Fans for the tests: spiral stairs.
#pragma once

#include <cmath>
#include <vector>

#include <support/random.h>

namespace pierce::test {

struct FanGeometry {
    Vec3<double> apex;
    std::vector<Vec3<double>> ring;
};

/// n good triangles that go up around an axis like a spiral stair, in any orientation.
inline FanGeometry stair(std::size_t n, Random& random) {
    FanGeometry fan{random.in_cube(), {}};
    const Vec3<double> axis = random.direction();
    const Vec3<double> x = axis.cross(random.direction()).normalized();
    const Vec3<double> y = axis.cross(x);
    double angle = 0;
    for (std::size_t k = 0; k <= n; ++k) {
        fan.ring.push_back(fan.apex + random.between(0.5, 1) * (std::cos(angle) * x + std::sin(angle) * y) +
                           random.between(-0.4, 0.4) * axis);
        angle += random.between(0.4, 1.6);
    }
    return fan;
}

}  // namespace pierce::test
