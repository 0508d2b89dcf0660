// Rebuilds that keep clusters: answers are those of a fresh build whatever was kept, trees are about as good, and
// clusters are made anew where they are not.
#include <cmath>

#include <gtest/gtest.h>

#include <deform/deformations.h>
#include <pierce/collision_mesh.h>
#include <query/rebuild.h>
#include <query/standard_executor.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/hard_segments.h>
#include <tree/refit.h>

namespace pierce::test {
namespace {

using detail::count_of;
using detail::KeptClusters;
using detail::Scene;

template <class Scalar>
std::vector<Vec3<Scalar>> waving(const TriangleSoup<double>& rest, double time) {
    std::vector<Vec3<Scalar>> out;
    for (const Vec3<double>& p : rest.positions) {
        const double wave = 0.1 * std::sin(7 * p[0] + time) * std::cos(5 * p[1] - time);
        const double a = 0.05 * time * p[2];
        const Vec3<double> x = p * (1 + wave) + Vec3<double>(0.1 * time, 0, wave);
        out.push_back(
            Vec3<double>(std::cos(a) * x[0] - std::sin(a) * x[1], std::sin(a) * x[0] + std::cos(a) * x[1], x[2])
                .cast<Scalar>());
    }
    return out;
}

/// What a query may expect to go through.
template <class Scalar>
double cost_of(const Scene<Scalar>& scene) {
    const detail::TreeShape shape =
        shape_of(scene.tree, {scene.cluster_refs.data(), scene.cluster_refs.size()}, scene.clusters.empty);
    detail::TreeBoxes<Scalar> boxes(shape);
    for (std::size_t c = 0; c < shape.clusters.size(); ++c) {
        const detail::ClusterRef ref = boxes.clusters[c].ref = shape.clusters[c].ref;
        detail::QuadBox<Scalar> box;
        for (std::uint32_t lane = 0; lane < count_of(ref); ++lane)
            for (const detail::Point& x : scene.clusters.corners(ref, lane)) {
                const detail::Quad<Scalar> corner{static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]),
                                                  static_cast<Scalar>(x[2]), 0};
                box.add({corner, corner});
            }
        set_box(boxes.clusters[c], box);
    }
    unite_boxes(shape, boxes);
    return expected_cost(shape, boxes, scene.frame.unit);
}

template <class Scalar>
Scene<Scalar> scene_of(const TriangleSoup<double>& rest, const std::vector<Vec3<Scalar>>& positions) {
    return detail::make_scene(MeshView<Scalar>{positions, rest.triangles}, BuildOptions{});
}

template <class Scalar>
bool rebuild(Scene<Scalar>& scene, const std::vector<Vec3<Scalar>>& positions, KeptClusters& kept) {
    return detail::rebuild_on_clusters<Scalar>(scene, positions, BuildOptions{}, kept, {});
}

template <class Scalar>
class Rebuilds : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Rebuilds, Scalars);

TYPED_TEST(Rebuilds, KeepClustersWhileTheyAreGood) {
    using Scalar = TypeParam;
    for (const TriangleSoup<double>& rest : {bumpy_sphere(30), terrain(60, 0.3, 5)}) {
        Scene<Scalar> scene = scene_of(rest, waving<Scalar>(rest, 0));
        KeptClusters kept;
        int times = 0;
        for (int frame = 1; frame <= 7; ++frame) {
            const std::vector<Vec3<Scalar>> at = waving<Scalar>(rest, 0.05 * frame);
            if (!rebuild(scene, at, kept)) break;
            ++times;
            const Scene<Scalar> fresh = scene_of(rest, at);
            EXPECT_LT(cost_of(scene), 1.06 * cost_of(fresh)) << "frame " << frame;
            EXPECT_EQ(scene.frame.unit, fresh.frame.unit);
            EXPECT_EQ(scene.grain, fresh.grain);
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(scene.bounds.low[k], fresh.bounds.low[k]);
                EXPECT_EQ(scene.bounds.high[k], fresh.bounds.high[k]);
            }
        }
        EXPECT_EQ(times, 7);
        EXPECT_FALSE(rebuild(scene, waving<Scalar>(rest, 0.4), kept)) << "they are made anew at times";
    }
}

