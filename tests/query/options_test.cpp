// Masks, accept callbacks and explanations: each choice acts on each candidate before the first hit is looked for.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/naive.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// Ten floors, one above the other; floor i is at height i.
TriangleSoup<double> floors() {
    TriangleSoup<double> soup;
    for (int i = 0; i < 10; ++i) add_triangle(soup, V(0, 0, i), V(4, 0, i), V(0, 4, i));
    return soup;
}

const Segment<double> k_down{V(1, 1, 9.5), V(1, 1, -0.5)};

TEST(Options, a_masked_face_hides_nothing) {
    const TriangleSoup<double> soup = floors();
    const CollisionMesh<double> mesh(soup.view());
    std::vector<std::uint8_t> mask(10, 1);
    mask[9] = mask[8] = 0;
    EXPECT_EQ(mesh.first_hit(k_down, {.face_mask = mask}).value().face, 7U);
    // The verified point may lie beyond a face that does not count.
    EXPECT_LT(mesh.first_hit(k_down, {.face_mask = mask}).value().point[2], 7.1);
    std::array<Hit<double>, 10> out;
    EXPECT_EQ(mesh.all_hits(k_down, out, {.face_mask = mask}), 8U);
    mask.resize(9);  // what is beyond the mask does not count
    EXPECT_EQ(mesh.first_hit(k_down, {.face_mask = mask}).value().face, 7U);
    mask.assign(10, 0);
    EXPECT_FALSE(mesh.any_hit(k_down, {.face_mask = mask}));
}

TEST(Options, the_mask_goes_by_the_callers_numbers) {
    TriangleSoup<double> soup = floors();
    for (std::uint32_t i = 0; i < 10; ++i) soup.faces.push_back(i / 2);
    const CollisionMesh<double> mesh(soup.view());
    const std::vector<std::uint8_t> mask = {1, 1, 1, 0, 0};
    EXPECT_EQ(mesh.first_hit(k_down, {.face_mask = mask}).value().triangle, 5U);
}

TEST(Options, accept_is_asked_with_exact_contacts_and_hides_nothing) {
    const TriangleSoup<double> soup = floors();
    const CollisionMesh<double> mesh(soup.view());
    int asked = 0;
    const auto only_even = [&](const Contact& contact) {
        ++asked;
        EXPECT_EQ(contact.side, Sides::front);
        EXPECT_EQ(contact.barycentric, V(0.5, 0.25, 0.25));
        return contact.face % 2 == 0;
    };
    EXPECT_EQ(mesh.first_hit(k_down, {.accept = only_even}).value().face, 8U);
    EXPECT_GE(asked, 2);
    std::array<Hit<double>, 10> out;
    EXPECT_EQ(mesh.all_hits(k_down, out, {.accept = only_even}), 5U);
    EXPECT_FALSE(mesh.any_hit(k_down, {.accept = [](const Contact&) { return false; }}));
    // A hole in a texture: only hits in the outer part of the triangle count.
    const auto texture = [](const Contact& contact) { return contact.barycentric.minCoeff() < 0.2; };
    EXPECT_FALSE(mesh.any_hit(k_down, {.accept = texture}));
    EXPECT_TRUE(mesh.any_hit({V(3, 0.5, 1), V(3, 0.5, -1)}, {.accept = texture}));
}

TEST(Options, all_at_once_agree_with_the_naive_twin) {
    const TriangleSoup<float> soup = moved<float>(polycube(4, 0.5, 2, 3), 1, V(0, 0, 0));
    const CollisionMesh<float> mesh(soup.view());
    const NaiveMesh<float> naive(soup.view());
    const Extent<float> extent(soup.view());
    Random random(8);
    const auto accept = [](const Contact& contact) {
        return contact.triangle % 3 != 0 || contact.feature != Feature::face;
    };
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Segment<float> segment = mixed_segment(soup.view(), extent, random);
        std::vector<std::uint8_t> mask(soup.triangles.size() - 5);
        for (auto& m : mask) m = random.chance(0.7) ? 1 : 0;
        const QueryOptions options{
            .sides = Sides::both, .max_fraction = random.unit() * 1.2, .face_mask = mask, .accept = accept};
        const auto hit = mesh.first_hit(segment, options);
        ASSERT_TRUE(same_answer(hit, naive.first_hit(segment, options))) << to_text(segment);
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(hits, 500);
}

Reason reason_for(const std::vector<FaceVerdict>& verdicts, std::uint32_t face) {
    for (const FaceVerdict& verdict : verdicts)
        if (verdict.face == face) return verdict.reason;
    ADD_FAILURE() << "face " << face << " is not near";
    return Reason::apart;
}

