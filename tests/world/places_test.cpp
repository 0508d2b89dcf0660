// Points and passages of worlds: each mesh by itself says the same about the images, and the order is that of exact
// fractions.
#include <algorithm>

#include <world/made_world.h>

namespace pierce::test {
namespace {

template <class Scalar>
class WorldPlaces : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldPlaces, Scalars);

bool same(const FaceTouch& x, const FaceTouch& y) {
    return x.face == y.face && x.triangle == y.triangle && x.feature == y.feature &&
           x.feature_index == y.feature_index && x.crossing == y.crossing;
}

TYPED_TEST(WorldPlaces, points_are_where_the_meshes_say) {
    using Scalar = TypeParam;
    std::size_t on_surface = 0;
    std::size_t inside = 0;
    std::size_t of_many = 0;
    for (const double offset : {0.0, 1000.0}) {
        MadeWorld<Scalar> made(offset, 11);
        for (int i = 0; i < 14; ++i) made.add();
        for (int i = 0; i < 1500; ++i) {
            if (i % 8 == 0) made.change();
            const Vec3<Scalar> point = i % 2 == 0 ? made.segment().to : made.middle();
            const std::uint32_t mask = i % 3 == 0 ? 7 : 0xffffffff;
            std::vector<WorldTouch> expected;
            std::vector<MeshId> expected_meshes;
            int sum = 0;
            for (const auto& member : made.naive.members) {
                if ((member.layers & mask) == 0) continue;
                std::vector<FaceTouch> touches(99);
                const Location here = member.mesh->locate(made.world.to_mesh(member.id, point), touches);
                ASSERT_LE(here.face_count, touches.size());
                sum += here.winding_number;
                if (here.winding_number != 0) expected_meshes.push_back(member.id);
                for (std::size_t k = 0; k < here.face_count; ++k) expected.push_back({touches[k], member.id});
            }
            const auto by_mesh = [](MeshId x, MeshId y) { return x.index < y.index; };
            std::sort(expected_meshes.begin(), expected_meshes.end(), by_mesh);
            std::stable_sort(expected.begin(), expected.end(),
                             [&](const WorldTouch& x, const WorldTouch& y) { return by_mesh(x.mesh, y.mesh); });
            std::vector<WorldTouch> touches(expected.size() / 2 + 1);
            const Location location = made.world.locate(point, touches, {.mask = mask});
            EXPECT_EQ(location.winding_number, sum);
            EXPECT_EQ(location.winding_number, made.world.winding_number(point, {.mask = mask}));
            ASSERT_EQ(location.face_count, expected.size());
            EXPECT_EQ(location.place, !expected.empty() ? Place::on_surface
                                      : sum != 0        ? Place::inside
                                                        : Place::outside);
            for (std::size_t k = 0; k < std::min(touches.size(), expected.size()); ++k)
                EXPECT_TRUE(touches[k].mesh == expected[k].mesh && same(touches[k].touch, expected[k].touch));
            std::vector<MeshId> meshes(expected_meshes.size() / 2 + 1);
            ASSERT_EQ(made.world.containing(point, meshes, {.mask = mask}), expected_meshes.size());
            for (std::size_t k = 0; k < std::min(meshes.size(), expected_meshes.size()); ++k)
                EXPECT_EQ(meshes[k], expected_meshes[k]);
            on_surface += std::size_t{location.place == Place::on_surface};
            inside += std::size_t{location.place == Place::inside};
            of_many += std::size_t{expected_meshes.size() > 1};
        }
    }
    EXPECT_GT(on_surface, 50U);
    EXPECT_GT(inside, 500U);
    EXPECT_GT(of_many, 200U);
}

TYPED_TEST(WorldPlaces, passages_are_those_of_the_meshes_in_order) {
    using Scalar = TypeParam;
    struct Expected {
        const typename NaiveWorld<Scalar>::Member* member;
        Passage<Scalar> passage;
        mpq_class fraction;
        std::vector<FaceTouch> faces;
    };
    std::size_t total = 0;
    std::size_t ties = 0;
    std::size_t long_rows = 0;
    std::size_t sums = 0;
    for (const double offset : {0.0, 1000.0}) {
        MadeWorld<Scalar> made(offset, 12);
        for (int i = 0; i < 20; ++i) made.add();
        for (int i = 0; i < 500; ++i) {
            made.change();
            Segment<Scalar> segment = made.segment();
            const WorldOptions any = made.options();
            WorldPassageOptions options{
                .sides = i % 2 == 0 ? Sides::both : any.sides, .mask = any.mask, .accept = any.accept};
            if (i % 4 == 0) options.max_fraction = made.random.unit();
            const WorldOptions same_options{
                .sides = options.sides, .max_fraction = options.max_fraction, .mask = any.mask, .accept = any.accept};
            std::vector<Expected> expected;
            int crossings = 0;
            for (const auto& member : made.naive.members) {
                if ((member.layers & options.mask) == 0) continue;
                const Segment<Scalar> local = made.naive.image(member, segment);
                std::vector<std::uint8_t> mask;
                const QueryOptions here = made.naive.options_in(member, same_options, mask);
                const PassageOptions there{.sides = here.sides,
                                           .max_fraction = here.max_fraction,
                                           .face_mask = here.face_mask,
                                           .accept = here.accept};
                std::vector<Passage<Scalar>> passages(member.mesh->passages(local, {}, there));
                std::vector<FaceTouch> faces(999);
                member.mesh->passages(local, passages, there, faces);
                for (const Passage<Scalar>& p : passages) {
                    const auto first = faces.begin() + static_cast<std::ptrdiff_t>(p.first_face);
                    expected.push_back({&member,
                                        p,
                                        p.at_end ? mpq_class(1) : made.naive.fraction_of(member, local, p.triangle),
                                        {first, first + static_cast<std::ptrdiff_t>(p.face_count)}});
                    crossings += p.crossings;
                }
            }
            std::stable_sort(expected.begin(), expected.end(), [](const Expected& x, const Expected& y) {
                return x.fraction != y.fraction ? x.fraction < y.fraction : x.member->id.index < y.member->id.index;
            });
            std::vector<WorldPassage<Scalar>> passages(expected.size());
            std::vector<FaceTouch> faces(999);
            ASSERT_EQ(made.world.passages(segment, passages, options, faces), expected.size());
            std::size_t first_face = 0;
            for (std::size_t k = 0; k < expected.size(); ++k) {
                const Passage<Scalar>& x = passages[k].passage;
                const Passage<Scalar>& y = expected[k].passage;
                ASSERT_EQ(passages[k].mesh, expected[k].member->id) << to_text(segment);
                EXPECT_EQ(x.triangle, y.triangle);
                EXPECT_EQ(x.face, y.face);
                EXPECT_EQ(x.fraction, y.fraction);
                EXPECT_EQ(x.crossings, y.crossings);
                EXPECT_EQ(x.kind, y.kind);
                EXPECT_EQ(x.side, y.side);
                EXPECT_EQ(x.feature, y.feature);
                EXPECT_EQ(x.at_start, y.at_start);
                EXPECT_EQ(x.at_end, y.at_end);
                EXPECT_EQ(x.first_face, first_face);
                ASSERT_EQ(x.face_count, y.face_count);
                const Vec3<Scalar> at = x.at_start ? segment.from
                                        : x.at_end ? segment.to
                                                   : made.world.to_world(passages[k].mesh, y.position.vec());
                EXPECT_EQ(x.position.vec(), at);
                EXPECT_NEAR(double(x.normal.norm()), 1, 1e-6);
                for (std::size_t f = 0; f < x.face_count; ++f)
                    EXPECT_TRUE(same(faces[first_face + f], expected[k].faces[f]));
                first_face += x.face_count;
                if (k > 0 && expected[k].fraction == expected[k - 1].fraction) ++ties;
            }
            total += expected.size();
            long_rows += std::size_t{expected.size() > 32};
            // The first few alone.
            options.count_all = false;
            std::vector<WorldPassage<Scalar>> few(2);
            const std::size_t count = made.world.passages(segment, few, options);
            ASSERT_EQ(count, std::min<std::size_t>(2, expected.size()));
            for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(few[k].passage.triangle, passages[k].passage.triangle);
            if (options.sides == Sides::both && !options.accept && options.max_fraction == 1.0 &&
                std::all_of(made.naive.members.begin(), made.naive.members.end(),
                            [](const auto& member) { return member.face_layers.empty(); })) {
                EXPECT_EQ(crossings, made.world.crossings(segment, {.mask = options.mask}));
                ++sums;
            }
        }
    }
    std::cout << total << " passages, " << ties << " ties, " << long_rows << " long rows, " << sums << " sums\n";
    EXPECT_GT(total, 3000U);
    EXPECT_GT(ties, 10U);
}

// More than one traversal's worth, where many meshes coincide.
TYPED_TEST(WorldPlaces, passages_of_meshes_that_coincide_stay_apart) {
    using Scalar = TypeParam;
    World<Scalar> world;
    const auto cube = shared_mesh(moved<Scalar>(polycube(1, 1, 1, 1), 2, {-1, -1, -1}));
    std::vector<MeshId> ids;
    for (int i = 0; i < 50; ++i) ids.push_back(world.add(cube));
    InstanceOptions<Scalar> turned;
    turned.pose.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    for (int i = 0; i < 20; ++i) ids.push_back(world.add(cube, turned));
    const Segment<Scalar> segment{{Scalar(-3), Scalar(0.25), Scalar(0.125)}, {Scalar(3), Scalar(0.25), Scalar(0.125)}};
    std::vector<WorldPassage<Scalar>> passages(200);
    ASSERT_EQ(world.passages(segment, passages), 140U);
    for (std::size_t k = 0; k < 140; ++k) {
        EXPECT_EQ(passages[k].mesh, ids[k % 70]);
        EXPECT_EQ(passages[k].passage.kind, k < 70 ? PassageKind::entering : PassageKind::leaving);
        EXPECT_EQ(passages[k].passage.face_count, 1U);
    }
    EXPECT_EQ(world.passages(segment, passages, {.mask = 0}), 0U);
    EXPECT_EQ(world.passages(segment, passages, {.max_fraction = std::numeric_limits<double>::quiet_NaN()}), 0U);
}

TYPED_TEST(WorldPlaces, every_face_is_explained) {
    using Scalar = TypeParam;
    std::size_t firsts = 0;
    std::size_t laters = 0;
    MadeWorld<Scalar> made(0, 13);
    for (int i = 0; i < 10; ++i) made.add();
    for (int i = 0; i < 150; ++i) {
        if (i % 5 == 0) made.change();
        const Segment<Scalar> segment = made.segment();
        const WorldOptions options = made.options();
        const auto verdicts = made.world.explain(segment, options);
        const auto hit = made.world.first_hit(segment, options);
        std::size_t first_here = 0;
        std::size_t later_here = 0;
        for (std::size_t k = 0; k < verdicts.size(); ++k) {
            const auto& [verdict, mesh] = verdicts[k];
            EXPECT_LE(verdicts[k > 0 ? k - 1 : 0].mesh.index, mesh.index);
            if (verdict.reason == Reason::later) ++later_here;
            if (verdict.reason != Reason::first_hit) continue;
            ++first_here;
            ASSERT_TRUE(hit);
            EXPECT_EQ(mesh, hit->mesh);
            EXPECT_EQ(verdict.triangle, hit->hit.triangle);
        }
        EXPECT_EQ(first_here, hit ? 1U : 0U);
        EXPECT_EQ(first_here + later_here, made.naive.all_hits(segment, options).size());
        firsts += first_here;
        laters += later_here;
    }
    EXPECT_GT(firsts, 50U);
    EXPECT_GT(laters, 50U);
}

}  // namespace
}  // namespace pierce::test
