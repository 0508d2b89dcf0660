// The decision contract in small cases that can be checked by eye; see include/pierce/hit.h for its words.
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;
using S = Segment<double>;

TriangleSoup<double> triangle() { return {{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0)}, {{0, 1, 2}}, {}}; }

struct Case {
    const char* what;
    V from;
    V to;
    bool front;
    bool back;
    bool both;  // a change of side, on the plane counting as in front
};

TEST(Contract, sides_ends_and_planes) {
    //   z                        The triangle lies in the plane z = 0 and faces up; (1, 1) is inside.
    //   |  from
    //   |   \       front
    //   +----\------------- x
    //         to    back
    const CollisionMesh<double> mesh(triangle().view());
    const Case cases[] = {
        {"from the front through the face", {1, 1, 1}, {1, 1, -1}, true, false, true},
        {"from the back through the face", {1, 1, -1}, {1, 1, 1}, false, true, true},
        {"starts on the face, goes in", {1, 1, 0}, {1, 1, -1}, true, false, true},
        {"starts on the face, goes out", {1, 1, 0}, {1, 1, 1}, false, true, false},
        {"ends on the face, from the front", {1, 1, 1}, {1, 1, 0}, false, false, false},
        {"ends on the face, from the back", {1, 1, -1}, {1, 1, 0}, false, false, true},
        {"stays in front", {1, 1, 2}, {1, 1, 1}, false, false, false},
        {"stays behind", {1, 1, -1}, {1, 1, -2}, false, false, false},
        {"in the plane, across", {-1, 1, 0}, {5, 1, 0}, false, false, false},
        {"in the plane, along an edge", {0, 0, 0}, {4, 0, 0}, false, false, false},
        {"of length zero, on the face", {1, 1, 0}, {1, 1, 0}, false, false, false},
        {"of length zero, in space", {1, 1, 1}, {1, 1, 1}, false, false, false},
        {"through an edge, from the front", {1, 0, 1}, {1, 0, -1}, true, false, true},
        {"through the slanted edge, from the back", {1, 3, -1}, {3, 1, 1}, false, true, true},
        {"through a corner, from the front", {0, 0, 1}, {0, 0, -1}, true, false, true},
        {"starts on a corner, goes in", {4, 0, 0}, {4, 1, -1}, true, false, true},
        {"past an edge", {1, -1e-300, 1}, {1, -1e-300, -1}, false, false, false},
        {"past a corner by the least there is", {4, 0, 1}, {std::nextafter(4.0, 5.0), 0, -1}, false, false, false},
    };
    for (const Case& c : cases) {
        const S segment{c.from, c.to};
        EXPECT_EQ(mesh.any_hit(segment), c.front) << c.what;
        EXPECT_EQ(mesh.any_hit(segment, {.sides = Sides::back}), c.back) << c.what;
        EXPECT_EQ(mesh.any_hit(segment, {.sides = Sides::both}), c.both) << c.what;
        const auto hit = mesh.first_hit(segment, {.sides = Sides::both});
        ASSERT_EQ(hit.has_value(), c.both) << c.what;
        EXPECT_TRUE(!hit || hit->side == (c.front ? Sides::front : Sides::back)) << c.what;
    }
}

// A hit from the back on a plane that the exact fraction rounds to: a point on that plane is in front of it already.
TEST(Contract, from_both_sides_the_point_stays_on_its_own) {
    const CollisionMesh<double> mesh(triangle().view());
    for (const double to : {0.0, 1e-300, 1e-9, 1.0, 3.0}) {
        const S up{V(1, 1, -1), V(1.25, 1, to)};
        const auto hit = mesh.first_hit(up, {.sides = Sides::both});
        ASSERT_TRUE(hit) << to;
        EXPECT_EQ(hit->side, Sides::back);
        EXPECT_LT(hit->point[2], 0) << to;
        EXPECT_FALSE(mesh.any_hit({up.from, hit->point}, {.sides = Sides::both})) << to;
        EXPECT_TRUE(mesh.any_hit({hit->point, up.to}, {.sides = Sides::both})) << to;
    }
}