TYPED_TEST(Rebuilds, MakeTornAndFoldedClustersAnew) {
    using Scalar = TypeParam;
    // Each triangle with vertices of its own.
    const TriangleSoup<double> sphere = bumpy_sphere(30);
    TriangleSoup<double> rest;
    for (const IndexTriple& t : sphere.triangles) {
        const auto first = static_cast<std::uint32_t>(rest.positions.size());
        for (const std::uint32_t v : t) rest.positions.push_back(sphere.positions[v]);
        rest.triangles.push_back({first, first + 1, first + 2});
    }
    const std::vector<Vec3<Scalar>> at = waving<Scalar>(rest, 0);
    const auto kept = [&](const std::vector<Vec3<Scalar>>& positions) {
        Scene<Scalar> scene = scene_of(rest, at);
        KeptClusters none;
        return rebuild(scene, positions, none);
    };
    EXPECT_TRUE(kept(at));
    Random random(5);
    std::vector<Vec3<Scalar>> torn = at;
    for (std::size_t v = 0; v < torn.size(); v += 3) {
        const Vec3<Scalar> way = (0.05 * random.in_cube()).template cast<Scalar>();
        for (std::size_t k = 0; k < 3; ++k) torn[v + k] += way;
    }
    EXPECT_FALSE(kept(torn));
    // Triangles as large as clusters were.
    std::vector<Vec3<Scalar>> folded = at;
    for (Vec3<Scalar>& x : folded) x += (0.5 * random.in_cube()).template cast<Scalar>();
    EXPECT_FALSE(kept(folded));
    // One triangle without area: it has no place in a record.
    std::vector<Vec3<Scalar>> degenerate = at;
    degenerate[rest.triangles[700][0]] = degenerate[rest.triangles[700][1]];
    EXPECT_FALSE(kept(degenerate));
}

TYPED_TEST(Rebuilds, AnswerAsAFreshBuild) {
    using Scalar = TypeParam;
    const Threads threads;
    for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid})
        for (const TriangleSoup<double>& rest : {bumpy_sphere(30), terrain(40, 0.3, 5)}) {
            Random random(3);
            TriangleSoup<Scalar> soup = moved<Scalar>(rest, 1, {0, 0, 0});
            CollisionMesh<Scalar> mesh(soup.view(), {.broadphase = broadphase});
            for (int frame = 0; frame < 20; ++frame) {
                soup.positions = waving<Scalar>(rest, 0.05 * frame);
                // Some frames take the clusters apart, some make a refit of them.
                if (frame % 7 == 5) soup.positions = deformed<Scalar>(rest, random);
                if (frame % 4 == 1)
                    mesh.refit(soup.positions);
                else if (frame % 2 == 0)
                    mesh.rebuild(soup.positions);
                else
                    mesh.rebuild(soup.positions, std::cref(threads));
                const CollisionMesh<Scalar> fresh(soup.view(), {.broadphase = broadphase});
                ASSERT_EQ(mesh.statistics().degenerate, fresh.statistics().degenerate);
                const Extent<Scalar> extent(soup.view());
                for (int i = 0; i < 200; ++i) {
                    const Segment<Scalar> way =
                        i % 2 == 0 ? mixed_segment(soup.view(), extent, random)
                                   : hard_segment(soup.view(), extent, extent.diagonal() / 16 + 1e-30, random);
                    ASSERT_TRUE(same_answer(mesh.first_hit(way, {.sides = Sides::both}),
                                            fresh.first_hit(way, {.sides = Sides::both})))
                        << "frame " << frame << ": " << to_text(way);
                    ASSERT_EQ(mesh.crossings(way), fresh.crossings(way)) << to_text(way);
                }
            }
        }
}

}  // namespace
}  // namespace pierce::test
