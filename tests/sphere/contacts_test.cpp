// Contacts come once: of a ball at rest, and of a step.
#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using Hits = std::array<SphereHit<float>, 64>;

CollisionMesh<float> mesh_of(const TriangleSoup<double>& soup) {
    return CollisionMesh<float>(moved<float>(soup, 1, {0, 0, 0}).view());
}

/// A floor of n x n squares of two triangles each in z = 0, whose corners are whole numbers.
TriangleSoup<double> squares(int n) {
    TriangleSoup<double> soup = terrain(n, 0, 1);
    for (Vec3<double>& p : soup.positions) p = (p * n / 2).array().round().matrix();
    return soup;
}

TEST(SphereContacts, AFloorIsOneContactWhereverTheBallIs) {
    const auto mesh = mesh_of(squares(8));
    Hits hits;
    // On a face, an edge, a diagonal, a vertex; with a small and a large ball.
    for (const float r : {0.25F, 3.5F}) {
        const float z = r - 0.125F;
        for (const Vec3<float>& at :
             {Vec3<float>(0.3F, 0.2F, z), Vec3<float>(0.5F, 1, z), Vec3<float>(0.5F, 0.5F, z), Vec3<float>(1, 1, z)}) {
            ASSERT_EQ(mesh.sphere_contacts(at, r, hits), 1U) << at.transpose() << " r " << r;
            EXPECT_EQ(hits[0].overlap, 0.125F);
            EXPECT_EQ(hits[0].contact, Vec3<float>(at[0], at[1], 0));
            EXPECT_EQ(hits[0].normal, Vec3<float>(0, 0, 1));
            EXPECT_EQ(hits[0].center, at);
            ASSERT_EQ(mesh.sphere_hits({{at[0], at[1], 9}, {at[0], at[1], z}}, r, hits), 1U);
            EXPECT_EQ(hits[0].contact, Vec3<float>(at[0], at[1], 0));
        }
    }
}

TEST(SphereContacts, TouchingCountsAndBeyondDoesNot) {
    const auto mesh = mesh_of(squares(4));
    Hits hits;
    EXPECT_EQ(mesh.sphere_contacts({0.3F, 0.2F, 0.5F}, 0.5F, hits), 1U);
    EXPECT_EQ(hits[0].overlap, 0);
    EXPECT_EQ(mesh.sphere_contacts({0.3F, 0.2F, std::nextafter(0.5F, 1.0F)}, 0.5F, hits), 0U);
    EXPECT_EQ(mesh.sphere_contacts({0.3F, 0.2F, std::nextafter(0.5F, 0.0F)}, 0.5F, hits), 1U);
    EXPECT_GT(hits[0].overlap, 0);
    // The center on the surface.
    EXPECT_EQ(mesh.sphere_contacts({0.3F, 0.2F, 0}, 0.5F, hits), 1U);
    EXPECT_EQ(hits[0].overlap, 0.5F);
    EXPECT_EQ(hits[0].normal, Vec3<float>(0, 0, 1));
}

TEST(SphereContacts, WallsAreOneEach) {
    // The inside of a cube.
    const auto mesh = mesh_of(turned_inside_out(polycube(1, 1, 2, 1)));
    Hits hits;
    EXPECT_EQ(mesh.sphere_contacts({1, 1, 0.25F}, 0.5F, hits), 1U);
    EXPECT_EQ(mesh.sphere_contacts({1, 0.25F, 0.375F}, 0.5F, hits), 2U);
    EXPECT_NEAR(hits[0].overlap, 0.25F, 1e-6);
    EXPECT_EQ(hits[0].normal, Vec3<float>(0, 1, 0));
    EXPECT_EQ(hits[1].normal, Vec3<float>(0, 0, 1));
    EXPECT_EQ(mesh.sphere_contacts({0.25F, 0.25F, 0.375F}, 0.5F, hits), 3U);
    EXPECT_EQ(mesh.sphere_contacts({1, 1, 1}, 1.5F, hits), 6U);
    // The count is complete where not all fit; the deepest are kept.
    std::array<SphereHit<float>, 1> one;
    EXPECT_EQ(mesh.sphere_contacts({1, 0.25F, 0.375F}, 0.5F, one), 2U);
    EXPECT_EQ(one[0].normal, Vec3<float>(0, 1, 0));
    EXPECT_EQ(mesh.sphere_contacts({1, 1, 1}, 1.5F, {}), 6U);
    // From the outside: an edge and a corner of the cube.
    EXPECT_EQ(mesh.sphere_contacts({-0.25F, 1, -0.25F}, 0.5F, hits), 1U);
    EXPECT_EQ(hits[0].feature, Feature::edge);
    EXPECT_EQ(mesh.sphere_contacts({-0.25F, -0.25F, -0.25F}, 0.5F, hits), 1U);
    EXPECT_EQ(hits[0].feature, Feature::vertex);
    EXPECT_EQ(hits[0].contact, Vec3<float>(0, 0, 0));
    // A step through all of it: the walls that it meets, in order.
    ASSERT_EQ(mesh.sphere_hits({{1.25F, 1, 5}, {1.25F, 1, -5}}, 0.25F, hits), 2U);
    EXPECT_NEAR(hits[0].fraction, 0.275, 1e-6);
    EXPECT_NEAR(hits[1].fraction, 0.475, 1e-6);
    EXPECT_EQ(hits[1].contact, Vec3<float>(1.25F, 1, 0));
    ASSERT_EQ(mesh.sphere_hits({{1.25F, 1, 5}, {1.25F, 1, -5}}, 0.25F, one), 2U);
    EXPECT_NEAR(one[0].fraction, 0.275, 1e-6);
    ASSERT_EQ(mesh.sphere_hits({{1.25F, 1, 5}, {1.25F, 1, -5}}, 0.25F, hits, {.max_fraction = 0.4}), 1U);
    ASSERT_EQ(mesh.sphere_hits({{-5, -0.125F, -0.125F}, {5, -0.125F, -0.125F}}, 0.25F, hits), 1U);
    EXPECT_EQ(hits[0].feature, Feature::vertex);
}

