// Passages: one entry for each place where a segment meets the surface. What callers met, and each option.
#include <algorithm>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

std::vector<Passage<double>> passages_of(const CollisionMesh<double>& mesh, const Segment<double>& segment,
                                         const PassageOptions& options = {}) {
    std::vector<Passage<double>> passages(300);
    passages.resize(mesh.passages(segment, passages, options));
    return passages;
}

// The stories: all_hits found six hits at a vertex, and up to seventeen "walls" in front of a bullet.
TEST(Passages, a_vertex_is_one) {
    const CollisionMesh<double> floor(terrain(8, 0, 1).view());
    const Segment<double> down{V(0, 0, 1), V(0, 0, -1)};
    std::array<Hit<double>, 8> hits;
    ASSERT_EQ(floor.all_hits(down, hits, {.sides = Sides::both}), 6U);
    std::array<FaceTouch, 8> faces;
    std::array<Passage<double>, 8> passages;
    ASSERT_EQ(floor.passages(down, passages, {}, faces), 1U);
    const Passage<double>& passage = passages[0];
    EXPECT_EQ(passage.face_count, 6U);
    EXPECT_EQ(passage.first_face, 0U);
    EXPECT_EQ(passage.crossings, 1);
    EXPECT_EQ(passage.kind, PassageKind::entering);
    EXPECT_EQ(passage.fraction, 0.5);
    EXPECT_EQ(passage.position, V(0, 0, 0));
    EXPECT_EQ(passage.normal, V(0, 0, 1));
    EXPECT_EQ(passage.feature, Feature::vertex);
    EXPECT_EQ(passage.face, hits[0].face);
    int counted = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(faces[i].face, hits[i].face);
        counted += faces[i].crossing;
    }
    EXPECT_EQ(counted, 1);
}

TEST(Passages, a_ridge_that_is_touched_is_grazed) {
    const CollisionMesh<double> cube(polycube(1, 2, 2, 1).view());
    // Through the middle of the edge from (2, 0, 0) to (2, 0, 2), from outside to outside.
    const auto edge = passages_of(cube, {V(1, -1, 1), V(3, 1, 1)});
    ASSERT_EQ(edge.size(), 1U);
    EXPECT_EQ(edge[0].kind, PassageKind::grazing);
    EXPECT_EQ(edge[0].position, V(2, 0, 1));
    EXPECT_GE(edge[0].face_count, 2U);
    // And through the corner (2, 2, 2).
    const auto corner = passages_of(cube, {V(1, 2, 3), V(3, 2, 1)});
    ASSERT_EQ(corner.size(), 1U);
    EXPECT_EQ(corner[0].kind, PassageKind::grazing);
    EXPECT_EQ(corner[0].crossings, 0);
    // Through two edges across the cube: in and out.
    const auto through = passages_of(cube, {V(-1, -1, 1), V(3, 3, 1)});
    ASSERT_EQ(through.size(), 2U);
    EXPECT_EQ(through[0].kind, PassageKind::entering);
    EXPECT_EQ(through[1].kind, PassageKind::leaving);
    EXPECT_NEAR((through[1].position - through[0].position).norm(), 2 * std::sqrt(2.0), 1e-15);
}

// The example of passage.h, on walls of thickness 2 with their corners cut at all angles.
TEST(Passages, measure_what_lies_in_solid_matter) {
    TriangleSoup<double> soup = polycube(1, 2, 2, 1);
    append(soup, moved<double>(polycube(1, 2, 2, 1), 1, V(4, 0, 0)));
    const CollisionMesh<double> mesh(soup.view());
    const auto solid_part = [&](const Segment<double>& segment) {
        std::array<Passage<double>, 64> passages;
        const std::size_t count = std::min(mesh.passages(segment, passages), passages.size());
        int depth = mesh.winding_number(segment.from);
        double solid = 0;
        V last = segment.from;
        for (const Passage<double>& passage : std::span(passages).first(count)) {
            if (depth > 0) solid += (passage.position - last).norm();
            depth += passage.crossings;
            last = passage.position;
        }
        if (depth > 0) solid += (segment.to - last).norm();
        return solid;
    };
    EXPECT_EQ(solid_part({V(-1, 1, 1), V(7, 1, 1)}), 4);  // on diagonals of faces
    EXPECT_EQ(solid_part({V(1, 1, 1), V(5, 1, 1)}), 2);   // from inside to inside
    EXPECT_EQ(solid_part({V(-1, 0.5, 1), V(7, 0.5, 1)}), 4);
    EXPECT_EQ(solid_part({V(-1, 3, 1), V(7, 3, 1)}), 0);
    EXPECT_NEAR(solid_part({V(-1, -1, 1), V(3, 3, 1)}), 2 * std::sqrt(2.0), 1e-15);
}

TEST(Passages, starts_and_ends_on_the_surface) {
    const CollisionMesh<double> floor(corner_triangle().view());
    const auto only = [&](const Segment<double>& segment) {
        const auto passages = passages_of(floor, segment);
        EXPECT_EQ(passages.size(), 1U);
        return passages.at(0);
    };
    const Passage<double> into = only({V(1, 1, 0), V(1, 1, -1)});
    EXPECT_TRUE(into.at_start && !into.at_end);
    EXPECT_EQ(into.fraction, 0);
    EXPECT_EQ(into.kind, PassageKind::entering);
    const Passage<double> onto = only({V(1, 1, 1), V(1, 1, 0)});
    EXPECT_TRUE(onto.at_end && !onto.at_start);
    EXPECT_EQ(onto.fraction, 1);
    EXPECT_EQ(onto.kind, PassageKind::grazing);
    EXPECT_EQ(onto.side, Sides::front);
    EXPECT_EQ(only({V(1, 1, 0), V(1, 1, 1)}).kind, PassageKind::grazing);
    EXPECT_EQ(only({V(1, 1, -1), V(1, 1, 0)}).kind, PassageKind::leaving);
    EXPECT_TRUE(passages_of(floor, {V(0, 0, 0), V(1, 1, 0)}).empty());  // in its plane
    EXPECT_TRUE(passages_of(floor, {V(1, 1, 0), V(1, 1, 0)}).empty());  // no length
}

