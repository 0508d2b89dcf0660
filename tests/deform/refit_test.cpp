// A mesh that was given new positions answers as one that is built from them, to the last bit.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <deform/deformations.h>
#include <pierce/collision_mesh.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/hard_segments.h>
#include <support/naive.h>

namespace pierce::test {
namespace {

template <class Scalar>
void expect_same_answers(const CollisionMesh<Scalar>& mesh, const CollisionMesh<Scalar>& fresh,
                         const TriangleSoup<Scalar>& soup, int count, Random& random) {
    const MeshStatistics s = mesh.statistics();
    const MeshStatistics t = fresh.statistics();
    ASSERT_EQ(s.triangles, t.triangles);
    ASSERT_EQ(s.degenerate, t.degenerate);
    ASSERT_EQ(s.vertices, t.vertices);
    ASSERT_EQ(s.faces, t.faces);
    ASSERT_EQ(mesh.mesh_report().border_edges, fresh.mesh_report().border_edges);
    const Extent<Scalar> extent(soup.view());
    const NaiveMesh<Scalar> naive(soup.view());
    for (int i = 0; i < count; ++i) {
        const Segment<Scalar> way = i % 2 == 0
                                        ? mixed_segment(soup.view(), extent, random)
                                        : hard_segment(soup.view(), extent, extent.diagonal() / 16 + 1e-30, random);
        QueryOptions options;
        options.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
        const auto hit = mesh.first_hit(way, options);
        ASSERT_TRUE(same_answer(hit, fresh.first_hit(way, options))) << to_text(way);
        ASSERT_EQ(mesh.any_hit(way, options), hit.has_value());
        if (i % 8 == 0) {
            ASSERT_TRUE(same_answer(hit, naive.first_hit(way, options))) << to_text(way);
        }
        std::array<Hit<Scalar>, 4> some, expected;
        const std::size_t total = fresh.all_hits(way, expected, options);
        ASSERT_EQ(mesh.all_hits(way, some, options), total);
        for (std::size_t k = 0; k < std::min<std::size_t>(total, 4); ++k)
            ASSERT_TRUE(same_bits(some[k], expected[k])) << to_text(way);
        ASSERT_EQ(mesh.crossings(way), fresh.crossings(way)) << to_text(way);
        ASSERT_EQ(mesh.winding_number(way.from), fresh.winding_number(way.from));
        const IndexTriple& corners = soup.triangles[random.below(soup.triangles.size())];
        for (const Vec3<Scalar>& point : {way.from, soup.positions[corners[0]]}) {
            const Location here = mesh.locate(point), there = fresh.locate(point);
            ASSERT_EQ(here.place, there.place);
            ASSERT_EQ(here.face_count, there.face_count);
        }
        std::array<Passage<Scalar>, 4> passages, others;
        const std::size_t places = fresh.passages(way, others);
        ASSERT_EQ(mesh.passages(way, passages), places);
        for (std::size_t k = 0; k < std::min<std::size_t>(places, 4); ++k)
            ASSERT_EQ(bits(passages[k].fraction), bits(others[k].fraction));
        const Ray<Scalar> ray{way.from, way.to - way.from};
        ASSERT_TRUE(same_answer(mesh.first_hit(ray, options), fresh.first_hit(ray, options))) << to_text(way);
    }
}

// The vertices of `before` that are not at the same place in `after`, some of them twice.
template <class Scalar>
std::vector<std::uint32_t> changed_vertices(const std::vector<Vec3<Scalar>>& before,
                                            const std::vector<Vec3<Scalar>>& after) {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t v = 0; v < before.size(); ++v)
        if (before[v] != after[v]) changed.insert(changed.end(), 1 + v % 2, v);
    return changed;
}

template <class Scalar>
void compare_over_steps(const TriangleSoup<double>& rest, Broadphase broadphase, int steps, std::uint64_t seed) {
    Random random(seed);
    TriangleSoup<Scalar> soup = moved<Scalar>(rest, 1, {0, 0, 0});
    if (random.chance(0.5)) soup.positions = deformed<Scalar>(rest, random);  // not built in its best shape
    CollisionMesh<Scalar> mesh(soup.view(), {.broadphase = broadphase});
    const Threads threads;
    for (int step = 0; step < steps; ++step) {
        const std::vector<Vec3<Scalar>> before = soup.positions;
        soup.positions = deformed<Scalar>(rest, random);
        const std::size_t how = random.below(6);
        SCOPED_TRACE(testing::Message() << "step " << step << ", way " << how);
        if (how < 2) {
            mesh.refit(soup.positions);
        } else if (how == 2) {
            mesh.refit(soup.positions, std::cref(threads));
        } else if (how == 3) {
            mesh.rebuild(soup.positions);
            ASSERT_EQ(mesh.refit_cost(), 1);
        } else {
            // What is not named is not looked at.
            std::vector<Vec3<Scalar>> given = soup.positions;
            for (std::size_t v = 0; v < given.size(); ++v)
                if (before[v] == soup.positions[v]) given[v][0] = std::numeric_limits<Scalar>::quiet_NaN();
            mesh.refit(given, changed_vertices(before, soup.positions));
        }
        const CollisionMesh<Scalar> fresh(soup.view(), {.broadphase = broadphase});
        expect_same_answers(mesh, fresh, soup, 40, random);
        if (testing::Test::HasFatalFailure()) return;
        ASSERT_GT(mesh.refit_cost(), 0);
    }
}

template <class Scalar>
class Refits : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Refits, Scalars);

