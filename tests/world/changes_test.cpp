// What a world may be told: ids, poses, meshes that are shared or empty, layers, copies, and what it refuses.
#include <gtest/gtest.h>
#include <pierce/world.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <world/naive_world.h>

namespace pierce::test {
namespace {

template <class Scalar>
class WorldChanges : public ::testing::Test {
  public:
    using Vec = Vec3<Scalar>;
    using Mesh = std::shared_ptr<const CollisionMesh<Scalar>>;

    static Mesh cube(double edge = 2) {
        return shared_mesh(moved<Scalar>(polycube(1, 1, 1, 1), edge, Vec3<double>::Constant(-edge / 2)));
    }
    static InstanceOptions<Scalar> at(double x, double y, double z) {
        InstanceOptions<Scalar> options;
        options.pose.translation = Vec3<double>(x, y, z).template cast<Scalar>();
        return options;
    }
    static Segment<Scalar> along_x(double from, double to, double y = 0.25, double z = 0.125) {
        return {Vec3<double>(from, y, z).cast<Scalar>(), Vec3<double>(to, y, z).cast<Scalar>()};
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldChanges, Scalars);

TYPED_TEST(WorldChanges, an_empty_world_answers_nothing) {
    World<TypeParam> world;
    const auto segment = this->along_x(-9, 9);
    EXPECT_FALSE(world.first_hit(segment));
    EXPECT_FALSE(world.any_hit(segment));
    EXPECT_EQ(world.all_hits(segment, {}), 0U);
    EXPECT_EQ(world.crossings(segment), 0);
    EXPECT_EQ(world.winding_number(segment.from), 0);
    EXPECT_FALSE(world.contains(segment.from));
    EXPECT_EQ(world.containing(segment.from, {}), 0U);
    EXPECT_EQ(world.locate(segment.from).place, Place::outside);
    EXPECT_EQ(world.passages(segment, {}), 0U);
    EXPECT_FALSE(world.sweep_sphere(segment, TypeParam(1)));
    EXPECT_TRUE(world.explain(segment).empty());
    EXPECT_FALSE(world.first_hit(Ray<TypeParam>{segment.from, segment.to}));
    EXPECT_EQ(world.size(), 0U);
    EXPECT_FALSE(world.holds({}));
    EXPECT_FALSE(world.remove({}));
    EXPECT_EQ(world.statistics().meshes, 0U);
    EXPECT_EQ(world.statistics().depth, 0U);
}

TYPED_TEST(WorldChanges, empty_meshes_are_never_hit) {
    World<TypeParam> world;
    const auto empty = std::make_shared<const CollisionMesh<TypeParam>>();
    const MeshId none = world.add(empty, this->at(1, 2, 3));
    const auto segment = this->along_x(-9, 9);
    EXPECT_FALSE(world.first_hit(segment));
    const MeshId id = world.add(this->cube());
    EXPECT_EQ(world.first_hit(segment)->mesh, id);
    world.replace(none, this->cube());
    EXPECT_TRUE(world.any_hit(this->along_x(-2, 2, 2.25, 3))) << "it keeps its pose";
    world.replace(none, empty);
    EXPECT_FALSE(world.any_hit(this->along_x(-2, 2, 2.25, 3)));
    world.set_pose(none, this->at(5, 5, 5).pose);
    EXPECT_TRUE(world.remove(none));
    EXPECT_EQ(world.first_hit(segment)->mesh, id);
    EXPECT_EQ(world.size(), 1U);
}

TYPED_TEST(WorldChanges, stale_ids_are_noticed) {
    World<TypeParam> world;
    const MeshId first = world.add(this->cube());
    EXPECT_TRUE(world.holds(first));
    EXPECT_TRUE(world.remove(first));
    EXPECT_FALSE(world.remove(first)) << "once";
    const MeshId second = world.add(this->cube(), this->at(4, 0, 0));
    EXPECT_EQ(second.index, first.index);
    EXPECT_NE(second.generation, first.generation);
    EXPECT_FALSE(world.holds(first));
    EXPECT_FALSE(world.remove(first));
    EXPECT_THROW(world.set_pose(first, {}), std::invalid_argument);
    EXPECT_THROW(world.replace(first, this->cube()), std::invalid_argument);
    EXPECT_THROW(world.set_layers(first, 1), std::invalid_argument);
    EXPECT_THROW(world.set_face_layers(first, nullptr), std::invalid_argument);
    EXPECT_EQ(world.mesh(first), nullptr);
    EXPECT_NE(world.mesh(second), nullptr);
    const Vec3<TypeParam> p(1, 2, 3);
    EXPECT_NE(world.to_mesh(first, p)[0], world.to_mesh(first, p)[0]) << "not a number";
    EXPECT_EQ(world.to_mesh(second, p), Vec3<TypeParam>(-3, 2, 3));
    EXPECT_EQ(world.to_world(second, p), Vec3<TypeParam>(5, 2, 3));
    EXPECT_FALSE(world.holds({7, 1}));
    EXPECT_FALSE(world.holds({second.index, second.generation + 1}));
    EXPECT_EQ(world.first_hit(this->along_x(-9, 9))->mesh, second);
}

TYPED_TEST(WorldChanges, what_is_refused_changes_nothing) {
    World<TypeParam> world;
    const MeshId id = world.add(this->cube(), this->at(4, 0, 0));
    const auto before = world.first_hit(this->along_x(-9, 9));
    Pose<TypeParam> bad;
    bad.rotation *= TypeParam(2);
    EXPECT_THROW(world.set_pose(id, bad), std::invalid_argument);
    EXPECT_THROW((void)world.add(this->cube(), {.pose = bad}), std::invalid_argument);
    EXPECT_THROW((void)world.add(nullptr), std::invalid_argument);
    EXPECT_THROW(world.replace(id, nullptr), std::invalid_argument);
    bad = {};
    bad.translation[1] = std::numeric_limits<TypeParam>::quiet_NaN();
    EXPECT_THROW(world.set_pose(id, bad), std::invalid_argument);
    EXPECT_EQ(world.size(), 1U);
    const auto after = world.first_hit(this->along_x(-9, 9));
    ASSERT_TRUE(before && after);
    EXPECT_TRUE(same_bits(before->hit, after->hit));
    EXPECT_EQ(after->mesh, id);
}

TYPED_TEST(WorldChanges, the_same_is_said_without_exceptions) {
    World<TypeParam> world;
    const auto added = world.try_add(this->cube(), this->at(4, 0, 0));
    ASSERT_TRUE(added);
    EXPECT_EQ(world.first_hit(this->along_x(-9, 9))->mesh, added.value);
    Pose<TypeParam> bad;
    bad.rotation *= TypeParam(2);
    for (const auto& refused :
         {world.try_add(nullptr), world.try_add(this->cube(), {.pose = bad}), world.try_replace(added.value, nullptr),
          world.try_set_pose(added.value, bad), world.try_set_pose({7, 1}, {}), world.try_replace({7, 1}, this->cube()),
          world.try_set_layers({7, 1}, 1), world.try_set_face_layers({7, 1}, nullptr)}) {
        EXPECT_EQ(refused.status, Status::bad_argument);
        EXPECT_EQ(refused.value, MeshId{});
        EXPECT_FALSE(refused.message.empty());
    }
    EXPECT_EQ(world.size(), 1U);
    EXPECT_EQ(world.try_set_pose(added.value, {}).value, added.value);
    EXPECT_EQ(world.to_mesh(added.value, Vec3<TypeParam>(1, 2, 3)), Vec3<TypeParam>(1, 2, 3));
    EXPECT_TRUE(world.try_set_layers(added.value, 2));
    EXPECT_FALSE(world.any_hit(this->along_x(-9, 9), {.mask = 1}));
    EXPECT_TRUE(world.try_set_face_layers(added.value, std::make_shared<const std::vector<std::uint32_t>>()));
    EXPECT_FALSE(world.any_hit(this->along_x(-9, 9)));
    EXPECT_TRUE(world.try_set_face_layers(added.value, nullptr));
    EXPECT_TRUE(world.try_replace(added.value, this->cube(6)));
    EXPECT_TRUE(world.any_hit(this->along_x(-9, 9, 2.5)));
}

TYPED_TEST(WorldChanges, a_mesh_is_shared_and_lives_as_long_as_it_is_used) {
    World<TypeParam> world;
    auto mesh = this->cube();
    const std::weak_ptr<const CollisionMesh<TypeParam>> watch = mesh;
    std::vector<MeshId> ids;
    for (int i = 0; i < 5; ++i) ids.push_back(world.add(mesh, this->at(4 * i, 0, 0)));
    mesh = nullptr;
    EXPECT_EQ(world.all_hits(this->along_x(-9, 99), {}), 5U);
    for (int i = 0; i < 4; ++i) {
        world.remove(ids[static_cast<std::size_t>(i)]);
        EXPECT_FALSE(watch.expired());
        EXPECT_EQ(world.all_hits(this->along_x(-9, 99), {}), 4U - static_cast<std::size_t>(i));
        EXPECT_EQ(world.first_hit(this->along_x(-9, 99))->mesh, ids[static_cast<std::size_t>(i) + 1]);
    }
    const World<TypeParam> copy = world;
    world.remove(ids[4]);
    EXPECT_FALSE(world.any_hit(this->along_x(-9, 99)));
    EXPECT_FALSE(watch.expired()) << "the copy has it";
    EXPECT_EQ(copy.first_hit(this->along_x(-9, 99))->mesh, ids[4]);
    World<TypeParam> moved_to = World<TypeParam>(copy);
    EXPECT_TRUE(moved_to.remove(ids[4]));
    EXPECT_TRUE(copy.any_hit(this->along_x(-9, 99)));
}

TYPED_TEST(WorldChanges, copies_are_snapshots) {
    World<TypeParam> world;
    std::vector<MeshId> ids;
    for (int i = 0; i < 40; ++i) ids.push_back(world.add(this->cube(), this->at(4 * i, 0, 0)));
    World<TypeParam> copy = world;
    for (std::size_t i = 0; i < ids.size(); i += 2) EXPECT_TRUE(copy.remove(ids[i])) << "a copy has room for it";
    EXPECT_EQ(world.all_hits(this->along_x(-9, 999), {}), 40U);
    EXPECT_EQ(copy.all_hits(this->along_x(-9, 999), {}), 20U);
    copy = world;
    EXPECT_EQ(copy.all_hits(this->along_x(-9, 999), {}), 40U);
    world = World<TypeParam>();
    EXPECT_EQ(copy.size(), 40U);
}

TYPED_TEST(WorldChanges, layers_and_options_hide_nothing_behind_them) {
    World<TypeParam> world;
    std::vector<MeshId> ids;
    for (std::uint32_t i = 0; i < 3; ++i) {
        auto options = this->at(4 * i, 0, 0);
        options.layers = 1U << i;
        ids.push_back(world.add(this->cube(), options));
    }
    const auto segment = this->along_x(-9, 99);
    EXPECT_EQ(world.first_hit(segment)->mesh, ids[0]);
    EXPECT_EQ(world.first_hit(segment, {.mask = 4})->mesh, ids[2]);
    EXPECT_EQ(world.all_hits(segment, {}, {.mask = 6}), 2U);
    EXPECT_FALSE(world.any_hit(segment, {.mask = 8}));
    EXPECT_FALSE(world.first_hit(segment, {.mask = 0}));
    EXPECT_TRUE(world.contains(Vec3<TypeParam>(4, 0, 0), {.mask = 2}));
    EXPECT_FALSE(world.contains(Vec3<TypeParam>(4, 0, 0), {.mask = 5}));
    EXPECT_EQ(world.crossings(this->along_x(-9, 4), {.mask = 3}), 1);
    world.set_layers(ids[0], 8);
    EXPECT_EQ(world.first_hit(segment, {.mask = 8})->mesh, ids[0]);
    // Faces: all but those that the segment meets; beyond the end of the layers there are none.
    const std::uint32_t face = world.first_hit(segment)->hit.face;
    auto layers = std::make_shared<std::vector<std::uint32_t>>(12, 7U);
    (*layers)[face] = 2;
    world.set_face_layers(ids[0], layers);
    EXPECT_FALSE(world.any_hit(segment, {.mask = 1 | 8})) << "the mesh has a bit of it, the face none";
    EXPECT_TRUE(world.any_hit(segment, {.mask = 2 | 8}));
    EXPECT_EQ(world.first_hit(segment)->mesh, ids[0]);
    EXPECT_EQ(world.all_hits(segment, {}, {.sides = Sides::both, .mask = 1 | 8}), 1U) << "it leaves by another face";
    world.set_face_layers(ids[0], std::make_shared<const std::vector<std::uint32_t>>(face, 15U));
    EXPECT_FALSE(world.any_hit(segment, {.mask = 8})) << "beyond the end there are none";
    world.set_face_layers(ids[0], nullptr);
    EXPECT_TRUE(world.any_hit(segment, {.mask = 8}));
}

TYPED_TEST(WorldChanges, accept_is_told_the_mesh) {
    World<TypeParam> world;
    std::vector<MeshId> ids;
    for (int i = 0; i < 3; ++i) ids.push_back(world.add(this->cube(), this->at(4 * i, 0, 0)));
    const auto segment = this->along_x(-9, 99);
    for (const MeshId id : ids) {
        WorldOptions options;
        options.accept = [id](MeshId mesh, const Contact& contact) { return mesh == id && contact.face < 12; };
        const auto hit = world.first_hit(segment, options);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->mesh, id);
        EXPECT_EQ(world.all_hits(segment, {}, options), 1U);
        // The way to the point goes through those before it, which do not count.
        EXPECT_LT(hit->hit.point[0], TypeParam(4) * TypeParam(id.index) - TypeParam(1));
        EXPECT_GT(hit->hit.point[0], TypeParam(4) * TypeParam(id.index) - TypeParam(1.01));
    }
}

TYPED_TEST(WorldChanges, queries_that_are_not_finite_are_counted) {
    World<TypeParam> world;
    (void)world.add(this->cube());
    auto segment = this->along_x(-9, 9);
    EXPECT_TRUE(world.any_hit(segment));
    segment.to[2] = std::numeric_limits<TypeParam>::quiet_NaN();
    EXPECT_FALSE(world.any_hit(segment));
    EXPECT_FALSE(world.first_hit(segment));
    EXPECT_EQ(world.crossings(segment), 0);
    EXPECT_EQ(world.winding_number(segment.to), 0);
    std::vector<Segment<TypeParam>> many(3, segment);
    std::vector<std::uint8_t> out(3, 9);
    EXPECT_EQ(world.any_hits(many, out), 0U);
    EXPECT_EQ(out, std::vector<std::uint8_t>(3, 0));
    EXPECT_EQ(world.statistics().invalid_queries, 7U);
    EXPECT_FALSE(world.any_hit(this->along_x(-9, 9), {.max_fraction = std::numeric_limits<double>::quiet_NaN()}));
}

TYPED_TEST(WorldChanges, ends_of_the_number_range_are_survived) {
    using Scalar = TypeParam;
    constexpr Scalar k_most = std::numeric_limits<Scalar>::max();
    constexpr Scalar k_least = std::numeric_limits<Scalar>::denorm_min();
    World<Scalar> world;
    InstanceOptions<Scalar> options;
    options.pose.rotation = rotation_of<Scalar>(1, 2, 3, 4);
    const MeshId turned = world.add(this->cube(), options);
    options.pose.translation = Vec3<Scalar>::Constant(k_most);
    const MeshId away = world.add(this->cube(), options);
    const MeshId still = world.add(this->cube(), {});
    for (const Scalar far : {k_most, -k_most, k_most / 4, k_least, Scalar(0), Scalar(2)})
        for (const Scalar other : {k_most, -k_most, k_least, Scalar(0.5)}) {
            const Segment<Scalar> segment{{far, 0, 0}, {other, 0, 0}};
            const bool through = (far > 1) != (other > 1) || (far < -1) != (other < -1);
            EXPECT_EQ(world.any_hit(segment, {.sides = Sides::both}), through) << far << ' ' << other;
            (void)world.first_hit(Ray<Scalar>{segment.from, segment.to});
            (void)world.winding_number(segment.from);
        }
    EXPECT_TRUE(world.remove(still) && world.remove(turned) && world.remove(away));
}

// Answers are the same bits whatever the order that meshes came in, and whatever the tree looks like for it.
TYPED_TEST(WorldChanges, answers_do_not_depend_on_how_the_world_came_about) {
    using Scalar = TypeParam;
    Random random(4);
    const auto mesh = shared_mesh(moved<Scalar>(bumpy_sphere(3), 1, {0, 0, 0}));
    std::vector<InstanceOptions<Scalar>> places;
    for (int i = 0; i < 100; ++i) {
        places.push_back(this->at(random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)));
        places.back().pose.rotation = rotation_of<Scalar>(1, random.between_ints(-3, 3), random.between_ints(-3, 3), 1);
    }
    World<Scalar> one;
    std::vector<MeshId> ids;
    for (const auto& place : places) ids.push_back(one.add(mesh, place));
    World<Scalar> other;
    for (std::size_t i = 0; i < places.size(); ++i) (void)other.add(mesh, this->at(double(i), 0, 0));
    for (std::size_t i = places.size(); i-- > 0;) other.set_pose(ids[i], places[i].pose);
    std::size_t hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3<double> from = 12 * random.in_cube();
        const Vec3<double> to = 12 * random.in_cube();
        const Segment<Scalar> segment{from.cast<Scalar>(), to.cast<Scalar>()};
        const auto x = one.first_hit(segment);
        const auto y = other.first_hit(segment);
        ASSERT_EQ(x.has_value(), y.has_value());
        if (!x) continue;
        ++hits;
        EXPECT_EQ(x->mesh, y->mesh);
        EXPECT_TRUE(same_bits(x->hit, y->hit));
    }
    EXPECT_GT(hits, 1000U);
}

