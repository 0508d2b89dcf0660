// Rays at places where neighbouring triangles must agree, cast by Bullet and by pierce, and judged in whole numbers.
#pragma once

#include <array>
#include <iosfwd>
#include <string_view>
#include <vector>

#include "bullet_physics/terrain.h"

namespace bullet_physics {

/// Who casts: Bullet's `rayTest` on its own shape, pierce as a btVehicleRaycaster, and `rayTest` on a PierceShape.
enum Caster { bullet, raycaster, shape, caster_count };

struct Count {
    std::size_t missed = 0;  ///< rays that hit the terrain in exact arithmetic, but not here
    std::size_t ghosts = 0;  ///< the other way around
    std::size_t faces = 0;   ///< that hit in both, but here with the normal of a face that they don't pass through

    [[nodiscard]] std::size_t wrong() const { return missed + ghosts + faces; }
};

struct Row {
    std::string_view aim;
    std::size_t rays = 0;
    std::array<Count, caster_count> counts = {};
};

struct Rays {
    std::vector<Row> rows;
    std::array<double, caster_count> nanoseconds = {};  ///< a ray from a wheel, one call after the other
    std::vector<Vec3> wrong;                            ///< middles of the rays that Bullet got wrong
};

/// Casts `count` rays of each kind at the terrain.
Rays cast_rays(Terrain& terrain, std::size_t count);

/// As a table.
void print(std::ostream& out, const Rays& rays);

/// How many answers of pierce were wrong.
std::size_t pierce_errors(const Rays& rays);

}  // namespace bullet_physics