TYPED_TEST(Refits, AnswerAsAFreshBuild) {
    std::uint64_t seed = 1;
    for (const TriangleSoup<double>& rest : deforming_meshes())
        for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
            SCOPED_TRACE(testing::Message() << "mesh of " << rest.triangles.size());
            compare_over_steps<TypeParam>(rest, broadphase, broadphase == Broadphase::tree ? 30 : 12, ++seed);
            if (testing::Test::HasFatalFailure()) return;
        }
}

TYPED_TEST(Refits, AnswerAsAFreshBuildSoak) {
    for (std::uint64_t seed = 100; seed < 140; ++seed)
        for (const TriangleSoup<double>& rest : deforming_meshes()) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", mesh of " << rest.triangles.size());
            compare_over_steps<TypeParam>(rest, Broadphase::tree, 60, seed);
            if (testing::Test::HasFatalFailure()) return;
        }
}

// Small faces in a large scene: nodes have frames of their own (tree/encode.h).
TYPED_TEST(Refits, NodesWithFramesOfTheirOwn) {
    using Scalar = TypeParam;
    Random random(7);
    TriangleSoup<double> rest = moved<double>(bumpy_sphere(12), 0x1p-16, {0.3, 0.3, 0.3});
    append(rest, corner_triangle());
    TriangleSoup<Scalar> soup = moved<Scalar>(rest, 1, {0, 0, 0});
    CollisionMesh<Scalar> mesh(soup.view());
    for (int step = 0; step < 30; ++step) {
        const std::vector<Vec3<Scalar>> before = soup.positions;
        for (std::size_t v = 0; v < soup.positions.size(); ++v) {
            const Vec3<double> moved_to = rest.positions[v] + 0x1p-19 * random.in_cube();
            if (step % 3 != 0 || v % 5 == 0) soup.positions[v] = moved_to.cast<Scalar>();
            if (step % 4 == 1 && v < rest.positions.size() / 2) soup.positions[v] = rest.positions[0].cast<Scalar>();
        }
        if (step % 2 == 0)
            mesh.refit(soup.positions);
        else
            mesh.refit(soup.positions, changed_vertices(before, soup.positions));
        expect_same_answers(mesh, CollisionMesh<Scalar>(soup.view()), soup, 60, random);
        if (testing::Test::HasFatalFailure()) return;
    }
}

