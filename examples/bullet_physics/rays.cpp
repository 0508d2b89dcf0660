// See rays.h.
#include "bullet_physics/rays.h"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <memory>
#include <ostream>
#include <utility>

#include "bullet_physics/adapters.h"
#include "bullet_physics/car.h"
#include "show/random.h"

namespace bullet_physics {
namespace {

using Ray = std::pair<Vec3, Vec3>;

/// Makes rays whose ends are multiples of the terrain's unit, so that what they are aimed at they hit exactly.
class Aims {
  public:
    explicit Aims(const Terrain& terrain) : terrain_(terrain) {}

    /// Down through a vertex, not one of the border.
    Ray vertex() {
        const Vec3 target = terrain_.corner(inner(), inner()), way = down();
        return {target - way, target + way};
    }
    /// Down through an edge along x, along z or between, at a third of it: as a rule no floats are there.
    Ray edge() {
        const int i = inner(), j = inner(), kind = below(3);
        const Vec3 a = terrain_.corner(i, j), b = terrain_.corner(i + (kind != 1), j + (kind == 2 ? -1 : kind));
        const Vec3 from = terrain_.rounded(a + (b - a) / 3 - 0.5f * down());
        // A third of the way to this is a + (b - a) / 3.
        return {from, from + 3 * (a - from) + (b - a)};
    }
    /// The same, but past the edge by 1 to 8 units.
    Ray beside_edge() {
        const Ray ray = edge();
        const Vec3 off(terrain_.unit() * static_cast<float>(1 + below(8)), 0, 0);
        return {ray.first + off, ray.second + off};
    }
    /// Down, one unit beside the border: there is nothing to hit.
    Ray beside() {
        const Vec3 a = terrain_.corner(0, inner()), b = terrain_.corner(Terrain::k_size, inner());
        const float unit = terrain_.unit();
        Vec3 target = below(2) != 0 ? Vec3(a - Vec3(unit, 0, 0)) : Vec3(b + Vec3(unit, 0, 0));
        target.z() += terrain_.rounded(Vec3(0, 0, 2 * random_())).z();
        Vec3 way = down();
        way.x() = 0;
        return {target - way, target + way};
    }
    /// Level, a unit or a few over the top of a hill.
    Ray top() {
        for (;;) {
            const int i = inner(), j = inner();
            Vec3 target = terrain_.corner(i, j);
            bool is_top = true;
            for (int k = 0; k < 9; ++k)
                is_top = is_top && (k == 4 || terrain_.corner(i + k % 3 - 1, j + k / 3 - 1).y() < target.y());
            if (!is_top) continue;
            target.y() += terrain_.unit() * static_cast<float>(1 + below(4));
            const Vec3 way = terrain_.rounded({2 * random_() - 1, 0, 2 * random_() - 1});
            return {target - way, target + way};
        }
    }
    /// Down, anywhere.
    Ray anywhere() {
        const Vec3 a = terrain_.corner(inner(), inner());
        const Vec3 target = a + terrain_.rounded({2 * random_(), 0, 2 * random_()}), way = down();
        return {target - way, target + way};
    }
    /// Straight down for 1.1 m, from 0.6 above the ground: a wheel's.
    Ray wheel() {
        const Vec3 at = terrain_.corner(inner(), inner()) + Vec3(2 * random_(), 0.6f, 2 * random_());
        return {at, at - Vec3(0, 1.1f, 0)};
    }

  private:
    int below(int count) { return static_cast<int>(random_() * static_cast<float>(count)); }
    int inner() { return 2 + below(Terrain::k_size - 4); }
    Vec3 down() { return terrain_.rounded({random_() - 0.5f, -2 - random_(), random_() - 0.5f}); }