/// Floors above one another, each of two triangles, in random order.
TriangleSoup<double> storeys(int count) {
    TriangleSoup<double> soup;
    Random random(1);
    std::vector<int> heights;
    for (int i = 0; i < count; ++i) heights.push_back(i);
    for (std::size_t i = heights.size(); i-- > 1;) std::swap(heights[i], heights[random.below(i + 1)]);
    for (const int height : heights) {
        const double z = height / 3.0;
        add_triangle(soup, V(-1, -1, z), V(1, -1, z), V(1, 1, z));
        add_triangle(soup, V(-1, -1, z), V(1, 1, z), V(-1, 1, z));
    }
    return soup;
}

// More than one traversal finds; some, all, or none of them wanted.
TEST(Passages, of_any_number_are_found_in_order) {
    for (const int count : {31, 32, 33, 63, 64, 65, 200}) {
        const CollisionMesh<double> mesh(storeys(count).view());
        const Segment<double> up{V(0.5, 0.5, -1), V(0.5, 0.5, 100)};
        for (const std::size_t room : {0U, 1U, 31U, 32U, 33U, 64U, 65U, 300U}) {
            const auto all = static_cast<std::size_t>(count);
            std::vector<Passage<double>> passages(room);
            std::vector<FaceTouch> faces(room > 2 ? 2 * room - 3 : 0);  // the last passage's faces do not fit
            const std::size_t kept = std::min(room, all);
            EXPECT_EQ(mesh.passages(up, passages, {.count_all = false}), kept);
            ASSERT_EQ(mesh.passages(up, passages, {}, faces), all);
            for (std::size_t i = 0; i < kept; ++i) {
                EXPECT_EQ(passages[i].position, V(0.5, 0.5, static_cast<double>(i) / 3.0));
                EXPECT_EQ(passages[i].first_face, 2 * i);
                EXPECT_EQ(passages[i].face_count, 2U);
                EXPECT_EQ(passages[i].kind, PassageKind::leaving);
                if (2 * i + 2 > faces.size()) continue;
                EXPECT_EQ(faces[2 * i].face, passages[i].face);
                EXPECT_EQ(faces[2 * i + 1].face, passages[i].face + 1);
            }
        }
    }
}

// Stopping early is cheap: a bullet that goes through two walls does not see the others.
TEST(Passages, the_first_ones_cost_no_more_than_they_need) {
    const CollisionMesh<double> mesh(storeys(4000).view());
    const Segment<double> up{V(0.25, 0.5, -1), V(0.25, 0.5, 2000)};
    std::array<Passage<double>, 2> passages;
    QueryCounters few;
    ASSERT_EQ(mesh.passages(up, passages, {.counters = &few, .count_all = false}), 2U);
    EXPECT_LT(few.clusters, 20U);
    EXPECT_EQ(passages[1].position, V(0.25, 0.5, 1 / 3.0));
}

TEST(Passages, accept_is_asked_about_each_face_before_they_are_taken_together) {
    const TriangleSoup<double> soup = storeys(40);
    const CollisionMesh<double> mesh(soup.view());
    const Segment<double> up{V(0.5, 0.5, -1), V(0.5, 0.5, 100)};
    std::vector<Contact> contacts;
    const auto accept = [&](const Contact& contact) {
        contacts.push_back(contact);
        return contact.face % 4 == 1;
    };
    PassageOptions options;
    options.accept = accept;
    const auto passages = passages_of(mesh, up, options);
    ASSERT_EQ(passages.size(), 20U);
    for (const Passage<double>& passage : passages) {
        EXPECT_EQ(passage.face % 4, 1U);
        EXPECT_EQ(passage.face_count, 1U);
        EXPECT_EQ(passage.feature, Feature::edge);
    }
    ASSERT_GE(contacts.size(), 80U);
    for (const Contact& contact : contacts) {
        EXPECT_EQ(contact.side, Sides::back);
        EXPECT_FALSE(contact.at_start);
        EXPECT_NEAR(-1 + 101 * contact.fraction, soup.positions[soup.triangles[contact.triangle][0]][2], 1e-13);
    }
    EXPECT_EQ(passages_of(mesh, up, {.sides = Sides::front}).size(), 0U);
    EXPECT_EQ(passages_of(mesh, up, {.max_fraction = 0.5}).size(), 40U);
    EXPECT_EQ(passages_of(mesh, {up.to, up.from}, {.sides = Sides::front, .max_fraction = 1 - 3.1 / 101}).size(), 33U);
}

TEST(Passages, what_is_not_finite_has_none) {
    const CollisionMesh<double> mesh(bumpy_sphere(4).view());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(passages_of(mesh, {V(0, 0, 0), V(nan, 0, 9)}).size(), 0U);
    EXPECT_EQ(passages_of(mesh, {V(0, 0, 0), V(9, 0, 0)}, {.max_fraction = nan}).size(), 0U);
    EXPECT_EQ(passages_of(mesh, {V(0, 0, 0), V(9, 0, 0)}).size(), 1U);
    EXPECT_EQ(mesh.statistics().invalid_queries, 1U);
    EXPECT_EQ(passages_of(CollisionMesh<double>(MeshView<double>{}), {V(0, 0, 0), V(9, 0, 0)}).size(), 0U);
}

}  // namespace
}  // namespace pierce::test
