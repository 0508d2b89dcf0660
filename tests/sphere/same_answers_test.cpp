// The same bits from tree and grid, from all triangles one after the other, and from batches.
#include <cstring>

#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <support/executors.h>
#include <support/sphere_cases.h>

#include <query/sphere_place.h>

namespace pierce::test {
namespace {

template <class Scalar>
bool same(const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
    return std::memcmp(&x, &y, sizeof x) == 0;
}

/// The same question without a broadphase: all triangles are looked at, for the hit and for each way to a center.
template <class Scalar>
struct Naive {
    detail::Scene<Scalar> scene;

    explicit Naive(const MeshView<Scalar>& view) : scene(detail::make_scene(view, BuildOptions{})) {}

    void compare(const SphereCase<Scalar>& c, const std::optional<SphereHit<Scalar>>& hit) const {
        const detail::Path path = detail::to_path(c.step);
        const auto r = static_cast<double>(c.radius);
        if (path.from == path.to) return;
        const double reach = detail::sphere_reach(scene, path.from, r);
        const detail::Sphere sphere(path, r, reach);
        QueryCounters counters;
        const QueryOptions options;
        const detail::SphereQuery<Scalar> query{scene, options, counters};
        detail::FirstEntry<Scalar> first(query, sphere, 1);
        detail::Shortlist none;
        none.complete = false;
        scene.each_triangle([&](detail::TriangleRef triangle) { first.test(triangle); });
        ASSERT_EQ(first.found(), hit.has_value());
        if (!hit) return;
        EXPECT_EQ(first.best().number, hit->triangle);
        EXPECT_EQ(detail::rounded_down<Scalar>(first.best().time), hit->fraction);
        std::uint64_t retreats = 0;
        const detail::SphereWays<Scalar> ways{query, sphere, reach, 0, none};
        const detail::Point center = detail::place_sphere(ways, first.best(), retreats);
        EXPECT_EQ(center, detail::to_point(hit->center.vec()));
    }
};

template <class Scalar>
void compare(int cases) {
    Random random(11);
    for (const TriangleSoup<double>& unit :
         {polycube(4, 0.5, 1, 3), terrain(24, 0.2, 5), shards(400, 4), bumpy_sphere(10)}) {
        const double offset = random.chance(0.5) ? 0 : 1000;
        const TriangleSoup<Scalar> soup = moved<Scalar>(unit, 1, {offset, -offset, offset});
        const CollisionMesh<Scalar> tree(soup.view(), {.broadphase = Broadphase::tree});
        const CollisionMesh<Scalar> grid(soup.view(), {.broadphase = Broadphase::grid});
        const Naive<Scalar> naive(soup.view());
        std::vector<Segment<Scalar>> steps;
        std::vector<Scalar> radii;
        std::vector<std::optional<SphereHit<Scalar>>> hits;
        std::size_t count = 0;
        for (int i = 0; i < cases; ++i) {
            SphereCase<Scalar> c = any_sphere_case(soup, random, random.chance(0.5) ? 1 : 0.1);
            if (random.chance(0.05)) c.step.to = c.step.from + Scalar(1e9) * (c.step.to - c.step.from);
            if (random.chance(0.05)) c.step.from = c.step.to + Scalar(1e9) * (c.step.from - c.step.to);
            const auto hit = tree.sweep_sphere(c.step, c.radius);
            const auto other = grid.sweep_sphere(c.step, c.radius);
            ASSERT_EQ(hit.has_value(), other.has_value());
            ASSERT_TRUE(!hit || same(*hit, *other));
            naive.compare(c, hit);
            if (::testing::Test::HasFailure()) {
                std::printf("case %d radius %a from %a %a %a to %a %a %a\n", i, double(c.radius),
                            double(c.step.from[0]), double(c.step.from[1]), double(c.step.from[2]),
                            double(c.step.to[0]), double(c.step.to[1]), double(c.step.to[2]));
                return;
            }
            if (i % 8 == 0) {
                std::array<SphereHit<Scalar>, 8> of_tree, of_grid;
                const std::size_t in_all = tree.sphere_hits(c.step, c.radius, of_tree);
                ASSERT_EQ(in_all, grid.sphere_hits(c.step, c.radius, of_grid));
                for (std::size_t k = 0; k < std::min(in_all, of_tree.size()); ++k)
                    ASSERT_TRUE(same(of_tree[k], of_grid[k]));
                const std::size_t resting = tree.sphere_contacts(c.step.to, c.radius, of_tree);
                ASSERT_EQ(resting, grid.sphere_contacts(c.step.to, c.radius, of_grid));
                for (std::size_t k = 0; k < std::min(resting, of_tree.size()); ++k)
                    ASSERT_TRUE(same(of_tree[k], of_grid[k]));
            }
            steps.push_back(c.step);
            radii.push_back(c.radius);
            hits.push_back(hit);
            count += std::size_t{hit.has_value()};
        }
        std::vector<std::optional<SphereHit<Scalar>>> out(steps.size());
        for (const Executor& executor : {Executor(), Executor(Reversed()), Executor(Threads())}) {
            QueryCounters counters;
            EXPECT_EQ(tree.sweep_spheres(steps, std::span<const Scalar>(radii), out, {.counters = &counters}, executor),
                      count);
            EXPECT_EQ(counters.queries, steps.size());
            for (std::size_t i = 0; i < steps.size(); ++i) {
                ASSERT_EQ(out[i].has_value(), hits[i].has_value());
                ASSERT_TRUE(!out[i] || same(*out[i], *hits[i]));
            }
        }
        tree.sweep_spheres(steps, radii[0], out);
        for (std::size_t i = 0; i < steps.size(); i += 10) {
            const auto single = tree.sweep_sphere(steps[i], radii[0]);
            ASSERT_EQ(out[i].has_value(), single.has_value());
            ASSERT_TRUE(!single || same(*single, *out[i]));
        }
        EXPECT_THROW(tree.sweep_spheres(steps, radii[0], std::span(out).first(1)), std::invalid_argument);
        EXPECT_THROW(tree.sweep_spheres(steps, std::span<const Scalar>(radii).first(1), out), std::invalid_argument);
        EXPECT_GT(count, steps.size() / 3);
    }
}

TEST(SphereAnswers, AreTheSameHoweverTheyAreFoundFloat) { compare<float>(600); }
TEST(SphereAnswers, AreTheSameHoweverTheyAreFoundDouble) { compare<double>(400); }

}  // namespace
}  // namespace pierce::test