    const Terrain& terrain_;
    show::Random random_;
};

struct Kind {
    std::string_view name;
    Ray (Aims::*make)();
};
constexpr Kind k_kinds[] = {{"through a vertex", &Aims::vertex},
                            {"through an edge", &Aims::edge},
                            {"past an edge by a hair", &Aims::beside_edge},
                            {"beside the border, by a hair", &Aims::beside},
                            {"over a hilltop, by a hair", &Aims::top},
                            {"anywhere, down", &Aims::anywhere}};
constexpr std::string_view k_two_steps = "two steps that meet in a vertex";

}  // namespace

Rays cast_rays(Terrain& terrain, std::size_t count) {
    btBvhTriangleMeshShape bullets_shape(&terrain.triangles(), true);
    PierceShape pierce_shape(terrain.mesh(), &terrain.triangles());
    World bullets_world(bullets_shape), pierce_world(pierce_shape);
    btDefaultVehicleRaycaster bullets_own(&bullets_world.dynamics), through_shape(&pierce_world.dynamics);
    PierceRaycaster ours(terrain.mesh(), bullets_world.ground);
    const std::array<btVehicleRaycaster*, caster_count> casters = {&bullets_own, &ours, &through_shape};
    using Result = btVehicleRaycaster::btVehicleRaycasterResult;
    const auto cast = [&](std::size_t caster, const Ray& ray, Result& result) {
        return casters[caster]->castRay(to_bullet(ray.first), to_bullet(ray.second), result) != nullptr;
    };
    const auto is_of = [](const Result& result, const std::vector<Vec3>& normals) {
        const Vec3 normal = to_pierce(result.m_hitNormalInWorld);
        // Neighbours' normals differ by more; those of one face in Bullet and here, by rounding only.
        return std::ranges::any_of(normals, [&](const Vec3& n) { return (n - normal).norm() < 1e-4f; });
    };

    Rays rays;
    Aims aims(terrain);
    for (const Kind& kind : k_kinds) {
        Row& row = rays.rows.emplace_back(Row{.aim = kind.name, .rays = count});
        for (std::size_t i = 0; i < count; ++i) {
            const Ray ray = (aims.*kind.make)();
            const std::vector<Vec3> normals = terrain.passed(ray.first, ray.second);
            for (std::size_t caster = 0; caster < caster_count; ++caster) {
                Count& wrong = row.counts[caster];
                const std::size_t before = wrong.wrong();
                Result result;
                if (!cast(caster, ray, result))
                    wrong.missed += normals.empty() ? 0U : 1U;
                else if (normals.empty())
                    ++wrong.ghosts;
                else if (!is_of(result, normals))
                    ++wrong.faces;
                if (caster == bullet && wrong.wrong() > before) rays.wrong.push_back(0.5f * (ray.first + ray.second));
            }
        }
    }
    // A step that ends on the ground and one that goes on from there: one of them has to be stopped.
    Row& row = rays.rows.emplace_back(Row{.aim = k_two_steps, .rays = count});
    for (std::size_t i = 0; i < count; ++i) {
        const auto [from, to] = aims.vertex();
        const Vec3 middle = 0.5f * (from + to);
        Result result;
        for (std::size_t caster = 0; caster < caster_count; ++caster)
            row.counts[caster].missed +=
                cast(caster, {from, middle}, result) || cast(caster, {middle, to}, result) ? 0U : 1U;
    }

    std::vector<Ray> wheels(count);
    for (Ray& ray : wheels) ray = aims.wheel();
    using Clock = std::chrono::steady_clock;
    for (int turn = 0; turn < 5; ++turn)  // the least of five, in turns
        for (std::size_t caster = 0; caster < caster_count; ++caster) {
            const auto start = Clock::now();
            std::size_t hits = 0;
            Result result;
            for (const Ray& ray : wheels) hits += cast(caster, ray, result) ? 1U : 0U;
            const std::chrono::duration<double, std::nano> taken = Clock::now() - start;
            const double each = taken.count() / static_cast<double>(count);
            if (hits > 0 && (turn == 0 || each < rays.nanoseconds[caster])) rays.nanoseconds[caster] = each;
        }
    return rays;
}

void print(std::ostream& out, const Rays& rays) {
    const auto line = [&out](std::string_view name, const auto&... columns) {
        out << std::left << std::setw(34) << name << std::right;
        ((out << std::setw(14) << columns), ...);
        out << '\n';
    };
    line("rays", "of each kind", "Bullet misses", "ghost hits", "wrong faces", "pierce: wrong", "in its shape");
    for (const Row& row : rays.rows) {
        const auto& [theirs, ours, in_shape] = row.counts;
        line(row.aim, row.rays, theirs.missed, theirs.ghosts, theirs.faces, ours.wrong(), in_shape.wrong());
    }
    out << std::fixed << std::setprecision(0) << "a wheel's ray takes: Bullet " << rays.nanoseconds[bullet]
        << " ns, pierce " << rays.nanoseconds[raycaster] << " ns, pierce as a shape in Bullet's world "
        << rays.nanoseconds[shape] << " ns\n"
        << std::defaultfloat;
}

std::size_t pierce_errors(const Rays& rays) {
    std::size_t errors = 0;
    for (const Row& row : rays.rows)
        for (const Caster caster : {raycaster, shape}) errors += row.counts[caster].wrong();
    return errors;
}

}  // namespace bullet_physics
