// Deforming meshes in a world: their state at the end of a step takes no build, and the loop that world.h gives for
// what is met on the way leaks nothing.
#include <cmath>

#include <gtest/gtest.h>
#include <pierce/deforming_mesh.h>
#include <world/naive_world.h>

#include <support/meshes.h>

namespace pierce::test {
namespace {

template <class Scalar>
class DeformingWorld : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DeformingWorld, Scalars);

template <class Scalar>
std::vector<Vec3<Scalar>> beating(const TriangleSoup<double>& rest, double time) {
    std::vector<Vec3<Scalar>> out;
    for (const Vec3<double>& p : rest.positions)
        out.push_back(
            ((1 + 0.2 * std::sin(3 * time) + 0.1 * std::sin(7 * time + 2 * p[0])) * p).template cast<Scalar>());
    return out;
}

template <class Scalar>
std::shared_ptr<const CollisionMesh<Scalar>> state_after(const DeformationStep<Scalar>& step) {
    const auto kept = std::make_shared<const DeformationStep<Scalar>>(step);
    return {kept, &kept->after()};
}

/// The loop of world.h. False: `at` stays, and nothing is verified.
template <class Scalar>
bool go(const World<Scalar>& world, std::uint32_t still, const DeformationStep<Scalar>& step, Vec3<Scalar>& at,
        const Vec3<Scalar>& to) {
    const auto clear = [&](const Vec3<Scalar>& place) {
        return !world.any_hit({at, place}, {.mask = still}) && !step.any_hit({at, place}, {.sides = Sides::both});
    };
    std::vector<std::pair<Scalar, Vec3<Scalar>>> places;
    for (const Vec3<Scalar>& target : {to, at}) {
        const std::size_t first = places.size();
        if (const auto hit = world.first_hit({at, target}, {.mask = still}))
            places.emplace_back(hit->hit.fraction, hit->hit.point.vec());
        if (const auto hit = step.sweep({at, target}, {.sides = Sides::both}))
            places.emplace_back(hit->time, hit->place.vec());
        if (places.size() == first) places.emplace_back(Scalar(1), target);
        std::sort(places.begin() + static_cast<std::ptrdiff_t>(first), places.end(),
                  [](const auto& x, const auto& y) { return x.first < y.first; });
    }
    for (const auto& [time, place] : places) {
        if (!clear(place)) continue;
        at = place;
        return true;
    }
    return false;
}

TYPED_TEST(DeformingWorld, nothing_leaks_between_what_deforms_and_what_stands) {
    using Scalar = TypeParam;
    constexpr std::uint32_t k_still = 1;
    constexpr std::uint32_t k_moves = 2;
    Random random(31);
    const TriangleSoup<double> rest = moved<double>(bumpy_sphere(6), 3, {0, 0, 0});
    TriangleSoup<Scalar> shell;
    shell.positions = beating<Scalar>(rest, 0);
    shell.triangles = rest.triangles;
    DeformingMesh<Scalar> moving(shell.view());
    World<Scalar> world;
    const MeshId skin = world.add(state_after(moving.step()), {.layers = k_moves});
    const auto cube = shared_mesh(moved<Scalar>(polycube(1, 1, 1, 1), 1, {-0.5, -0.5, -0.5}));
    std::vector<MeshId> cubes;
    for (int i = 0; i < 6; ++i) {
        InstanceOptions<Scalar> options;
        options.pose.translation = (1.2 * random.in_cube()).template cast<Scalar>();
        options.pose.rotation = rotation_of<Scalar>(2, random.between_ints(-3, 3), random.between_ints(-3, 3), 1);
        options.layers = k_still;
        cubes.push_back(world.add(cube, options));
    }
    // Between the shell and the cubes. The shell's faces look outwards, so it is met from behind.
    const auto is_between = [&](const Vec3<Scalar>& p) {
        return world.winding_number(p, {.mask = k_moves}) == 1 && !world.contains(p, {.mask = k_still});
    };
    std::vector<Vec3<Scalar>> particles;
    while (particles.size() < 40) {
        const Vec3<Scalar> p = (3 * random.in_cube()).template cast<Scalar>();
        if (is_between(p)) particles.push_back(p);
    }
    std::size_t stopped = 0;
    std::size_t squeezed = 0;
    for (int s = 1; s <= 120; ++s) {
        moving.begin_step(beating<Scalar>(rest, 0.05 * s));
        const DeformationStep<Scalar> step = moving.step();
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const Vec3<double> way = i % 4 == 0 ? Vec3<double>(0, 0, 0) : Vec3<double>(0.4 * random.in_cube());
            const Vec3<Scalar> to = (particles[i].template cast<double>() + way).template cast<Scalar>();
            if (!go(world, k_still, step, particles[i], to)) {
                // Between a cube and the shell: it is taken out of the game.
                ++squeezed;
                particles[i] = {0, 0, Scalar(100)};
            }
            if (particles[i] != to) ++stopped;
        }
        world.replace(skin, state_after(step));
        for (const Vec3<Scalar>& p : particles) ASSERT_TRUE(p[2] == 100 || is_between(p)) << "step " << s;
    }
    std::cout << stopped << " stopped, " << squeezed << " squeezed\n";
    EXPECT_GT(stopped, 300U);
    EXPECT_LT(squeezed, 10U);
    // The world keeps the state that it was given, whatever the mesh goes on to.
    const auto before = world.all_hits({{0, 0, 0}, {9, 1, 1}}, {}, {.sides = Sides::both, .mask = k_moves});
    for (int s = 0; s < 5; ++s) moving.begin_step(beating<Scalar>(rest, s));
    EXPECT_EQ(world.all_hits({{0, 0, 0}, {9, 1, 1}}, {}, {.sides = Sides::both, .mask = k_moves}), before);
    EXPECT_TRUE(world.mesh(skin) != nullptr && world.mesh(skin)->statistics().triangles == rest.triangles.size());
}

}  // namespace
}  // namespace pierce::test
