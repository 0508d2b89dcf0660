// See shapes.h.
#include "show/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

namespace show {

pierce::TriangleSoup<float> bumpy_sphere(int n) {
    // Points of an octahedron's surface whose coordinates are whole numbers, |x| + |y| + |z| = n, put on the surface.
    pierce::TriangleSoup<float> soup;
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto vertex = [&](std::array<int, 3> at) {
        const auto [place, is_new] = numbers.try_emplace(at, static_cast<std::uint32_t>(soup.positions.size()));
        if (is_new) {
            const Eigen::Vector3f direction =
                Eigen::Vector3f(static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]))
                    .normalized();
            const float bumps =
                std::sin(5 * direction.x()) * std::sin(4 * direction.y() + 1) * std::cos(6 * direction.z());
            soup.positions.push_back((1 + 0.2f * bumps) * direction);
        }
        return place->second;
    };
    for (int octant = 0; octant < 8; ++octant) {
        const std::array<int, 3> signs = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
        const bool is_turned = signs[0] * signs[1] * signs[2] < 0;
        const auto at = [&](int i, int j) { return vertex({signs[0] * i, signs[1] * j, signs[2] * (n - i - j)}); };
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            soup.triangles.push_back(is_turned ? pierce::IndexTriple{a, c, b} : pierce::IndexTriple{a, b, c});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return soup;
}

pierce::TriangleSoup<float> box(int n, const Eigen::Affine3d& transform) {
    pierce::TriangleSoup<float> soup;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
        const auto at = [&](int i, int j) {
            Eigen::Vector3d point;
            point[axis] = side % 2 ? 1 : -1;
            point[first] = 2.0 * i / n - 1;
            point[second] = 2.0 * j / n - 1;
            soup.positions.push_back((transform * point).cast<float>());
            return static_cast<std::uint32_t>(soup.positions.size() - 1);
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
                soup.triangles.push_back(side % 2 ? pierce::IndexTriple{a, b, c} : pierce::IndexTriple{a, c, b});
                soup.triangles.push_back(side % 2 ? pierce::IndexTriple{a, c, d} : pierce::IndexTriple{a, d, c});
            }
    }
    return soup;
}

void add(pierce::TriangleSoup<float>& soup, const pierce::TriangleSoup<float>& more, bool turned) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), more.positions.begin(), more.positions.end());
    for (const auto& [a, b, c] : more.triangles)
        soup.triangles.push_back(turned ? pierce::IndexTriple{first + a, first + c, first + b}
                                        : pierce::IndexTriple{first + a, first + b, first + c});
}

pierce::TriangleSoup<float> hall(std::uint32_t seed, const Eigen::Isometry3d& frame) {
    const Eigen::Vector3d half(20, 6, 20);
    pierce::TriangleSoup<float> soup;
    add(soup, box(16, frame * Eigen::Translation3d(half) * Eigen::Scaling(half)), true);
    std::mt19937 random(seed);
    const auto uniform = [&](double from, double to) {
        return from + (to - from) * 0x1p-32 * static_cast<double>(random());
    };
    // One thing in each square of 5 x 5, no larger than it, in which it may turn.
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) {
            const Eigen::Vector3d middle(5 * i + 2.5, uniform(2.5, 8), 5 * j + 2.5);
            const Eigen::Vector3d axis(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1));
            const Eigen::AngleAxisd turn(uniform(0, std::numbers::pi), axis.normalized());
            if (random() % 4 == 0) {
                auto boulder = bumpy_sphere(6);
                for (Eigen::Vector3f& position : boulder.positions)
                    position = (frame * (middle + 1.4 * (turn * position.cast<double>()))).cast<float>();
                add(soup, boulder);
            } else {  // many are thin enough to be shot through
                const Eigen::Vector3d size(uniform(0.05, 0.3), uniform(0.5, 1.5), uniform(0.5, 1.5));
                add(soup, box(2, frame * Eigen::Translation3d(middle) * turn * Eigen::Scaling(size)));
            }
        }
    return soup;
}

pierce::TriangleSoup<float> paddle_drum() {
    // The outline: the wall, and for each paddle a step in to 0.7 and out again. All of it is seen from the axis.
    std::vector<Eigen::Vector2f> outline;
    const auto add_point = [&](double degrees, double radius) {
        const double angle = degrees * std::numbers::pi / 180;
        outline.emplace_back(static_cast<float>(radius * std::cos(angle)),
                             static_cast<float>(radius * std::sin(angle)));
    };
    for (int paddle = 0; paddle < 6; ++paddle) {
        for (int k = 0; k < 7; ++k) add_point(60 * paddle + 8 * k, 1);
        add_point(60 * paddle + 51, 0.7);
        add_point(60 * paddle + 53, 0.7);
    }
    constexpr int slices = 6;
    const auto count = static_cast<std::uint32_t>(outline.size());
    pierce::TriangleSoup<float> soup;
    for (int slice = 0; slice <= slices; ++slice)
        for (const Eigen::Vector2f& point : outline)
            soup.positions.emplace_back(point.x(), point.y(), static_cast<float>(slice) / slices - 0.5f);
    for (std::uint32_t slice = 0; slice < slices; ++slice)
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t a = slice * count + k, b = slice * count + (k + 1) % count;
            soup.triangles.push_back({a, b + count, b});
            soup.triangles.push_back({a, a + count, b + count});
        }
    for (const bool is_front : {false, true}) {
        const auto middle = static_cast<std::uint32_t>(soup.positions.size());
        soup.positions.emplace_back(0.0f, 0.0f, is_front ? 0.5f : -0.5f);
        const std::uint32_t first = is_front ? slices * count : 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t a = first + k, b = first + (k + 1) % count;
            soup.triangles.push_back(is_front ? pierce::IndexTriple{middle, b, a} : pierce::IndexTriple{middle, a, b});
        }
    }
    return soup;
}

pierce::TriangleSoup<float> courtyard() {
    const auto at = [](double x, double y, double z, double width, double height, double depth) {
        return Eigen::Affine3d(Eigen::Translation3d(x, y, z) * Eigen::Scaling(width / 2, height / 2, depth / 2));
    };
    pierce::TriangleSoup<float> soup;
    add(soup, box(60, at(12, 3, 12, 24, 6, 24)), true);
    for (const double x : {4.0, 12.0, 20.0})
        for (const double z : {4.0, 20.0}) add(soup, box(4, at(x, 2.5, z, 0.8, 4, 0.8)));
    // The ramp stands a little above the floor: pieces that meet would be one surface with folds.
    const Eigen::AngleAxisd slope(0.3, Eigen::Vector3d::UnitZ());
    add(soup, box(10, Eigen::Translation3d(13, 1, 12) * slope * Eigen::Scaling(3.0, 0.1, 2.0)));
    return soup;
}

}  // namespace show
