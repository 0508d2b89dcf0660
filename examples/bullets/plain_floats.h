// The world that pierce is compared with: Moller and Trumbore's test in floats, a skin, every triangle in turn. It is
// written as it is found in many programs, and is right in exact arithmetic.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <pierce/triangle_soup.h>
#include <Eigen/Geometry>

namespace bullets {

using Vec3 = Eigen::Vector3f;

inline constexpr float k_gravity = 9.8f;
inline constexpr float k_restitution = 0.6f;
inline constexpr float k_rest_speed = 1;  // meters a second: what comes more slowly doesn't bounce

struct Bullet {
    Vec3 position;
    Vec3 velocity;
    int walls = 0;  ///< that it went through
};

class PlainFloats {
  public:
    explicit PlainFloats(const pierce::TriangleSoup<float>& soup) {
        for (const auto& [a, b, c] : soup.triangles) {
            const Vec3 &p = soup.positions[a], &q = soup.positions[b], &r = soup.positions[c];
            triangles_.push_back({p, q - p, r - p, (q - p).cross(r - p).normalized()});
        }
    }

    /// Moves to the hit, a skin off the surface, is reflected, and goes on.
    void fly(Bullet& bullet, float seconds, float skin) const {
        for (int k = 0; k < 16 && seconds > 0; ++k) {
            const Vec3 way = seconds * bullet.velocity;
            const auto hit = first_hit(bullet.position, way);
            if (!hit) {
                bullet.position += way;
                return;
            }
            seconds *= 1 - hit->fraction;
            bullet.position += hit->fraction * way + skin * hit->normal;
            const float approach = -hit->normal.dot(bullet.velocity);
            bullet.velocity += (approach > k_rest_speed ? 1 + k_restitution : 1) * approach * hit->normal;
        }
    }

  private:
    struct Triangle {
        Vec3 corner, first_edge, second_edge, normal;
    };
    struct Hit {
        float fraction;
        Vec3 normal;
    };

    /// From the front only, as for pierce's bullets.
    [[nodiscard]] std::optional<Hit> first_hit(const Vec3& from, const Vec3& way) const {
        std::optional<Hit> first;
        for (const Triangle& triangle : triangles_) {
            const Vec3 p = way.cross(triangle.second_edge);
            const float determinant = triangle.first_edge.dot(p);
            if (!(determinant > 1e-7f)) continue;  // from behind, or along the plane
            const Vec3 offset = from - triangle.corner;
            const float u = offset.dot(p) / determinant;
            if (u < 0 || u > 1) continue;
            const Vec3 q = offset.cross(triangle.first_edge);
            const float v = way.dot(q) / determinant;
            if (v < 0 || u + v > 1) continue;
            const float t = triangle.second_edge.dot(q) / determinant;
            if (t >= 0 && t <= 1 && !(first && first->fraction <= t)) first = Hit{t, triangle.normal};
        }
        return first;
    }

    std::vector<Triangle> triangles_;
};

}  // namespace bullets