TEST(SphereContacts, DuplicatesAndMasks) {
    TriangleSoup<double> soup = squares(4);
    const TriangleSoup<double> copy = soup;
    append(soup, copy);
    for (std::size_t i = soup.triangles.size() / 2; i < soup.triangles.size(); ++i)
        std::rotate(soup.triangles[i].begin(), soup.triangles[i].begin() + 1, soup.triangles[i].end());
    const auto mesh = mesh_of(soup);
    Hits hits;
    for (const Vec3<float>& at :
         {Vec3<float>(0.3F, 0.2F, 0.25F), Vec3<float>(0.5F, 1, 0.25F), Vec3<float>(1, 1, 0.25F)}) {
        EXPECT_EQ(mesh.sphere_contacts(at, 0.5F, hits), 1U);
        EXPECT_EQ(mesh.sphere_hits({{at[0], at[1], 3}, at}, 0.5F, hits), 1U);
    }
    ASSERT_EQ(mesh.sphere_contacts({0.3F, 0.2F, 0.25F}, 0.5F, hits), 1U);
    // Without the face below the ball its neighbours' edge is the contact.
    std::vector<std::uint8_t> mask(soup.triangles.size(), 1);
    mask[hits[0].face] = mask[hits[0].face + soup.triangles.size() / 2] = 0;
    ASSERT_GE(mesh.sphere_contacts({0.3F, 0.2F, 0.25F}, 0.5F, hits, {.face_mask = mask}), 1U);
    EXPECT_EQ(hits[0].feature, Feature::edge);
    EXPECT_EQ(mesh.sphere_contacts({0.3F, 0.2F, 0.25F}, 0.5F, hits, {.accept = [](const Contact&) { return false; }}),
              0U);
}

// On any closed surface: no two contacts in one place, the first of a step is that of the sweep, and there is one where
// the sweep says so.
TEST(SphereContacts, OnceEachOnSurfacesOfAllKinds) {
    Random random(5);
    for (const TriangleSoup<double>& soup :
         {bumpy_sphere(8), polycube(3, 0.5, 1, 3), shards(200, 4), terrain(20, 0.2, 5)}) {
        const auto mesh = mesh_of(soup);
        int several = 0;
        for (int i = 0; i < 2000; ++i) {
            const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
            const Vec3<double> target = soup.positions[t[0]];
            const double r = std::pow(10, random.between(-2, 0));
            const Vec3<double> from = target + 2 * r * random.in_cube();
            const Vec3<double> to = target + r * random.in_cube();
            const Segment<float> step{from.cast<float>(), to.cast<float>()};
            const auto radius = static_cast<float>(r);
            Hits hits;
            const std::size_t count = mesh.sphere_hits(step, radius, hits);
            const auto first = mesh.sweep_sphere(step, radius);
            ASSERT_EQ(count > 0, first.has_value());
            several += count > 1 ? 1 : 0;
            if (first && !first->at_start) {
                EXPECT_EQ(hits[0].fraction, first->fraction);
                EXPECT_EQ(hits[0].face, first->face);
            }
            const auto apart = [&](std::size_t kept) {
                for (std::size_t k = 0; k < kept; ++k)
                    for (std::size_t l = 0; l < k; ++l)
                        EXPECT_FALSE(hits[k].feature != Feature::face && hits[k].feature == hits[l].feature &&
                                     hits[k].contact == hits[l].contact);
                for (std::size_t k = 1; k < kept; ++k) EXPECT_GE(hits[k].fraction, hits[k - 1].fraction);
            };
            apart(std::min(count, hits.size()));
            const std::size_t touching = mesh.sphere_contacts(step.to, radius, hits);
            apart(std::min(touching, hits.size()));
            for (std::size_t k = 1; k < std::min(touching, hits.size()); ++k)
                EXPECT_LE(hits[k].overlap, hits[k - 1].overlap);
        }
        EXPECT_GT(several, 100);
    }
}

}  // namespace
}  // namespace pierce::test