// The same where points have to be looked for: where planes of many meshes meet in one point, each try may be stopped
// by several of them.
TYPED_TEST(WorldChanges, points_in_corners_do_not_depend_on_how_the_world_came_about) {
    using Scalar = TypeParam;
    Random random(5);
    std::uint64_t retreats = 0;
    for (int round = 0; round < 200; ++round) {
        World<Scalar> one;
        World<Scalar> other;
        std::vector<MeshId> ids;
        for (int i = 0; i < 8; ++i) {
            const auto corner = [&] {
                const int x = random.between_ints(-9, 9), y = random.between_ints(-9, 9),
                          z = random.between_ints(-9, 9);
                return Vec3<double>(x, y, z);
            };
            const Vec3<double> a = corner();
            const Vec3<double> b = corner();
            TriangleSoup<double> soup;
            add_triangle(soup, a, b, -a - b);  // around the origin
            const auto mesh = shared_mesh(moved<Scalar>(soup, 1, {0, 0, 0}));
            ids.push_back(one.add(mesh));
            EXPECT_EQ(other.add(mesh, this->at(40 * i, 0, 0)), ids.back());
        }
        for (std::size_t i = ids.size(); i-- > 0;) other.set_pose(ids[i * 3 % 8], {});
        for (int i = 0; i < 6; ++i) {
            const Vec3<Scalar> from = (9 * random.in_cube()).template cast<Scalar>();
            const Segment<Scalar> segment{from, -from};
            QueryCounters counters;
            const auto x = one.first_hit(segment, {.sides = Sides::both, .counters = &counters});
            const auto y = other.first_hit(segment, {.sides = Sides::both});
            retreats += counters.retreats;
            ASSERT_EQ(x.has_value(), y.has_value());
            if (!x) continue;
            EXPECT_EQ(x->mesh, y->mesh);
            EXPECT_TRUE(same_bits(x->hit, y->hit)) << round << ' ' << i;
        }
    }
    EXPECT_GT(retreats, 500U);
}

}  // namespace
}  // namespace pierce::test
