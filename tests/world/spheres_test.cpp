// Balls in worlds: each mesh by itself says the same about the images, and the center is verified in all of them.
#include <algorithm>

#include <support/sphere_oracle.h>
#include <world/made_world.h>
#include <rigid/placement.h>

namespace pierce::test {
namespace {

template <class Scalar>
class WorldSpheres : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldSpheres, Scalars);

template <class Scalar>
bool same_but_places(const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
    return x.fraction == y.fraction && x.overlap == y.overlap && x.face == y.face && x.triangle == y.triangle &&
           x.side == y.side && x.feature == y.feature && x.feature_index == y.feature_index && x.at_start == y.at_start;
}

template <class Scalar>
struct OfMesh {
    const typename NaiveWorld<Scalar>::Member* member;
    SphereHit<Scalar> hit;
};

TYPED_TEST(WorldSpheres, balls_run_into_what_the_meshes_say) {
    using Scalar = TypeParam;
    std::size_t hits = 0;
    std::size_t contacts = 0;
    std::size_t stayed = 0;
    for (const double offset : {0.0, 1000.0, 1e5}) {
        MadeWorld<Scalar> made(offset, 21);
        for (int i = 0; i < 14; ++i) made.add();
        for (int i = 0; i < 500; ++i) {
            made.change();
            Segment<Scalar> step = made.segment();
            const double size = std::pow(10.0, made.random.between(-2, 0.3));
            const auto radius = static_cast<Scalar>(i % 50 == 0 ? 100 * size : size);
            // Most steps are short: long ones start somewhere and are stopped at once.
            if (made.random.chance(0.6))
                step.to = step.from + (made.random.between(0.01, 1) * made.random.in_cube()).template cast<Scalar>();
            WorldOptions options = made.options();
            if (made.random.chance(0.7)) options.accept = {};
            std::vector<OfMesh<Scalar>> first;
            std::vector<OfMesh<Scalar>> all;
            std::vector<OfMesh<Scalar>> touching;
            for (const auto& member : made.naive.members) {
                if ((member.layers & options.mask) == 0) continue;
                std::vector<std::uint8_t> mask;
                const QueryOptions here = made.naive.options_in(member, options, mask);
                const Segment<Scalar> local = made.naive.image(member, step);
                if (const auto hit = member.mesh->sweep_sphere(local, radius, here)) first.push_back({&member, *hit});
                std::vector<SphereHit<Scalar>> some(member.mesh->sphere_hits(local, radius, {}, here));
                member.mesh->sphere_hits(local, radius, some, here);
                for (const auto& hit : some) all.push_back({&member, hit});
                some.resize(member.mesh->sphere_contacts(local.from, radius, {}, here));
                member.mesh->sphere_contacts(local.from, radius, some, here);
                for (const auto& hit : some) touching.push_back({&member, hit});
            }
            const auto hit = made.world.sweep_sphere(step, radius, options);
            ASSERT_EQ(hit.has_value(), !first.empty()) << to_text(step) << ' ' << radius;
            if (hit) {
                ++hits;
                const auto earliest = std::min_element(first.begin(), first.end(), [](const auto& x, const auto& y) {
                    return x.hit.fraction < y.hit.fraction;
                });
                EXPECT_EQ(hit->hit.fraction, earliest->hit.fraction);
                EXPECT_TRUE(std::any_of(first.begin(), first.end(), [&](const auto& x) {
                    return x.member->id == hit->mesh && same_but_places(x.hit, hit->hit);
                }));
                if (hit->hit.center.vec() == step.from && !hit->hit.at_start) ++stayed;
                WorldOptions whole = options;
                whole.max_fraction = std::numeric_limits<double>::infinity();
                for (const auto& member : made.naive.members) {
                    if ((member.layers & options.mask) == 0) continue;
                    std::vector<std::uint8_t> mask;
                    const QueryOptions here = made.naive.options_in(member, whole, mask);
                    const Segment<Scalar> local = made.naive.image(member, {step.from, hit->hit.center});
                    EXPECT_FALSE(member.mesh->sweep_sphere(local, radius, here)) << to_text(step) << ' ' << radius;
                }
                if (!hit->hit.at_start && hit->hit.fraction > 0) {
                    // From what is touched the center is as far as the radius, and the normal points to it.
                    const Vec3<double> away =
                        hit->hit.center.template cast<double>() - hit->hit.contact.template cast<double>();
                    const double unit = double(std::numeric_limits<Scalar>::epsilon()) * (100 + 8 * offset);
                    EXPECT_NEAR(away.norm(), double(radius), 100 * unit + 1e-5 * double(radius));
                    EXPECT_GT(away.dot(hit->hit.normal.template cast<double>()), 0.9 * away.norm() - 100 * unit);
                }
            }
            const auto expect_all = [&](std::vector<OfMesh<Scalar>>& expected, auto&& ask, auto&& before) {
                std::stable_sort(expected.begin(), expected.end(), before);
                std::vector<WorldSphereHit<Scalar>> got(expected.size() / 2 + 1);
                ASSERT_EQ(ask(std::span(got)), expected.size());
                for (std::size_t k = 0; k < std::min(got.size(), expected.size()); ++k) {
                    EXPECT_EQ(got[k].mesh, expected[k].member->id);
                    EXPECT_TRUE(same_but_places(got[k].hit, expected[k].hit));
                }
            };
            const auto by_number = [](const auto& x, const auto& y) {
                if (x.member != y.member) return x.member->id.index < y.member->id.index;
                return x.hit.face != y.hit.face ? x.hit.face < y.hit.face : x.hit.triangle < y.hit.triangle;
            };
            expect_all(
                all, [&](auto out) { return made.world.sphere_hits(step, radius, out, options); },
                [&](const auto& x, const auto& y) {
                    return x.hit.fraction != y.hit.fraction ? x.hit.fraction < y.hit.fraction : by_number(x, y);
                });
            expect_all(
                touching, [&](auto out) { return made.world.sphere_contacts(step.from, radius, out, options); },
                [&](const auto& x, const auto& y) {
                    return x.hit.overlap != y.hit.overlap ? x.hit.overlap > y.hit.overlap : by_number(x, y);
                });
            contacts += touching.size();
        }
    }
    std::cout << hits << " hits, " << stayed << " stayed at their start, " << contacts << " contacts\n";
    EXPECT_GT(hits, 500U);
    EXPECT_LT(stayed, hits / 4);
    EXPECT_GT(contacts, 1000U);
}

// Along a face, a grain off it, into one of another mesh: beside valleys a place is tried again until all are clear.
TYPED_TEST(WorldSpheres, places_in_corners_are_clear_of_all_meshes) {
    using Scalar = TypeParam;
    std::uint64_t retreats = 0;
    MadeWorld<Scalar> made(0, 25);
    Random random(26);
    const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(1, 1, 1, 1), 4, {-2, -2, -2});
    const auto mesh = shared_mesh(soup);
    for (int i = 0; i < 12; ++i) {
        InstanceOptions<Scalar> options;
        options.pose.translation = (4 * random.in_cube()).template cast<Scalar>();
        options.pose.rotation = rotation_of<Scalar>(6, random.between_ints(-2, 2), random.between_ints(-2, 2), 1);
        made.naive.members.push_back({made.world.add(mesh, options), soup, mesh, 0xffffffff, {}, options.pose});
    }
    const auto radius = static_cast<Scalar>(0.05);
    for (int i = 0; i < 3000; ++i) {
        Segment<Scalar> step{(5 * random.in_cube()).template cast<Scalar>(),
                             (5 * random.in_cube()).template cast<Scalar>()};
        for (int slide = 0; slide < 3; ++slide) {
            QueryCounters counters;
            const auto hit = made.world.sweep_sphere(step, radius, {.counters = &counters});
            if (!hit) break;
            retreats += counters.retreats;
            for (const auto& member : made.naive.members)
                EXPECT_FALSE(member.mesh->sweep_sphere(made.naive.image(member, {step.from, hit->hit.center}), radius));
            const Vec3<double> n = hit->hit.normal.template cast<double>();
            const Vec3<double> way = 3 * random.in_cube();
            const Vec3<double> to = hit->hit.center.template cast<double>() + way - n.dot(way) * n;
            step = {hit->hit.center, to.template cast<Scalar>()};
        }
    }
    EXPECT_GT(retreats, 20U);
}