// A point that rests on the plane, in the face, on an edge and on a corner, leaves it to the front and stops at it to
// the back.
TEST(Contract, from_both_sides_a_resting_point_leaves_to_the_front) {
    const CollisionMesh<double> mesh(triangle().view());
    for (const V& at : {V(1, 1, 0), V(2, 0, 0), V(2, 2, 0), V(0, 0, 0), V(4, 0, 0)})
        for (const double dx : {-1.0, 0.0, 1e-3}) {
            EXPECT_FALSE(mesh.any_hit({at, at + V(dx, 0, 1e-300)}, {.sides = Sides::both})) << at.transpose();
            EXPECT_FALSE(mesh.any_hit({at, at + V(dx, 0, 0)}, {.sides = Sides::both})) << at.transpose();
            EXPECT_TRUE(mesh.any_hit({at, at + V(dx, 0, -1e-300)}, {.sides = Sides::both})) << at.transpose();
            EXPECT_TRUE(mesh.any_hit({at + V(dx, 0, -1e-300), at}, {.sides = Sides::both})) << "back onto it";
        }
}

TEST(Contract, features_and_values) {
    const CollisionMesh<double> mesh(triangle().view());
    const auto at = [&](double x, double y) { return mesh.first_hit({V(x, y, 1), V(x, y, -3)}); };
    const auto face = at(1, 2);
    ASSERT_TRUE(face);
    EXPECT_EQ(face->feature, Feature::face);
    EXPECT_EQ(face->exact_fraction, 0.25);
    EXPECT_LT(face->fraction, 0.25);
    EXPECT_GT(face->fraction, 0.25 - 1e-15);
    EXPECT_EQ(face->normal, V(0, 0, 1));
    EXPECT_EQ(face->barycentric, V(0.25, 0.25, 0.5));
    EXPECT_FALSE(face->at_start);
    EXPECT_GE(face->point[2], 0);
    EXPECT_LT(face->point[2], 1e-14);

    const auto expect_feature = [&](double x, double y, Feature feature, int index) {
        const auto hit = at(x, y);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->feature, feature) << x << ' ' << y;
        EXPECT_EQ(hit->feature_index, index) << x << ' ' << y;
    };
    expect_feature(1, 0, Feature::edge, 0);  // from corner 0 to corner 1
    expect_feature(2, 2, Feature::edge, 1);
    expect_feature(0, 3, Feature::edge, 2);
    expect_feature(0, 0, Feature::vertex, 0);
    expect_feature(4, 0, Feature::vertex, 1);
    expect_feature(0, 4, Feature::vertex, 2);

    const auto back = mesh.first_hit({V(1, 1, -1), V(1, 1, 1)}, {.sides = Sides::back});
    ASSERT_TRUE(back);
    EXPECT_EQ(back->normal, V(0, 0, 1)) << "the normal is not turned round";

    const auto start = mesh.first_hit({V(1, 1, 0), V(1, 2, -1)});
    ASSERT_TRUE(start);
    EXPECT_TRUE(start->at_start);
    EXPECT_EQ(start->fraction, 0);
    EXPECT_EQ(start->exact_fraction, 0);
    EXPECT_EQ(start->point, V(1, 1, 0));
}

TEST(Contract, degenerate_triangles_never_hit) {
    for (const auto& corners : {std::array<V, 3>{V(0, 0, 0), V(0, 0, 0), V(1, 0, 0)},
                                {V(0, 0, 0), V(1, 1, 1), V(3, 3, 3)},
                                {V(2, 2, 2), V(2, 2, 2), V(2, 2, 2)}}) {
        const TriangleSoup<double> soup{{corners[0], corners[1], corners[2]}, {{0, 1, 2}}, {}};
        const CollisionMesh<double> mesh(soup.view());
        EXPECT_EQ(mesh.statistics().degenerate, 1U);
        EXPECT_EQ(mesh.statistics().faces, 1U);
        for (const V& target : corners)
            EXPECT_FALSE(mesh.any_hit({target + V(1, 2, 3), target - V(1, 2, 3)}, {.sides = Sides::both}));
    }
}

