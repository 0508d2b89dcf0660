// Every reason, and every edge named, is that of rational arithmetic on each face by itself.
//
// The tests of small cases never had a face with the segment wholly behind it, nor one passed from its back outside of
// an edge, nor one passed beyond a corner, outside of two edges at once: code that never said `behind`, took the wrong
// sign for backs or named the higher of two edges passed them.
#include <map>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/boxes.h>
#include <support/oracles.h>
#include <support/pairs.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// What explain() must say of a face that is alone.
FaceVerdict expected(const Pair& pair, Sides sides) {
    FaceVerdict verdict{0, 0, Reason::first_hit};
    const RationalOracle exact(pair.path, pair.corners);
    const int from = CGAL::sign(exact.from_side());
    const int to = CGAL::sign(exact.to_side());
    const bool front = from >= 0 && to < 0;
    const bool back = sides == Sides::both ? from < 0 && to >= 0 : from <= 0 && to > 0;
    if (exact.zero_area()) verdict.reason = Reason::zero_area;
    else if (from == 0 && to == 0) verdict.reason = Reason::in_plane;
    else if (from >= 0 && to >= 0 && !back) verdict.reason = Reason::in_front;
    else if (from <= 0 && to <= 0 && !front && !back) verdict.reason = Reason::behind;
    else if ((front && sides == Sides::back) || (back && sides == Sides::front)) verdict.reason = Reason::wrong_side;
    else
        for (std::size_t edge = 0; edge < 3; ++edge)
            if (exact.weight((edge + 2) % 3) < 0) {
                verdict.reason = Reason::outside_edge;
                verdict.edge = static_cast<std::uint8_t>(edge);
                break;
            }
    return verdict;
}

TEST(ExplainReasons, are_those_of_rational_arithmetic) {
    Random random(31);
    std::map<Reason, int> said;
    int backs = 0;
    int corners = 0;
    for (int i = 0; i < 30'000; ++i) {
        const auto family = static_cast<Family>(random.below(k_family_names.size()));
        const Pair pair = make_pair_of<double>(family, 1, random.chance(0.5) ? 0 : 1e3, random);
        const auto vec = [](const detail::Point& p) { return V(p[0], p[1], p[2]); };
        const std::vector<V> positions = {vec(pair.corners[0]), vec(pair.corners[1]), vec(pair.corners[2])};
        const std::vector<IndexTriple> triangles = {{0, 1, 2}};
        const CollisionMesh<double> mesh({positions, triangles});
        for (const Sides sides : {Sides::front, Sides::back, Sides::both}) {
            const auto verdicts = mesh.explain({vec(pair.path.from), vec(pair.path.to)}, {.sides = sides});
            if (boxes_apart(pair.path, pair.corners)) {
                ASSERT_TRUE(verdicts.empty() || verdicts[0].reason == Reason::apart ||
                            verdicts[0].reason == Reason::zero_area);
                continue;
            }
            const FaceVerdict truth = expected(pair, sides);
            ASSERT_EQ(verdicts.size(), 1U) << describe(pair);
            ASSERT_EQ(to_string(verdicts[0].reason), to_string(truth.reason)) << describe(pair);
            ASSERT_EQ(int(verdicts[0].edge), int(truth.edge)) << describe(pair);
            ++said[truth.reason];
            if (truth.reason != Reason::outside_edge) continue;
            const RationalOracle exact(pair.path, pair.corners);
            backs += exact.to_side() > 0 ? 1 : 0;
            int outside = 0;
            for (std::size_t k = 0; k < 3; ++k) outside += exact.weight(k) < 0 ? 1 : 0;
            corners += outside == 2 ? 1 : 0;
        }
    }
    for (const Reason reason : {Reason::first_hit, Reason::zero_area, Reason::in_plane, Reason::in_front,
                                Reason::behind, Reason::wrong_side, Reason::outside_edge})
        EXPECT_GT(said[reason], 200) << to_string(reason);
    EXPECT_GT(backs, 1000);
    EXPECT_GT(corners, 500);
}

TEST(ExplainReasons, in_small_cases) {
    // The face lies in the plane z = 0, its front up; edge 0 is the one along x, edge 1 the slanted one, edge 2 that
    // along y.
    const std::vector<V> positions = {V(0, 0, 0), V(4, 0, 0), V(0, 4, 0), V(0, 0, -9), V(0, 0, -9.5), V(0, 0.5, -9)};
    // The second is far away, and makes the mesh's box deep.
    const std::vector<IndexTriple> triangles = {{0, 1, 2}, {3, 4, 5}};
    const CollisionMesh<double> mesh({positions, triangles});
    const auto verdict = [&](const V& from, const V& to) {
        for (const FaceVerdict& v : mesh.explain({from, to}, {.sides = Sides::both}))
            if (v.face == 0) return v;
        return FaceVerdict{9, 9, Reason::apart};
    };
    EXPECT_EQ(verdict(V(1, 1, -2), V(1, 1, 0)).reason, Reason::first_hit)
        << "ends on the face, which is a change of side";
    EXPECT_EQ(verdict(V(1, 1, 0), V(1, 1, 2)).reason, Reason::in_front) << "leaves the face to the front";
    EXPECT_EQ(verdict(V(1, 1, 2), V(1, 1, 0)).reason, Reason::in_front) << "ends on the face";
    for (const double from : {1.0, -1.0}) {
        const auto through = [&](double x, double y, double dx, double dy) {
            const V middle(x, y, 0);
            const V d(dx, dy, from);
            return verdict(middle + d, middle - d);
        };
        EXPECT_EQ(through(1, 1, 3, 3).reason, Reason::first_hit);
        EXPECT_EQ(through(1, -1, 0, -2).edge, 0);
        EXPECT_EQ(through(3, 3, 2, 2).edge, 1);
        EXPECT_EQ(through(-1, 1, 2, 0).edge, 2);
        EXPECT_EQ(through(-1, 1, 2, 0).reason, Reason::outside_edge);
        // Beyond corners, outside of two edges: the lower one is named.
        EXPECT_EQ(through(6, -1, 3, 2).edge, 0) << "edges 0 and 1";
        EXPECT_EQ(through(-1, 6, 2, 3).edge, 1) << "edges 1 and 2";
        EXPECT_EQ(through(-1, -1, 2, 2).edge, 0) << "edges 2 and 0";
        EXPECT_EQ(through(-1, -1, 2, 2).reason, Reason::outside_edge);
    }
}

}  // namespace
}  // namespace pierce::test