// The grain is that of the larger numbers, the mesh's or the world's: else rounding of images would take places back.
TYPED_TEST(WorldSpheres, places_allow_for_the_rounding_of_images) {
    using Scalar = TypeParam;
    Random random(27);
    const Vec3<double> away = Vec3<double>(1000, 2000, -1000);
    World<Scalar> world;
    InstanceOptions<Scalar> options;
    options.pose.translation = (-away).cast<Scalar>();
    (void)world.add(shared_mesh(moved<Scalar>(bumpy_sphere(4), 1, away)), options);
    QueryCounters counters;
    std::uint64_t hits = 0;
    for (int i = 0; i < 500; ++i) {
        const Segment<Scalar> step{(3 * random.direction()).template cast<Scalar>(),
                                   (0.3 * random.in_cube()).template cast<Scalar>()};
        if (world.sweep_sphere(step, Scalar(0.1), {.counters = &counters})) ++hits;
    }
    std::cout << hits << " hits, " << counters.retreats << " places taken back\n";
    EXPECT_GT(hits, 400U);
    EXPECT_LT(counters.retreats, hits / 10);
}

// A world of one mesh that stands still says what the mesh says, to the last bit.
TYPED_TEST(WorldSpheres, one_mesh_that_stands_still_is_that_mesh) {
    using Scalar = TypeParam;
    Random random(22);
    const auto mesh = shared_mesh(moved<Scalar>(bumpy_sphere(5), 1, {0, 0, 0}));
    World<Scalar> world;
    const MeshId id = world.add(mesh);
    std::size_t hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const Segment<Scalar> step{(2 * random.in_cube()).cast<Scalar>(), (2 * random.in_cube()).cast<Scalar>()};
        const auto radius = static_cast<Scalar>(random.between(0.01, 0.4));
        const auto expected = mesh->sweep_sphere(step, radius);
        const auto hit = world.sweep_sphere(step, radius);
        ASSERT_EQ(hit.has_value(), expected.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_EQ(hit->mesh, id);
        EXPECT_EQ(std::memcmp(&hit->hit, &*expected, sizeof hit->hit), 0);
    }
    EXPECT_GT(hits, 300U);
}

