// Seeded random numbers that are the same on every machine: std::mt19937_64 is fixed by the standard, its distributions
// are not.
#pragma once

#include <cstdint>
#include <random>

#include <pierce/types.h>

namespace pierce::test {

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Uniform in 0 .. count - 1, but for a bias below count / 2^64.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
    int between_ints(int low, int high) {
        return low + static_cast<int>(below(static_cast<std::size_t>(high - low + 1)));
    }
    bool chance(double p) { return unit() < p; }
    /// Uniform in the cube [-1, 1)^3.
    Vec3<double> in_cube() {
        const double x = between(-1, 1);
        const double y = between(-1, 1);
        return {x, y, between(-1, 1)};
    }
    /// Uniform on the unit sphere.
    Vec3<double> direction() {
        for (;;) {
            const Vec3<double> v = in_cube();
            // Not squaredNorm, which adds in another order where there are vectors of other lengths.
            const double square = v.x() * v.x() + v.y() * v.y() + v.z() * v.z();
            if (square > 1e-4 && square < 1) return v / std::sqrt(square);
        }
    }
    /// Weights of three corners, uniform over the triangle.
    Vec3<double> weights() {
        double u = unit();
        double v = unit();
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        return {1 - u - v, u, v};
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace pierce::test
