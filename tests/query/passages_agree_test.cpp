// Passages against rational arithmetic on all triangles, against crossings and winding numbers on lattices, where
// nearly every segment is degenerate, and against all_hits.
#include <algorithm>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/moved_oracle.h>
#include <support/passages_oracle.h>
#include <support/real_meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

/// Compares all of a query with what rational arithmetic expects.
template <class Scalar>
void expect_passages(const CollisionMesh<Scalar>& mesh, const Segment<Scalar>& segment, const PassageOptions& options,
                     const ExpectedPassages& expected) {
    std::array<Passage<Scalar>, 48> passages;
    std::array<FaceTouch, 400> faces;
    ASSERT_EQ(mesh.passages(segment, passages, options, faces), expected.size());
    ASSERT_LE(expected.size(), passages.size());
    std::size_t i = 0;
    std::size_t first_face = 0;
    for (const auto& [fraction, place] : expected) {
        const Passage<Scalar>& passage = passages[i];
        SCOPED_TRACE("passage " + std::to_string(i++));
        EXPECT_LE(ulps(passage.fraction, fraction, CGAL::to_double(fraction)), 1);
        EXPECT_EQ(passage.at_start, fraction == RationalOracle::Q(0));
        EXPECT_EQ(passage.at_end, fraction == RationalOracle::Q(1));
        EXPECT_EQ(passage.crossings, place.crossings);
        EXPECT_EQ(passage.kind, place.crossings > 0   ? PassageKind::entering
                                : place.crossings < 0 ? PassageKind::leaving
                                                      : PassageKind::grazing);
        ASSERT_EQ(passage.face_count, place.faces.size());
        ASSERT_EQ(passage.first_face, first_face);
        first_face += passage.face_count;
        for (int k = 0; k < 3; ++k) {
            const RationalOracle::Q from(double(segment.from[k]));
            const RationalOracle::Q at = from + fraction * (RationalOracle::Q(double(segment.to[k])) - from);
            EXPECT_LE(ulps(passage.position[k], at, CGAL::to_double(at)), 0.5);
        }
        const std::vector<FaceTouch>& touches = place.faces;
        std::vector<std::size_t> order(touches.size());
        for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
        std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
            const auto key = [](const FaceTouch& touch) { return std::pair(touch.face, touch.triangle); };
            return key(touches[x]) < key(touches[y]);
        });
        bool chosen = false;
        for (std::size_t j = 0; j < order.size(); ++j) {
            const FaceTouch& face = faces[passage.first_face + j];
            const FaceTouch& other = place.faces[order[j]];
            EXPECT_EQ(face.face, other.face);
            EXPECT_EQ(face.triangle, other.triangle);
            EXPECT_EQ(face.feature, other.feature);
            EXPECT_EQ(face.feature_index, other.feature_index);
            EXPECT_EQ(face.crossing, other.crossing);
            const Sides side = place.sides[order[j]];
            const Sides wanted = place.crossings > 0 ? Sides::front : place.crossings < 0 ? Sides::back : Sides::both;
            if (chosen || (wanted != Sides::both && wanted != side)) continue;
            chosen = true;
            EXPECT_EQ(passage.triangle, other.triangle);
            EXPECT_EQ(passage.face, other.face);
            EXPECT_EQ(passage.side, side);
            EXPECT_EQ(passage.feature, other.feature);
            EXPECT_EQ(passage.feature_index, other.feature_index);
        }
    }
}

