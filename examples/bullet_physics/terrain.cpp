// See terrain.h.
#include "bullet_physics/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

namespace bullet_physics {
namespace {

// Coordinates in units have 25 bits, so a product of three differences has 78, and six of them 81.
__extension__ using Wide = __int128;
using Lattice = std::array<std::int64_t, 3>;

int orientation(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
    Wide u[3], v[3], w[3];
    for (std::size_t k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    const Wide volume =
        u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

bool passes(const Lattice& from, const Lattice& to, const Lattice& a, const Lattice& b, const Lattice& c) {
    if (orientation(a, b, c, from) * orientation(a, b, c, to) >= 0) return false;
    const int x = orientation(from, to, a, b), y = orientation(from, to, b, c), z = orientation(from, to, c, a);
    return std::max({x, y, z}) <= 0 || std::min({x, y, z}) >= 0;
}

/// Hills from 10 to 60 m wide. `x`, `z` from the middle.
float height(float x, float z) {
    const float hills = 1.2f * std::sin(0.11f * x + 0.3f) * std::cos(0.1f * z) + 0.5f * std::sin(0.3f * x) +
                        0.4f * std::cos(0.37f * z + 0.1f * x) + 0.1f * std::sin(0.7f * x - 0.6f * z);
    return std::round(256 * hills) / 256;
}

}  // namespace

Terrain::Terrain(float middle) : low_(middle - k_square * k_size / 2) {
    for (int tile = 0; tile < k_tiles * k_tiles; ++tile) {
        const auto first = static_cast<std::uint32_t>(soup_.positions.size());
        for (int j = 0; j <= k_tile; ++j)
            for (int i = 0; i <= k_tile; ++i)
                soup_.positions.push_back(corner(tile % k_tiles * k_tile + i, tile / k_tiles * k_tile + j));
        for (std::uint32_t j = 0; j < k_tile; ++j)
            for (std::uint32_t i = 0; i < k_tile; ++i) {
                const std::uint32_t a = first + j * (k_tile + 1) + i, b = a + 1, c = b + k_tile, d = c + 1;
                soup_.triangles.push_back({a, c, b});
                soup_.triangles.push_back({b, c, d});
            }
    }
    unit_ = std::ldexp(1.0f, std::ilogb(std::abs(middle) + k_square * k_size / 2) - 23);
    mesh_ = pierce::CollisionMesh<float>(soup_.view());
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(soup_.triangles.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(soup_.triangles.data());
    part.m_triangleIndexStride = sizeof(pierce::IndexTriple);
    part.m_numVertices = static_cast<int>(soup_.positions.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(soup_.positions.data());
    part.m_vertexStride = sizeof(Vec3);
    triangles_.addIndexedMesh(part);
}

Vec3 Terrain::corner(int i, int j) const {
    const float x = k_square * static_cast<float>(i), z = k_square * static_cast<float>(j);
    constexpr float k_half = k_square * k_size / 2;
    return {low_ + x, height(x - k_half, z - k_half), low_ + z};
}

Vec3 Terrain::rounded(const Vec3& point) const { return unit_ * (point / unit_).array().round(); }

std::vector<Vec3> Terrain::passed(const Vec3& from, const Vec3& to) const {
    const auto in_units = [this](const Vec3& p) {
        const Eigen::Vector3d q = p.cast<double>() / double(unit_);
        return Lattice{std::llround(q.x()), std::llround(q.y()), std::llround(q.z())};
    };
    std::vector<Vec3> normals;
    const auto look_at = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        if (passes(in_units(from), in_units(to), in_units(a), in_units(b), in_units(c)))
            normals.push_back((b - a).cross(c - a).normalized());
    };
    const auto square = [this](float x) { return static_cast<int>(std::floor((x - low_) / k_square)); };
    const Vec3 low = from.cwiseMin(to), high = from.cwiseMax(to);
    // One more on each side: then rounding in the line above leaves out none.
    for (int j = std::max(square(low.z()) - 1, 0); j <= std::min(square(high.z()) + 1, k_size - 1); ++j)
        for (int i = std::max(square(low.x()) - 1, 0); i <= std::min(square(high.x()) + 1, k_size - 1); ++i) {
            look_at(corner(i, j), corner(i, j + 1), corner(i + 1, j));
            look_at(corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1));
        }
    return normals;
}

}  // namespace bullet_physics