// A vertex at a time, in a tree of several levels: what is above its clusters has to follow.
TYPED_TEST(Refits, OneVertexOfMany) {
    using Scalar = TypeParam;
    Random random(8);
    TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(20), 1, {0, 0, 0});
    CollisionMesh<Scalar> mesh(soup.view());
    for (int step = 0; step < 60; ++step) {
        const auto v = static_cast<std::uint32_t>(random.below(soup.positions.size()));
        // Out of its node's box, but not of the frame; some out of that, too.
        const double size = random.chance(0.1) ? 4 : 0.3;
        const Vec3<Scalar> way = (size * random.in_cube()).template cast<Scalar>();
        soup.positions[v] += way;
        mesh.refit(soup.positions, std::span(&v, 1));
        const CollisionMesh<Scalar> fresh(soup.view());
        for (int i = 0; i < 30; ++i) {
            const Vec3<Scalar> aim = soup.positions[v] - Scalar(random.unit()) * way;
            const Vec3<Scalar> d = random.in_cube().template cast<Scalar>();
            const Segment<Scalar> through{aim - d, aim + d};
            ASSERT_TRUE(same_answer(mesh.first_hit(through, {.sides = Sides::both}),
                                    fresh.first_hit(through, {.sides = Sides::both})))
                << "step " << step;
        }
    }
}

TYPED_TEST(Refits, FaceNumbersStay) {
    using Scalar = TypeParam;
    TriangleSoup<Scalar> soup = moved<Scalar>(corner_triangle(), 1, {0, 0, 0});
    append(soup, moved<Scalar>(corner_triangle(), 1, {0, 0, -1}));
    const std::vector<std::uint32_t> faces{17, 5};
    CollisionMesh<Scalar> mesh(MeshView<Scalar>{soup.positions, soup.triangles, faces});
    const Segment<Scalar> down{{1, 1, 5}, {1, 1, -5}};
    EXPECT_EQ(mesh.first_hit(down)->face, 17U);
    for (std::size_t v = 0; v < 3; ++v) soup.positions[v][2] = -2;
    mesh.refit(soup.positions);
    EXPECT_EQ(mesh.first_hit(down)->face, 5U);
    for (std::size_t v = 0; v < 3; ++v) soup.positions[v][2] = 2;
    mesh.rebuild(soup.positions);
    EXPECT_EQ(mesh.first_hit(down)->face, 17U);
    EXPECT_EQ(mesh.first_hit(down)->triangle, 0U);
}

template <class Error, class Do>
std::string message_of(Do&& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TYPED_TEST(Refits, BadInputLeavesTheMeshAsItWas) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(4), 1, {0, 0, 0});
    CollisionMesh<Scalar> mesh(soup.view());
    std::vector<Vec3<Scalar>> positions = soup.positions;
    positions.pop_back();
    const auto refit = [&] { mesh.refit(positions); };
    EXPECT_EQ(message_of<std::invalid_argument>(refit), "refit: " + std::to_string(positions.size()) +
                                                            " positions and " + std::to_string(soup.positions.size()) +
                                                            " vertices");
    EXPECT_NE(message_of<std::invalid_argument>([&] { mesh.rebuild(positions); }), "nothing was thrown");
    positions = soup.positions;
    positions[3][1] = std::numeric_limits<Scalar>::quiet_NaN();
    const std::string nan = "vertex 3: its y coordinate is not finite";
    const std::vector<std::uint32_t> third{3}, wrong{7, static_cast<std::uint32_t>(positions.size())}, other{4};
    EXPECT_EQ(message_of<MeshError>(refit), nan);
    EXPECT_EQ(message_of<MeshError>([&] { mesh.rebuild(positions); }), nan);
    EXPECT_EQ(message_of<MeshError>([&] { mesh.refit(positions, third); }), nan);
    EXPECT_EQ(message_of<std::invalid_argument>([&] { mesh.refit(positions, wrong); }),
              "refit: no vertex " + std::to_string(wrong[1]) + " among " + std::to_string(wrong[1]));
    mesh.refit(positions, other);
    // Flat, and far away beside its size.
    for (Vec3<Scalar>& x : positions) x = {std::numeric_limits<Scalar>::max() / 4, x[1], x[2]};
    positions[3][1] = 0;
    for (Vec3<Scalar>& x : positions)
        for (int k = 1; k < 3; ++k) x[k] = std::round(x[k] * 16) / 16 * std::numeric_limits<Scalar>::min() * 0x1p20F;
    EXPECT_NE(message_of<MeshError>([&] {
                  CollisionMesh<Scalar>(MeshView<Scalar>{positions, soup.triangles});
              }),
              "nothing was thrown");
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < positions.size(); ++v) all.push_back(v);
    EXPECT_NE(message_of<MeshError>(refit), "nothing was thrown");
    const Segment<Scalar> through{{2, Scalar(0.1), Scalar(0.2)}, {-2, 0, 0}};
    EXPECT_TRUE(same_answer(mesh.first_hit(through), CollisionMesh<Scalar>(soup.view()).first_hit(through)));
    EXPECT_NE(message_of<MeshError>([&] { mesh.refit(positions, all); }), "nothing was thrown");
    EXPECT_NE(message_of<MeshError>([&] { mesh.rebuild(positions); }), "nothing was thrown");
    Random random(3);
    expect_same_answers(mesh, CollisionMesh<Scalar>(soup.view()), soup, 200, random);
}

