// The boxes that are shown are those that a query opens: as many as the counters say, up to rounding, and each triangle
// that is hit lies in a cluster's box.
#include <cmath>

#include <gtest/gtest.h>
#include <pierce/visits.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

template <class Scalar>
class Visits : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Visits, Scalars);

TYPED_TEST(Visits, are_what_queries_open) {
    using Scalar = TypeParam;
    for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
        const auto soup = moved<Scalar>(bumpy_sphere(30), 3, Vec3<double>(5, -2, 1));
        const CollisionMesh<Scalar> mesh(soup.view(), {.broadphase = broadphase});
        Random random(7);
        std::size_t nodes = 0, clusters = 0;
        QueryCounters counters;
        for (int i = 0; i < 300; ++i) {
            const Vec3<double> middle(5, -2, 1);
            const Segment<Scalar> segment = {(middle + 6 * random.in_cube()).template cast<Scalar>(),
                                             (middle + 6 * random.in_cube()).template cast<Scalar>()};
            const auto boxes = visited_boxes(mesh, segment);
            double last = 0;
            for (const VisitedBox& box : boxes) {
                (box.is_cluster ? clusters : nodes) += 1;
                ASSERT_LE(last, box.fraction) << "in the order in which the segment comes to them";
                last = box.fraction;
            }
            if (boxes.empty()) {  // the query opens the root, and nothing in it
                ASSERT_FALSE(mesh.any_hit(segment, {.sides = Sides::both}));
                continue;
            }
            std::vector<Hit<Scalar>> hits(mesh.all_hits(segment, {}, {.sides = Sides::both, .counters = &counters}));
            mesh.all_hits(segment, hits, {.sides = Sides::both});
            for (const Hit<Scalar>& hit : hits) {
                const auto holds_it = [&](const VisitedBox& box) {
                    if (!box.is_cluster) return false;
                    for (const std::uint32_t corner : soup.triangles[hit.triangle]) {
                        const Vec3<double> p = soup.positions[corner].template cast<double>();
                        if ((p.array() < box.low.array() - 1e-6).any() || (p.array() > box.high.array() + 1e-6).any())
                            return false;
                    }
                    return true;
                };
                ASSERT_TRUE(std::ranges::any_of(boxes, holds_it)) << "face " << hit.face;
            }
            const auto first = mesh.first_hit(segment, {.sides = Sides::both});
            if (!first) continue;
            for (const VisitedBox& box : visited_boxes(mesh, segment, double(first->exact_fraction)))
                ASSERT_LE(box.fraction, double(first->exact_fraction));
        }
        if (broadphase == Broadphase::grid) {
            EXPECT_EQ(nodes, 0U);
            EXPECT_GT(clusters, 300U);
        } else {
            const auto as_many = [](std::size_t shown, std::uint64_t opened) {
                return std::abs(double(shown) - double(opened)) <= 0.01 * double(opened) + 1;
            };
            EXPECT_TRUE(as_many(nodes, counters.nodes)) << nodes << " nodes, opened " << counters.nodes;
            EXPECT_TRUE(as_many(clusters, counters.clusters)) << clusters << " clusters, opened " << counters.clusters;
        }
    }
}

TYPED_TEST(Visits, of_nothing_are_none) {
    using Scalar = TypeParam;
    const Vec3<Scalar> origin(0, 0, 0), far(9, 9, 9), nan(NAN, 0, 0);
    EXPECT_TRUE(visited_boxes(CollisionMesh<Scalar>(), {origin, far}).empty());
    const CollisionMesh<Scalar> mesh(moved<Scalar>(bumpy_sphere(10), 1, Vec3<double>(0, 0, 0)).view());
    EXPECT_TRUE(visited_boxes(mesh, {nan, far}).empty());
    EXPECT_TRUE(visited_boxes(mesh, {far, Vec3<Scalar>(8, 9, 9)}).empty());
    EXPECT_FALSE(visited_boxes(mesh, {origin, far}).empty());
}

}  // namespace
}  // namespace pierce::test