/// How far a point is from the nearest triangle of a world, where that truly is: its pose in 113 bits.
template <class Scalar>
double distance_in_world(const MadeWorld<Scalar>& made, const Vec3<Scalar>& at) {
    using Exact = Distances<Quad>;
    Quad least = 1e30;
    for (const auto& member : made.naive.members) {
        const detail::Placement placement = detail::make_placement(member.pose);
        for (const IndexTriple& t : member.soup.triangles) {
            typename Exact::Triangle corners;
            for (std::size_t c = 0; c < 3; ++c) {
                const Vec3<double> x = member.soup.positions[t[c]].template cast<double>();
                for (std::size_t k = 0; k < 3; ++k) {
                    corners[c][k] = placement.translation[k];
                    for (std::size_t j = 0; j < 3; ++j)
                        corners[c][k] += Quad(placement.rotation[k][j]) * Quad(x[static_cast<int>(j)]);
                }
            }
            const auto p = Exact::exact(detail::to_point(at));
            least = std::min(least, Exact::point_triangle(p, corners, nullptr));
        }
    }
    return std::sqrt(static_cast<double>(least));
}

// A chain of steps of a ball inside turned meshes never gets out, and is never nearer than the radius by more than
// images are off.
TYPED_TEST(WorldSpheres, chains_of_balls_stay_where_they_are) {
    using Scalar = TypeParam;
    for (const double offset : {0.0, 1000.0}) {
        MadeWorld<Scalar> made(offset, 23);
        Random random(24);
        const Vec3<double> shift(offset, -offset, offset);
        const auto add = [&](const TriangleSoup<Scalar>& soup, const Vec3<double>& at) {
            InstanceOptions<Scalar> options;
            options.pose.translation = (shift + at).template cast<Scalar>();
            options.pose.rotation = rotation_of<Scalar>(2, random.between_ints(-3, 3), random.between_ints(-3, 3), 1);
            const auto mesh = shared_mesh(soup);
            made.naive.members.push_back({made.world.add(mesh, options), soup, mesh, 0xffffffff, {}, options.pose});
        };
        add(moved<Scalar>(bumpy_sphere(4), 3, {0, 0, 0}), {0.1, 0.2, 0.3});  // the room
        TriangleSoup<Scalar> box = moved<Scalar>(polycube(1, 1, 1, 1), 1, {-0.5, -0.5, -0.5});
        for (int i = 0; i < 3; ++i) add(box, random.in_cube());
        const MeshId room = made.naive.members[0].id;
        const auto radius = static_cast<Scalar>(0.1);
        // Off by at most 2^-23 (double: 2^-46) of the way from the translation, and the check by its own rounding.
        const double off = 8 * (sizeof(Scalar) == 4 ? 0x1p-23 : 0x1p-46) + 1e-15 * (1 + offset);
        Vec3<Scalar> at;
        int tries = 0;
        do {
            at = (shift + 2 * random.in_cube()).template cast<Scalar>();
            ASSERT_LT(++tries, 1000);
        } while (!made.world.contains(at) || distance_in_world(made, at) < 0.12 || made.world.winding_number(at) != 1);
        std::size_t hits = 0;
        double nearest = 1;
        for (int i = 0; i < 400; ++i) {
            Vec3<double> way = (i % 3 == 0 ? 1.0 : 0.1) * random.in_cube();
            if (i / 100 % 2 == 0) way = {0.1 * way[0], 0.1 * way[1], -std::abs(way[2])};
            for (int k = 0; k < 3; ++k) {
                const Vec3<Scalar> to = (at.template cast<double>() + way).template cast<Scalar>();
                const auto hit = made.world.sweep_sphere({at, to}, radius);
                at = hit ? hit->hit.center.vec() : to;
                if (!hit) break;
                ++hits;
                const Vec3<double> n = hit->hit.normal.template cast<double>();
                way = 0.9 * (way - n * std::min(n.dot(way), 0.0));
            }
            ASSERT_NE(made.world.mesh(room)->winding_number(made.world.to_mesh(room, at)), 0) << i;
            if (i % 10 == 0) nearest = std::min(nearest, distance_in_world(made, at));
        }
        EXPECT_GT(hits, 200U);
        EXPECT_GE(nearest, double(radius) - off);
        EXPECT_LT(nearest, double(radius) + 1e-2);
    }
}

