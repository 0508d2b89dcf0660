// A terrain of hills in tiles that share no vertices, as engines load it, and what exact arithmetic says of a ray.
#pragma once

#include <vector>

#include <btBulletCollisionCommon.h>

#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>

namespace bullet_physics {

using Vec3 = Eigen::Vector3f;

/// Squares of 2 m, each of two triangles, y up, around (middle, 0, middle). All coordinates are multiples of 1/256 m.
class Terrain {
  public:
    static constexpr int k_tiles = 8, k_tile = 16, k_size = k_tiles * k_tile;  ///< in squares, along a side
    static constexpr float k_square = 2;

    /// `middle`: a multiple of 2, not above 2^15.
    explicit Terrain(float middle);

    [[nodiscard]] const pierce::TriangleSoup<float>& soup() const { return soup_; }
    [[nodiscard]] const pierce::CollisionMesh<float>& mesh() const { return mesh_; }
    /// The same arrays for Bullet, read for as long as this lives.
    [[nodiscard]] btTriangleIndexVertexArray& triangles() { return triangles_; }

    /// The vertex at corner (i, j) of the squares, 0 to k_size.
    [[nodiscard]] Vec3 corner(int i, int j) const;
    /// What coordinates of rays must be multiples of, for `is_hit`: the spacing of floats at the far end.
    [[nodiscard]] float unit() const { return unit_; }
    /// Rounded to multiples of the unit.
    [[nodiscard]] Vec3 rounded(const Vec3& point) const;

    /// Unit normals of the triangles that the segment passes through, inside or at their border, from one side of the
    /// plane to the other: decided in whole numbers, triangle by triangle, without pierce. For short segments, as it
    /// looks at all squares in the segment's box.
    [[nodiscard]] std::vector<Vec3> passed(const Vec3& from, const Vec3& to) const;

  private:
    float low_, unit_;
    pierce::TriangleSoup<float> soup_;
    pierce::CollisionMesh<float> mesh_;
    btTriangleIndexVertexArray triangles_;
};

}  // namespace bullet_physics