TEST(Contract, ties_go_to_the_smallest_face) {
    // A fan of four around the origin, with the faces numbered by the caller in another order; the fifth doubles one of
    // them.
    TriangleSoup<double> soup{{V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(-1, 0, 0), V(0, -1, 0)},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {0, 2, 3}},
                              {40, 30, 20, 10, 5}};
    for (const double cell : {1e300, 1.0, 0.25}) {
        const CollisionMesh<double> mesh(soup.view(), {.cell_size = cell});
        const auto face_at = [&](double x, double y) {
            const auto hit = mesh.first_hit({V(x, y, 1), V(x, y, -1)});
            return hit ? static_cast<int>(hit->face) : -1;
        };
        EXPECT_EQ(face_at(0, 0), 5);
        EXPECT_EQ(face_at(0.5, 0), 10);
        EXPECT_EQ(face_at(0, 0.5), 5);
        EXPECT_EQ(face_at(0, -0.5), 10);
        EXPECT_EQ(face_at(-0.25, 0.25), 5);
        EXPECT_EQ(face_at(-0.25, -0.25), 20);
        std::array<Hit<double>, 8> all;
        ASSERT_EQ(mesh.all_hits({V(0, 0, 1), V(0, 0, -1)}, all), 5U);
        EXPECT_EQ(all[0].face, 5U);
        EXPECT_EQ(all[0].triangle, 4U);
        EXPECT_EQ(all[4].face, 40U);
        EXPECT_EQ(mesh.mesh_report().duplicates, 1U);
    }
}

TEST(Contract, order_is_exact_where_doubles_see_a_tie) {
    // Two faces a hair apart: one is tilted so that it comes first at x = 1 by 2^-60 of the way, far below a double's
    // step there.
    const double hair = 0x1p-60;
    TriangleSoup<double> soup{{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0), V(0, 0, 0), V(4, 0, 4 * hair), V(0, 4, 0)},
                              {{0, 1, 2}, {3, 4, 5}},
                              {}};
    const S segment{V(1, 1, 1), V(1, 1, -1)};
    const auto hit = CollisionMesh<double>(soup.view()).first_hit(segment);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 1U);
    std::swap(soup.triangles[0], soup.triangles[1]);
    const auto swapped = CollisionMesh<double>(soup.view()).first_hit(segment);
    ASSERT_TRUE(swapped);
    EXPECT_EQ(swapped->face, 0U);
}