TYPED_TEST(Refits, MeshesWithoutTriangles) {
    using Scalar = TypeParam;
    CollisionMesh<Scalar> none;
    none.refit(PointsView<Scalar>{});
    none.rebuild(PointsView<Scalar>{});
    const std::vector<Vec3<Scalar>> one{{1, 2, 3}};
    EXPECT_THROW(none.refit(one), std::invalid_argument);
    EXPECT_EQ(none.statistics().bytes, 0U);
    EXPECT_EQ(none.refit_cost(), 1);
    // Without area at first, then with, and back; by all vertices and by some.
    for (const bool all : {true, false}) {
        std::vector<Vec3<Scalar>> p(3, Vec3<Scalar>(1, 1, 1));
        const std::vector<IndexTriple> triangle{{0, 1, 2}};
        CollisionMesh<Scalar> mesh(MeshView<Scalar>{p, triangle});
        const std::vector<std::uint32_t> changed{0, 1, 2};
        const auto move = [&](Scalar size) {
            p = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
            if (all)
                mesh.refit(p);
            else
                mesh.refit(p, changed);
        };
        const Segment<Scalar> down{{0.25, 0.25, 1}, {0.25, 0.25, -1}};
        for (int i = 0; i < 3; ++i) {
            EXPECT_FALSE(mesh.any_hit(down));
            EXPECT_EQ(mesh.statistics().degenerate, 1U);
            move(2);
            EXPECT_TRUE(mesh.any_hit(down));
            EXPECT_EQ(mesh.statistics().degenerate, 0U);
            move(3);
            EXPECT_TRUE(mesh.any_hit(down));
            move(0);
        }
    }
}

TYPED_TEST(Refits, CostSaysHowFarTheShapeIsLeft) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(12), 1, {0, 0, 0});
    CollisionMesh<Scalar> mesh(soup.view());
    mesh.refit(soup.positions);
    EXPECT_EQ(mesh.refit_cost(), 1);
    std::vector<Vec3<Scalar>> p = soup.positions;
    for (Vec3<Scalar>& x : p) x *= 8;
    mesh.refit(p);
    EXPECT_EQ(mesh.refit_cost(), 1);  // powers of two change nothing
    Random random(5);
    for (std::size_t i = p.size(); i > 1; --i) std::swap(p[i - 1], p[random.below(i)]);
    mesh.refit(p);
    EXPECT_GT(mesh.refit_cost(), 3);
    EXPECT_GT(mesh.statistics().bytes, CollisionMesh<Scalar>(soup.view()).statistics().bytes);
    mesh.rebuild(p);
    EXPECT_EQ(mesh.refit_cost(), 1);
}

}  // namespace
}  // namespace pierce::test