TYPED_TEST(WorldSpheres, what_has_no_meaning_is_counted) {
    using Scalar = TypeParam;
    World<Scalar> world;
    const auto cube = shared_mesh(moved<Scalar>(polycube(1, 1, 1, 1), 2, {-1, -1, -1}));
    const Segment<Scalar> step{{3, 0, 0}, {0, 0, 0}};
    EXPECT_FALSE(world.sweep_sphere(step, Scalar(1)));
    EXPECT_EQ(world.sphere_contacts(step.to, Scalar(9), {}), 0U);
    (void)world.add(cube);
    (void)world.add(cube, {.pose = {.translation = {Scalar(0), Scalar(4), Scalar(0)}}});
    const auto hit = world.sweep_sphere(step, Scalar(1));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(double(hit->hit.fraction), 1.0 / 3, 1e-5);
    EXPECT_EQ(hit->mesh.index, 0U);
    constexpr Scalar k_nan = std::numeric_limits<Scalar>::quiet_NaN();
    for (const Scalar radius : {Scalar(0), Scalar(-1), k_nan, std::numeric_limits<Scalar>::infinity()})
        EXPECT_FALSE(world.sweep_sphere(step, radius));
    EXPECT_FALSE(world.sweep_sphere({step.from, Vec3<Scalar>::Constant(k_nan)}, Scalar(1)));
    EXPECT_EQ(world.sphere_contacts(Vec3<Scalar>::Constant(k_nan), Scalar(1), {}), 0U);
    EXPECT_EQ(world.statistics().invalid_queries, 6U);
    // Radii at the ends of the number range: all meshes are near, none is missed.
    for (const Scalar radius : {std::numeric_limits<Scalar>::max(), std::numeric_limits<Scalar>::denorm_min()})
        EXPECT_TRUE(world.sweep_sphere({{3, 0, 0}, {0, Scalar(0.1), Scalar(0.2)}}, radius)) << radius;
    EXPECT_GT(world.sphere_contacts({3, 0, 0}, std::numeric_limits<Scalar>::max(), {}), 1U);
}

}  // namespace
}  // namespace pierce::test
