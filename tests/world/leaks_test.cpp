// Particles in closed meshes that are turned and moved, and overlap: none gets out, whatever they do. CGAL's exact
// predicates on the local images are the judge.
#include <algorithm>

#include <gtest/gtest.h>
#include <pierce/world.h>
#include <support/inside_oracle.h>
#include <support/meshes.h>
#include <world/naive_world.h>

namespace pierce::test {
namespace {

template <class Scalar>
struct Pen {
    TriangleSoup<Scalar> soup;
    InsideOracle<Scalar> oracle;
    std::shared_ptr<const CollisionMesh<Scalar>> mesh;

    explicit Pen(const TriangleSoup<Scalar>& of) : soup(of), oracle(of), mesh(shared_mesh(of)) {}
};

struct Outcome {
    std::size_t steps = 0;
    std::size_t hits = 0;
    std::size_t stayed = 0;
    std::size_t leaks = 0;
    std::size_t hit_pens = 0;
};

// Several pens around one place, each turned otherwise: a particle is in all of them, and has to stay so. It goes on at
// random, flies into corners, slides along faces, and aims at what it came to last.
template <class Scalar>
Outcome walk(std::size_t pens, double offset, std::uint64_t seed, std::size_t particles, std::size_t steps) {
    const Pen<Scalar> smooth(moved<Scalar>(bumpy_sphere(6), 10, {0, 0, 0}));
    const Pen<Scalar> bowl_shaped(moved<Scalar>(bowl(5), 12, {0, 0, 0}));
    const Pen<Scalar> cube(moved<Scalar>(polycube(1, 1, 18, 1), 1, {-9, -9, -9}));
    const std::array<const Pen<Scalar>*, 3> kinds{&smooth, &bowl_shaped, &cube};
    Random random(seed);
    World<Scalar> world;
    std::vector<std::pair<MeshId, const Pen<Scalar>*>> members;
    const Vec3<double> centre(offset, -offset, offset);
    for (std::size_t i = 0; i < pens; ++i) {
        InstanceOptions<Scalar> options;
        options.pose.rotation =
            rotation_of<Scalar>(1 + static_cast<int>(i), random.between_ints(-5, 5), random.between_ints(-5, 5), 3);
        options.pose.translation = (centre + 1.5 * random.in_cube()).template cast<Scalar>();
        const Pen<Scalar>* kind = kinds[(i + seed) % 3];
        members.emplace_back(world.add(kind->mesh, options), kind);
    }
    const WorldOptions options{.sides = Sides::back};
    Outcome outcome;
    std::vector<bool> met(pens);
    for (std::size_t p = 0; p < particles; ++p) {
        Vec3<Scalar> position = (centre + 0.5 * random.in_cube()).template cast<Scalar>();
        for (const auto& [id, pen] : members) EXPECT_FALSE(pen->oracle.outside(world.to_mesh(id, position)));
        std::optional<WorldHit<Scalar>> last;
        Vec3<double> velocity = random.direction();
        for (std::size_t step = 0; step < steps; ++step) {
            ++outcome.steps;
            Vec3<double> to = position.template cast<double>();
            const double kind = random.unit();
            const double length = std::exp(random.between(-8, 3.5));
            if (kind < 0.4 || !last) {
                to += length * velocity;
            } else if (kind < 0.6) {
                to += length * random.direction();
            } else if (kind < 0.8) {  // along the face
                const Vec3<double> n = last->hit.normal.template cast<double>();
                const Vec3<double> way = length * random.direction();
                to += way - way.dot(n) * n;
            } else {  // to a corner of it
                const auto& soup = members[last->mesh.index].second->soup;
                const IndexTriple& t = soup.triangles[last->hit.triangle];
                to = world.to_world(last->mesh, soup.positions[t[random.below(3)]]).template cast<double>();
            }
            const Vec3<Scalar> end = to.template cast<Scalar>();
            if (const auto hit = world.first_hit({position, end}, options)) {
                ++outcome.hits;
                if (hit->hit.point.vec() == position && !hit->hit.at_start) ++outcome.stayed;
                position = hit->hit.point;
                const Vec3<double> n = hit->hit.normal.template cast<double>();
                velocity -= 2 * velocity.dot(n) * n;
                met[hit->mesh.index] = true;
                last = hit;
            } else {
                position = end;
            }
            if (step % 16 != 0 && step + 1 != steps) continue;
            for (const auto& [id, pen] : members)
                if (pen->oracle.outside(world.to_mesh(id, position))) ++outcome.leaks;
        }
    }
    outcome.hit_pens = static_cast<std::size_t>(std::count(met.begin(), met.end(), true));
    return outcome;
}

template <class Scalar>
void expect_none(std::size_t particles, std::size_t steps) {
    Outcome sum;
    std::size_t pens = 0;
    std::uint64_t seed = 0;
    for (const double offset : {0.0, 1e3, 1e5})
        for (const std::size_t count : {1U, 2U, 5U, 9U}) {
            const Outcome outcome = walk<Scalar>(count, offset, ++seed, particles, steps);
            EXPECT_EQ(outcome.leaks, 0U) << count << " pens at " << offset;
            sum.steps += outcome.steps;
            sum.hits += outcome.hits;
            sum.stayed += outcome.stayed;
            sum.hit_pens += outcome.hit_pens;
            pens += count;
        }
    std::cout << sum.steps << " steps, " << sum.hits << " hits, " << sum.stayed << " stayed at their start, "
              << sum.hit_pens << " of " << pens << " pens hit\n";
    EXPECT_GT(sum.hits, sum.steps / 10);
    EXPECT_GT(sum.hit_pens, pens / 2);
}

template <class Scalar>
class WorldLeaks : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldLeaks, Scalars);

TYPED_TEST(WorldLeaks, none_out_of_turned_pens) { expect_none<TypeParam>(10, 160); }

template <class Scalar>
class WorldLeaksSoak : public ::testing::Test {};
TYPED_TEST_SUITE(WorldLeaksSoak, Scalars);

TYPED_TEST(WorldLeaksSoak, none_in_a_million_steps) { expect_none<TypeParam>(100, 1000); }

// A closed mesh in boxes that a particle must not enter: many that overlap, so that it comes to corners of several.
TYPED_TEST(WorldLeaks, none_into_overlapping_obstacles) {
    using Scalar = TypeParam;
    const Pen<Scalar> cube(moved<Scalar>(polycube(1, 1, 2, 1), 1, {-1, -1, -1}));
    const Pen<Scalar> ball(moved<Scalar>(bumpy_sphere(3), 1, {0, 0, 0}));
    std::size_t hits = 0;
    std::size_t between = 0;
    for (const double offset : {0.0, 1e4}) {
        Random random(9);
        World<Scalar> world;
        std::vector<std::pair<MeshId, const Pen<Scalar>*>> members;
        const Vec3<double> centre(offset, offset, -offset);
        for (int i = 0; i < 60; ++i) {
            InstanceOptions<Scalar> options;
            options.pose.rotation = rotation_of<Scalar>(2, random.between_ints(-4, 4), random.between_ints(-4, 4), 1);
            options.pose.translation = (centre + 3 * random.in_cube()).template cast<Scalar>();
            const Pen<Scalar>* kind = i % 2 == 0 ? &cube : &ball;
            members.emplace_back(world.add(kind->mesh, options), kind);
        }
        const auto inside = [&](const Vec3<Scalar>& p) {
            for (const auto& [id, pen] : members)
                if (pen->oracle.side(world.to_mesh(id, p)) == CGAL::ON_BOUNDED_SIDE) return true;
            return false;
        };
        for (int p = 0; p < 60; ++p) {
            Vec3<Scalar> position = (centre + 6 * random.direction()).template cast<Scalar>();
            ASSERT_FALSE(inside(position));
            for (int step = 0; step < 60; ++step) {
                const Vec3<double> to = centre + 3 * random.in_cube();
                const Vec3<Scalar> end = to.template cast<Scalar>();
                const auto hit = world.first_hit({position, end});
                if (hit && hit->hit.point.vec() == position) ++between;
                if (hit) ++hits;
                position = hit ? hit->hit.point.vec() : end;
                ASSERT_FALSE(inside(position)) << p << ' ' << step;
            }
        }
    }
    std::cout << hits << " hits, " << between << " where nothing was nearer\n";
    EXPECT_GT(hits, 3000U);
}

}  // namespace
}  // namespace pierce::test