TEST(Contract, max_fraction_is_exact_and_closed) {
    const CollisionMesh<double> mesh(triangle().view());
    const S half{V(1, 1, 1), V(1, 1, -1)};
    EXPECT_TRUE(mesh.any_hit(half, {.max_fraction = 0.5}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = std::nextafter(0.5, 0.0)}));
    const S third{V(1, 1, 1), V(1, 1, -2)};  // at 1/3, which no double is: the nearest one lies below
    EXPECT_FALSE(mesh.any_hit(third, {.max_fraction = 1.0 / 3}));
    EXPECT_TRUE(mesh.any_hit(third, {.max_fraction = std::nextafter(1.0 / 3, 1.0)}));
    // The same on an edge, which only exact arithmetic decides.
    EXPECT_FALSE(mesh.any_hit({V(1, 0, 1), V(1, 0, -2)}, {.max_fraction = 1.0 / 3}));
    EXPECT_TRUE(mesh.any_hit({V(1, 0, 1), V(1, 0, -2)}, {.max_fraction = std::nextafter(1.0 / 3, 1.0)}));
    const S start{V(1, 1, 0), V(1, 1, -1)};
    EXPECT_TRUE(mesh.any_hit(start, {.max_fraction = 0}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = 0}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = -1}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = std::numeric_limits<double>::denorm_min()}));
    EXPECT_TRUE(mesh.any_hit(half, {.max_fraction = 7}));
    EXPECT_FALSE(mesh.any_hit(start, {.max_fraction = std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Contract, a_nearer_hit_beyond_the_limit_of_sides_does_not_hide_one) {
    // Sides are looked at before the minimum is taken: the back of the first face does not hide the front of the
    // second.
    TriangleSoup<double> soup{{V(0, 0, 2), V(0, 4, 2), V(4, 0, 2), V(0, 0, 1), V(4, 0, 1), V(0, 4, 1)},
                              {{0, 1, 2}, {3, 4, 5}},
                              {}};
    const auto hit = CollisionMesh<double>(soup.view()).first_hit({V(1, 1, 3), V(1, 1, 0)});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 1U);
}

TEST(Contract, all_hits_counts_what_it_leaves_out) {
    TriangleSoup<double> soup;
    for (std::uint32_t i = 0; i < 10; ++i) {
        for (const V& p : {V(0, 0, i), V(4, 0, i), V(0, 4, i)}) soup.positions.push_back(p);
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const CollisionMesh<double> mesh(soup.view());
    const S down{V(1, 1, 20), V(1, 1, -20)};
    std::array<Hit<double>, 12> all;
    ASSERT_EQ(mesh.all_hits(down, all), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(all[i].face, 9 - i);
        // The way to each point passes the faces before, and no other.
        EXPECT_EQ(mesh.all_hits({down.from, all[i].point}, {}), i);
    }
    std::array<Hit<double>, 3> some;
    EXPECT_EQ(mesh.all_hits(down, some), 10U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(some[i], all[i]));
    EXPECT_EQ(mesh.all_hits(down, {}), 10U);
}

TEST(Contract, of_two_hits_at_one_place_neither_hides_the_other_from_its_point) {
    // A ridge of two slopes, hit on the ridge itself from many sides: both faces are hit at the same fraction, so the
    // way to either point must be clear of both.
    const TriangleSoup<double> soup{
        {V(0, -1, 0), V(0, 1, 0), V(1, 0, -0.7), V(-1, 0, -0.3)}, {{0, 2, 1}, {0, 1, 3}}, {}};
    const CollisionMesh<double> mesh(soup.view());
    Random random(4);
    std::array<Hit<double>, 4> hits;
    int both = 0;
    for (int i = 0; i < 2000; ++i) {
        V d = random.direction();
        d[2] = 1 + std::abs(d[2]);
        for (double& x : d) x = std::round(x * 1024) / 1024;  // so that the segment meets the ridge exactly
        const V at(0, random.between_ints(-7, 7) / 8.0, 0);
        const Segment<double> segment{at + d, at - d};
        if (mesh.all_hits(segment, hits) != 2) continue;
        ++both;
        ASSERT_EQ(hits[0].exact_fraction, 0.5);
        for (std::size_t k = 0; k < 2; ++k)
            ASSERT_FALSE(mesh.any_hit({segment.from, hits[k].point})) << to_text(segment);
    }
    EXPECT_EQ(both, 2000);
}

template <class Scalar>
void expect_nothing_for_bad_numbers() {
    const CollisionMesh<Scalar> mesh(moved<Scalar>(triangle(), 1, V(0, 0, 0)).view());
    std::array<Hit<Scalar>, 2> out;
    std::uint64_t asked = 0;
    for (const Scalar bad : {std::numeric_limits<Scalar>::quiet_NaN(), std::numeric_limits<Scalar>::infinity(),
                             -std::numeric_limits<Scalar>::infinity()})
        for (int end = 0; end < 2; ++end)
            for (int k = 0; k < 3; ++k) {
                Segment<Scalar> s{{1, 1, 1}, {1, 1, -1}};
                (end == 0 ? s.from : s.to)[k] = bad;
                EXPECT_FALSE(mesh.first_hit(s));
                EXPECT_FALSE(mesh.any_hit(s));
                EXPECT_EQ(mesh.all_hits(s, out), 0U);
                EXPECT_FALSE(mesh.sweep(s.from, s.to));
                asked += 4;
            }
    EXPECT_EQ(mesh.statistics().invalid_queries, asked);
    EXPECT_TRUE(mesh.any_hit({{1, 1, 1}, {1, 1, -1}}));
    EXPECT_EQ(mesh.statistics().invalid_queries, asked);
}

TEST(Contract, queries_that_are_not_finite_have_no_hit_and_are_counted) {
    expect_nothing_for_bad_numbers<float>();
    expect_nothing_for_bad_numbers<double>();
}

TEST(Contract, an_empty_mesh_is_never_hit) {
    const CollisionMesh<float> mesh(MeshView<float>{});
    EXPECT_FALSE(mesh.any_hit({{0, 0, 1}, {0, 0, -1}}));
    EXPECT_EQ(mesh.statistics().triangles, 0U);
}

std::string error_of(const TriangleSoup<double>& soup) {
    try {
        const CollisionMesh<double> mesh(soup.view());
    } catch (const MeshError& error) {
        return error.what();
    }
    return "none";
}

TEST(Contract, a_bad_mesh_is_refused_by_name) {
    TriangleSoup<double> soup = triangle();
    soup.triangles.push_back({0, 1, 3});
    EXPECT_EQ(error_of(soup), "face 1 (triangle 1): corner 3 is out of range: there are 3 vertices");
    soup.faces = {7, 7};
    EXPECT_EQ(error_of(soup), "face 7 (triangle 1): corner 3 is out of range: there are 3 vertices");
    soup.faces = {7};
    EXPECT_EQ(error_of(soup), "the mesh numbers 1 faces, but has 2 triangles");
    soup = triangle();
    soup.positions.push_back(V(0, std::numeric_limits<double>::quiet_NaN(), 0));
    EXPECT_EQ(error_of(soup), "vertex 3: its y coordinate is not finite");
    soup.positions[1][2] = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of(soup), "vertex 1: its z coordinate is not finite");
}

TEST(Contract, coordinates_at_both_ends_of_the_range) {
    for (const double size : {1e300, 1e-300, 1e-310, 4 * std::numeric_limits<double>::denorm_min()}) {
        const CollisionMesh<double> mesh(moved<double>(triangle(), size / 4, V(0, 0, 0)).view());
        const S through{size * V(0.25, 0.25, 0.25), size * V(0.25, 0.25, -0.25)};
        const auto hit = mesh.first_hit(through);
        ASSERT_TRUE(hit) << size;
        EXPECT_EQ(hit->exact_fraction, 0.5) << size;
        EXPECT_EQ(hit->barycentric, V(0.5, 0.25, 0.25)) << size;
        EXPECT_FALSE(mesh.any_hit({through.from, hit->point})) << size;
        EXPECT_GT(hit->fraction, size > 1e-320 ? 0.49 : -1) << size;
        EXPECT_FALSE(mesh.any_hit({size * V(0.75, 0.5, 0.25), size * V(0.75, 0.5, -0.25)})) << size;
        EXPECT_EQ(mesh.first_hit({size * V(0.5, 0.5, 0.25), size * V(0.5, 0.5, -0.25)}).value().feature, Feature::edge);
    }
}

// A hit's point need not lie on the segment: the way to it is clear, it keeps off the plane by a grain (or as far as
// the start), it is near the true one, and who goes on from there to the same end is stopped again, for certain where
// the way's own triangle is met further from its edges than the point may lie aside.
template <class Scalar>
void expect_verified(const TriangleSoup<Scalar>& soup, std::uint64_t seed) {
    const CollisionMesh<Scalar> mesh(soup.view());
    const Extent<Scalar> extent(soup.view());
    const double largest = std::max(extent.low.cwiseAbs().maxCoeff(), extent.high.cwiseAbs().maxCoeff());
    const double unit = std::numeric_limits<Scalar>::epsilon() * std::exp2(std::floor(std::log2(largest)));
    Random random(seed);
    int hits = 0;
    int faces = 0;
    int stopped_again = 0;
    int far = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Segment<Scalar> segment = mixed_segment(soup.view(), extent, random);
        const QueryOptions options{.sides = random.chance(0.5) ? Sides::both : Sides::front};
        const auto hit = mesh.first_hit(segment, options);
        if (!hit) continue;
        ++hits;
        ASSERT_FALSE(mesh.any_hit({segment.from, hit->point}, options)) << to_text(segment);
        ASSERT_LE(hit->fraction, hit->exact_fraction) << to_text(segment);
        ASSERT_GE(hit->fraction, 0) << to_text(segment);
        ASSERT_TRUE(hit->fraction > 0 || hit->point == segment.from) << to_text(segment);
        if (hit->at_start) continue;
        const Vec3<double> normal = hit->normal.template cast<double>() * (hit->side == Sides::front ? 1 : -1);
        const auto from_true = [&](const Vec3<Scalar>& p) -> Vec3<double> {
            return (p - hit->position).template cast<double>();
        };
        // The position was rounded (sqrt(3) / 2 of a unit), and so was the normal, by 4 ulp of 1.
        const double start = normal.dot(from_true(segment.from));
        const double slack = unit + 8 * std::numeric_limits<Scalar>::epsilon() * from_true(segment.from).norm();
        const double off = normal.dot(from_true(hit->point));
        ASSERT_GE(off, std::min(4 * unit, start - slack) - unit) << to_text(segment);
        far += from_true(hit->point).norm() > 13 * unit ? 1 : 0;
        if (hit->feature != Feature::face) continue;
        // Where the segment from the point to the same end meets the plane: no further from the true point than this.
        const double below = std::max(0.0, -normal.dot(from_true(segment.to)) - slack);
        const double aside = from_true(hit->point).norm() + unit +
                             (segment.to - hit->point).template cast<double>().norm() * (off + unit) / (off + below);
        double to_edge = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3<double> a = corner(soup.view(), hit->triangle, k);
            const Vec3<double> b = corner(soup.view(), hit->triangle, (k + 1) % 3);
            to_edge = std::min(to_edge, (b - a).normalized().cross(hit->position.template cast<double>() - a).norm());
        }
        if (to_edge <= aside + unit) continue;
        ++faces;
        const bool again = mesh.any_hit({hit->point, segment.to}, options);
        ASSERT_TRUE(again) << to_text(segment);
        stopped_again += again ? 1 : 0;
    }
    std::cout << hits << " hits, " << faces << " of them away from edges, " << far
              << " points further than 13 units from the true ones\n";
    EXPECT_GT(hits, 2000);
    EXPECT_GT(stopped_again, hits / 4);
    EXPECT_LE(far, hits / 500);  // in corners with no clear place nearer: place_test.cpp looks for one
}

TEST(Contract, the_way_to_the_returned_point_is_clear) {
    expect_verified(moved<float>(bumpy_sphere(16), 1, V(0, 0, 0)), 1);
    expect_verified(moved<float>(bumpy_sphere(16), 100, V(1e6, 1e6, -1e6)), 2);
    expect_verified(moved<double>(bumpy_sphere(16), 1, V(1e3, 1e6, 0)), 3);
    expect_verified(moved<float>(polycube(4, 0.5, 1, 3), 0.1, V(0, 0, 0)), 4);
}

}  // namespace
}  // namespace pierce::test