// Oblique triangles with whole-numbered corners, and segments through them: nearly all of it is degenerate.
TEST(Passages, agree_with_rational_arithmetic_on_lattices) {
    Random random(4);
    std::size_t met = 0;
    std::size_t degenerate = 0;
    for (int m = 0; m < 150; ++m) {
        const auto whole = [&] {
            const int x = random.between_ints(-3, 3);
            const int y = random.between_ints(-3, 3);
            return LatticePoint{x, y, random.between_ints(-3, 3)};
        };
        const auto point = [](const LatticePoint& p) { return V(p[0], p[1], p[2]); };
        TriangleSoup<double> soup;
        std::vector<MovedOracle::Triangle> triangles;
        for (std::uint32_t i = 0; i < 25; ++i) {
            const LatticePoint a = whole();
            const LatticePoint b = whole();
            triangles.push_back({a, b, whole()});
            if (i % 8 == 7) triangles.back() = triangles[i / 2];  // twice
            add_triangle(soup, point(triangles.back()[0]), point(triangles.back()[1]), point(triangles.back()[2]));
            soup.faces.push_back(i * 7 % 13);
        }
        const CollisionMesh<double> mesh(soup.view());
        std::vector<std::uint8_t> mask(10, 1);
        mask[3] = 0;
        for (int i = 0; i < 60; ++i) {
            const LatticePoint p = whole();
            const LatticePoint q = whole();
            const Segment<double> segment{point(p), point(q)};
            PassageOptions options;
            if (i % 3 == 1) options.sides = random.chance(0.5) ? Sides::front : Sides::back;
            if (i % 4 == 1) options.face_mask = mask;
            if (i % 5 == 1) options.max_fraction = random.between_ints(0, 4) / 4.0;
            const ExpectedPassages expected = expected_passages(
                soup.view(), segment, options,
                [&](std::uint32_t triangle) { return MovedOracle::crossing(triangles[triangle], p, q); });
            expect_passages(mesh, segment, options, expected);
            if (testing::Test::HasFailure()) return;
            met += expected.size();
            for (const auto& [fraction, place] : expected) degenerate += place.faces.size() > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(met, 10'000U);
    EXPECT_GT(degenerate, 1'500U);
}

TEST(Passages, agree_with_rational_arithmetic_on_triangles_of_all_shapes) {
    for (const double scale : {1.0, 1e-300, 1e150}) {
        const TriangleSoup<double> soup = moved<double>(shards(300, 2), scale, V(0, 0, 0));
        const CollisionMesh<double> mesh(soup.view());
        const Extent<double> extent(soup.view());
        Random random(3);
        for (int i = 0; i < 200; ++i) {
            const Segment<double> segment = mixed_segment(soup.view(), extent, random);
            const auto exactly = [&](std::uint32_t triangle) {
                detail::Corners corners;
                for (std::size_t k = 0; k < 3; ++k)
                    corners[k] = detail::to_point(soup.positions[soup.triangles[triangle][k]]);
                return detail::crossing(detail::to_path(segment), corners);
            };
            expect_passages(mesh, segment, {}, expected_passages(soup.view(), segment, {}, exactly));
            if (testing::Test::HasFailure()) return;
        }
    }
}

// Sum and parts: on segments (1.2 million in the slow test) between points of the lattice of half a cube's edge, aimed
// at edges and vertices, in planes of faces, starting and ending on the surface.
template <class Scalar>
void lattice_passages(double offset, int meshes, int segments, bool check_middles) {
    std::size_t met = 0;
    std::size_t grazed = 0;
    for (int m = 0; m < meshes; ++m) {
        const Polycube poly(4, 0.45, 4, static_cast<std::uint64_t>(m));
        const V shift = V(1, -2, 1) * offset;
        const CollisionMesh<Scalar> mesh(moved<Scalar>(poly.soup, 1, shift).view());
        Random random(static_cast<std::uint64_t>(m) + 50);
        const auto lattice_point = [&] {
            const double x = 2.0 * random.between_ints(-2, 10);
            const double y = 2.0 * random.between_ints(-2, 10);
            return V(x, y, 2.0 * random.between_ints(-2, 10));
        };
        for (int i = 0; i < segments; ++i) {
            const V p = lattice_point();
            V q = lattice_point();
            for (int k = 0; k < 3; ++k)
                if (random.chance(0.3)) q[k] = p[k];
            const Segment<Scalar> segment{(p + shift).cast<Scalar>(), (q + shift).cast<Scalar>()};
            std::array<Passage<Scalar>, 32> passages;
            const std::size_t count = mesh.passages(segment, passages);
            ASSERT_LE(count, passages.size());
            const auto all = std::span(passages).first(count);
            int sum = 0;
            for (const Passage<Scalar>& passage : all) {
                sum += passage.crossings;
                grazed += passage.kind == PassageKind::grazing ? 1U : 0U;
            }
            met += count;
            ASSERT_EQ(sum, mesh.crossings(segment)) << p.transpose() << " -> " << q.transpose();
            ASSERT_EQ(sum, int(poly.inside_when_moved(q)) - int(poly.inside_when_moved(p)));
            if (!check_middles || i % 4 != 0) continue;
            // Sixteenths of the way are exact; where one is a passage itself it is neither before it nor behind.
            for (int part = 1; part < 16; ++part) {
                const double at = part / 16.0;
                int winding = int(poly.inside_when_moved(p));
                bool on = false;
                for (const Passage<Scalar>& passage : all) {
                    if (double(passage.fraction) == at) on = true;
                    if (double(passage.fraction) < at) winding += passage.crossings;
                }
                if (on) continue;
                const V middle = p + at * (q - p);
                ASSERT_EQ(winding, int(poly.inside_when_moved(middle))) << p.transpose() << " -> " << q.transpose();
                ASSERT_EQ(winding, mesh.winding_number((middle + shift).cast<Scalar>()));
            }
        }
    }
    EXPECT_GT(met, std::size_t(meshes * segments));
    EXPECT_GT(grazed, std::size_t(meshes * segments / 20));
}

TEST(Passages, add_up_to_crossings_and_winding_numbers_on_lattices) {
    lattice_passages<double>(0, 2, 25'000, true);
    lattice_passages<float>(0, 2, 25'000, true);
    lattice_passages<double>(1e9, 1, 25'000, true);
    lattice_passages<float>(1e6, 1, 25'000, false);
}

TEST(PassagesSoak, add_up_to_crossings_and_winding_numbers_on_lattices) {
    lattice_passages<double>(0, 8, 50'000, true);
    lattice_passages<float>(0, 8, 50'000, true);
    lattice_passages<double>(1e9, 4, 50'000, true);
    lattice_passages<float>(1e6, 4, 50'000, false);
}

/// Each hit lies in one passage, whose values are its own where it is the one that stands for it.
template <class Scalar>
void expect_hits_in_passages(const CollisionMesh<Scalar>& mesh, const Segment<Scalar>& segment) {
    std::array<Passage<Scalar>, 64> passages;
    std::vector<FaceTouch> faces(2000);
    const std::size_t count = std::min(mesh.passages(segment, passages, {}, faces), passages.size());
    std::vector<Hit<Scalar>> hits(2000);
    hits.resize(std::min(mesh.all_hits(segment, hits, {.sides = Sides::both}), hits.size()));
    std::size_t at = 0;
    int sum = 0;
    for (const Passage<Scalar>& passage : std::span(passages).first(count)) {
        sum += passage.crossings;
        if (passage.first_face + passage.face_count > faces.size()) return;
        for (std::size_t i = 0; i < passage.face_count; ++i) {
            if (at == hits.size()) break;
            const Hit<Scalar>& hit = hits[at];
            if (hit.triangle != faces[passage.first_face + i].triangle) continue;
            ++at;
            for (int k = 0; k < 3; ++k) ASSERT_EQ(hit.position[k], passage.position[k]);
            if (hit.triangle != passage.triangle) continue;
            ASSERT_EQ(hit.face, passage.face);
            for (int k = 0; k < 3; ++k) ASSERT_EQ(hit.normal[k], passage.normal[k]);
            ASSERT_EQ(hit.feature, passage.feature);
            ASSERT_EQ(hit.feature_index, passage.feature_index);
            ASSERT_EQ(hit.side, passage.side);
            ASSERT_EQ(hit.at_start, passage.at_start);
            ASSERT_TRUE(passage.at_end || hit.exact_fraction == passage.fraction);
        }
    }
    if (count < passages.size()) {
        ASSERT_EQ(at, hits.size());
        ASSERT_EQ(sum, mesh.crossings(segment));
    }
}

class PassagesRealMeshes : public ::testing::TestWithParam<std::string_view> {};

TEST_P(PassagesRealMeshes, agree_with_hits_and_crossings) {
    const auto compare = [](const auto& soup) {
        const CollisionMesh mesh(soup.view());
        const Extent extent(soup.view());
        Random random(8);
        for (int i = 0; i < 10'000; ++i) {
            const auto segment = mixed_segment(soup.view(), extent, random);
            expect_hits_in_passages(mesh, segment);
            ASSERT_FALSE(testing::Test::HasFatalFailure()) << segment.from.transpose() << " " << segment.to.transpose();
        }
    };
    compare(real_mesh<double>(GetParam()));
    compare(real_mesh<float>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Debian, PassagesRealMeshes, ::testing::ValuesIn(k_real_meshes),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace pierce::test