TEST(Explain, gives_each_face_its_reason) {
    TriangleSoup<double> soup;
    const auto add = [&](const V& a, const V& b, const V& c) {
        add_triangle(soup, a, b, c);
        return static_cast<std::uint32_t>(soup.triangles.size() - 1);
    };
    const V x(4, 0, 0);
    const V y(0, 4, 0);
    const auto level = [&](double z) { return add(V(0, 0, z), V(0, 0, z) + x, V(0, 0, z) + y); };
    const auto beyond = level(3);      // starts below it
    const auto masked_face = level(2);
    const auto refused = level(1.5);
    const auto first = level(1);
    const auto later = level(0);
    const auto reversed = add(V(0, 0, 0.5), V(0, 0, 0.5) + y, V(0, 0, 0.5) + x);
    const auto limit = level(-1.5);
    const auto below = level(-2);      // ends on it
    const auto aside = add(V(1.5, 0, 1), V(5, 0, 1), V(5, 4, 1));
    const auto upright = add(V(1, 0, -2), V(1, 4, -2), V(1, 0, 4));  // the segment lies in its plane
    const auto line = add(V(1, 1, 0), V(1, 1, 1), V(1, 1, 2));
    const CollisionMesh<double> mesh(soup.view());
    std::vector<std::uint8_t> mask(soup.triangles.size(), 1);
    mask[masked_face] = 0;
    const auto accept = [&](const Contact& contact) { return contact.face != refused; };
    const auto verdicts =
        mesh.explain({V(1, 1, 3), V(1, 1, -2)}, {.max_fraction = 0.8, .face_mask = mask, .accept = accept});
    EXPECT_EQ(reason_for(verdicts, masked_face), Reason::masked);
    EXPECT_EQ(reason_for(verdicts, refused), Reason::not_accepted);
    EXPECT_EQ(reason_for(verdicts, later), Reason::later);
    EXPECT_EQ(reason_for(verdicts, reversed), Reason::wrong_side);
    EXPECT_EQ(reason_for(verdicts, limit), Reason::too_far);
    EXPECT_EQ(reason_for(verdicts, below), Reason::in_front);
    EXPECT_EQ(reason_for(verdicts, aside), Reason::apart);
    EXPECT_EQ(reason_for(verdicts, upright), Reason::in_plane);
    EXPECT_EQ(reason_for(verdicts, line), Reason::zero_area);
    // It starts on the uppermost face and goes in: that is the first hit.
    EXPECT_EQ(reason_for(verdicts, beyond), Reason::first_hit);
    EXPECT_EQ(reason_for(verdicts, first), Reason::later);

    const auto slanted = mesh.explain({V(1, 1, 2.5), V(3.5, 1, 0.9)});
    EXPECT_EQ(reason_for(slanted, beyond), Reason::apart);
    const auto past = mesh.explain({V(3, 0.5, 2.5), V(3, 3, 1.25)});
    EXPECT_EQ(reason_for(past, refused), Reason::outside_edge);
    for (const FaceVerdict& verdict : past)
        EXPECT_EQ(verdict.edge, verdict.face == refused ? 1 : verdict.edge);
    // No further away than the segment is long, 0.5.
    EXPECT_EQ(reason_for(mesh.explain({V(1, 1, -1.75), V(1, 1.5, -1.5)}), below), Reason::apart);
    const auto near = mesh.explain({V(1, 1, -1.75), V(1, 1.5, -1.5)});
    EXPECT_EQ(reason_for(near, limit), Reason::behind);
    for (const FaceVerdict& verdict : near) EXPECT_NE(verdict.face, later);
    EXPECT_EQ(to_string(Reason::outside_edge), "passes outside an edge");
}

TEST(Explain, agrees_with_first_hit) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(8), 1, V(0, 0, 0));
    const CollisionMesh<float> mesh(soup.view());
    const Extent<float> extent(soup.view());
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const Segment<float> segment = mixed_segment(soup.view(), extent, random);
        const auto hit = mesh.first_hit(segment);
        std::array<Hit<float>, 32> all;
        std::size_t firsts = 0;
        std::size_t laters = 0;
        for (const FaceVerdict& verdict : mesh.explain(segment)) {
            laters += verdict.reason == Reason::later ? 1 : 0;
            if (verdict.reason != Reason::first_hit) continue;
            ++firsts;
            ASSERT_EQ(verdict.face, hit.value().face);
        }
        ASSERT_EQ(firsts, hit ? 1U : 0U);
        ASSERT_EQ(firsts + laters, mesh.all_hits(segment, all));
    }
}

}  // namespace
}  // namespace pierce::test
