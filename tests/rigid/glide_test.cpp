// Sweeps against a mesh that moves without a turn: every answer against whole-number arithmetic on the coordinates as
// given (difference_judge.h), chains of steps against a solid that can be told by its cells, batches, what is invalid.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <rigid/difference_judge.h>
#include <support/executors.h>
#include <support/meshes.h>
#include <support/random.h>

namespace pierce::test {
namespace {

template <class Scalar>
class Glides : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Glides, Scalars);

template <class Scalar>
struct Question {
    Segment<Scalar> way;
    Translation<Scalar> motion;
};

/// A few triangles, which share corners: on a lattice, or anywhere.
template <class Scalar>
TriangleSoup<Scalar> few_triangles(bool on_lattice, Random& random) {
    TriangleSoup<Scalar> soup;
    for (int i = 0; i < 6; ++i) {
        Vec3<double> p = random.in_cube();
        if (on_lattice)
            p = Vec3<double>(random.between_ints(-2, 2), random.between_ints(-2, 2), random.between_ints(-1, 1));
        soup.positions.push_back(p.cast<Scalar>());
    }
    for (int i = 0; i < 8; ++i) {
        IndexTriple t{};
        for (auto& v : t) v = static_cast<std::uint32_t>(random.below(6));
        soup.triangles.push_back(t);
    }
    return soup;
}

/// Ways that run through a triangle, or past it by as little as numbers have, or end on it; the offsets of the mesh
/// are of all sizes, so that differences are numbers of the type, or far from it.
template <class Scalar>
Question<Scalar> question(const TriangleSoup<Scalar>& soup, bool on_lattice, Random& random) {
    const auto any_offset = [&]() -> Vec3<double> {
        switch (random.below(4)) {
            case 0:
                return Vec3<double>::Zero();
            case 1:
                return Vec3<double>(random.between_ints(-3, 3), random.between_ints(-3, 3), random.between_ints(-3, 3));
            case 2:  // huge or tiny
                return std::ldexp(1.0, random.between_ints(-70, 50)) *
                       Vec3<double>(random.between_ints(-3, 3), random.between_ints(-3, 3), random.between_ints(-1, 1));
            default:
                return std::ldexp(1.0, random.between_ints(-3, 30)) * random.in_cube();
        }
    };
    const Vec3<double> start = any_offset();
    const Vec3<double> end = random.chance(0.3) ? start : any_offset();
    const Vec3<Scalar> a = start.cast<Scalar>();
    const Vec3<Scalar> b = end.cast<Scalar>();
    const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
    Vec3<double> w = random.weights();
    if (on_lattice || random.chance(0.3)) w = Vec3<double>(0.5, random.chance(0.5) ? 0.5 : 0.25, 0.25);
    if (random.chance(0.2)) w = Vec3<double>(1, 0, 0);
    Vec3<double> target = Vec3<double>::Zero();
    for (int k = 0; k < 3; ++k) target += w[k] * soup.positions[t[static_cast<std::size_t>(k)]].template cast<double>();
    Vec3<double> d = random.in_cube();
    if (on_lattice)
        d = Vec3<double>(random.between_ints(-2, 2), random.between_ints(-2, 2), random.between_ints(-2, 2)) / 2;
    if (random.chance(0.1)) {  // along the face
        const Vec3<double> p = soup.positions[t[0]].template cast<double>();
        d = soup.positions[t[1]].template cast<double>() - p;
    }
    // From far away to far away: there the rounded way is further off than the mesh's own rounding.
    if (random.chance(0.3)) d *= std::ldexp(1.0, random.between_ints(1, 16));
    const double beyond = random.chance(0.3) ? 0 : random.chance(0.3) ? -0x1p-30 : 1;
    const double before = random.chance(0.2) ? 0 : 1;
    const Vec3<double> from = target - before * d + start;
    const Vec3<double> to = target + beyond * d + end;
    return {{from.cast<Scalar>(), to.cast<Scalar>()}, {a, b}};
}

/// Returns whether it was hit.
template <class Scalar>
bool expect_as_judged(const CollisionMesh<Scalar>& mesh, const TriangleSoup<Scalar>& soup,
                      const Question<Scalar>& asked, Sides sides, int& unverified) {
    const auto hit = mesh.sweep(asked.way, asked.motion, {.sides = sides});
    const auto judged = DifferenceJudge<Scalar>(soup, asked.way, asked.motion).first(sides);
    EXPECT_EQ(hit.has_value(), judged.has_value());
    if (!hit || !judged) return false;
    EXPECT_EQ(hit->triangle, judged->triangle);
    EXPECT_EQ(hit->side, judged->side);
    EXPECT_EQ(hit->feature, judged->feature);
    EXPECT_EQ(hit->feature_index, judged->feature_index);
    EXPECT_EQ(hit->at_start, judged->at_start);
    // The time is the fraction rounded down.
    EXPECT_LE(mpq_class(static_cast<double>(hit->time)), judged->fraction);
    const Scalar next = std::nextafter(hit->time, Scalar(2));
    EXPECT_GE(mpq_class(static_cast<double>(next)), judged->fraction);
    if (!hit->place_verified) {
        ++unverified;
    } else {
        const Segment<Scalar> way{asked.way.from, hit->place};
        EXPECT_FALSE(DifferenceJudge<Scalar>(soup, way, asked.motion).first(sides)) << "the way to the place";
    }
    const QueryOptions before{.sides = sides, .max_fraction = static_cast<double>(hit->time)};
    EXPECT_EQ(mesh.sweep(asked.way, asked.motion, before).has_value(),
              mpq_class(static_cast<double>(hit->time)) >= judged->fraction);
    return true;
}

template <class Scalar>
void expect_judged(int meshes, int questions, std::uint64_t seed) {
    Random random(seed);
    int hits = 0;
    int unverified = 0;
    for (int m = 0; m < meshes; ++m) {
        const bool on_lattice = m % 2 == 0;
        const TriangleSoup<Scalar> soup = few_triangles<Scalar>(on_lattice, random);
        const CollisionMesh<Scalar> mesh(soup.view());
        for (int i = 0; i < questions; ++i) {
            const Question<Scalar> asked = question(soup, on_lattice, random);
            const auto sides = static_cast<Sides>(random.below(3));
            hits += expect_as_judged(mesh, soup, asked, sides, unverified) ? 1 : 0;
            if (testing::Test::HasFailure()) {
                ADD_FAILURE() << "mesh " << m << ", question " << i << ": " << asked.way.from.transpose() << " -> "
                              << asked.way.to.transpose() << " at " << asked.motion.from.transpose() << " -> "
                              << asked.motion.to.transpose();
                return;
            }
        }
    }
    std::cout << meshes * questions << " questions, " << hits << " hits, " << unverified << " without a place\n";
    EXPECT_GT(hits, meshes * questions / 20);
    EXPECT_LT(unverified, hits / 3);  // where the world's numbers are coarser than the mesh there may be none
}

TYPED_TEST(Glides, AreDecidedAsWholeNumbersSay) { expect_judged<TypeParam>(1000, 100, 1); }
TYPED_TEST(Glides, AreDecidedAsWholeNumbersSaySoak) { expect_judged<TypeParam>(10'000, 100, 2); }

// A mesh far from where it was built, with numbers to spare: there is always a place.
template <class Scalar>
void expect_no_leaks(int walks, int steps, int digits, std::uint64_t seed) {
    Random random(seed);
    int contacts = 0;
    for (int w = 0; w < walks; ++w) {
        const Polycube cubes(3, 0.5, 2, seed + static_cast<std::uint64_t>(w));
        const TriangleSoup<Scalar> soup = moved<Scalar>(cubes.soup, 1, {0, 0, 0});
        const CollisionMesh<Scalar> mesh(soup.view());
        // On a lattice all differences are numbers, and points are on faces, edges and corners all the time; for
        // others they are judged as rationals.
        const bool on_lattice = w % 2 == 0;
        const auto coordinate = [&](double size) {
            return on_lattice
                       ? static_cast<double>(random.between_ints(-static_cast<int>(size), static_cast<int>(size)))
                       : size * (2 * random.unit() - 1);
        };
        const auto point = [&](double size) -> Vec3<Scalar> {
            const double x = coordinate(size);
            const double y = coordinate(size);
            return Vec3<double>(x, y, coordinate(size)).cast<Scalar>();
        };
        const auto seen = [](const Vec3<Scalar>& p, const Vec3<Scalar>& a) {
            std::array<mpq_class, 3> out;
            for (int k = 0; k < 3; ++k) {
                out[static_cast<std::size_t>(k)] = mpq_class(static_cast<double>(p[k]));
                out[static_cast<std::size_t>(k)] -= mpq_class(static_cast<double>(a[k]));
            }
            return out;
        };
        const auto cells_around = [&](const std::array<mpq_class, 3>& p) {
            int count = 0;
            for (int octant = 0; octant < 8; ++octant) {
                std::array<int, 3> cell{};
                for (std::size_t k = 0; k < 3; ++k) {
                    const mpq_class at = p[k] / 2;
                    mpz_class low;
                    mpz_fdiv_q(low.get_mpz_t(), at.get_num_mpz_t(), at.get_den_mpz_t());
                    const bool on_face = at == low;
                    cell[k] = static_cast<int>(low.get_si()) - (on_face && (octant >> k & 1) != 0 ? 1 : 0);
                }
                count += cubes.cube.contains(cell) ? 1 : 0;
            }
            return count;
        };
        const double offset = w % 4 < 2 ? 0 : std::ldexp(1.0, digits);
        Vec3<Scalar> a = (point(3).template cast<double>() + Vec3<double>::Constant(offset)).template cast<Scalar>();
        Vec3<Scalar> p;
        do {
            p = (point(8).template cast<double>() + a.template cast<double>()).template cast<Scalar>();
        } while (cells_around(seen(p, a)) != 0);
        for (int s = 0; s < steps; ++s) {
            const Vec3<Scalar> b =
                (point(3).template cast<double>() + Vec3<double>::Constant(offset)).template cast<Scalar>();
            const Vec3<Scalar> to =
                (point(8).template cast<double>() + b.template cast<double>()).template cast<Scalar>();
            const auto hit = mesh.sweep({p, to}, Translation{a, b});
            if (!hit) {
                p = to;
            } else if (hit->place_verified) {
                ++contacts;
                p = hit->place;
            } else {
                continue;  // the mesh waits
            }
            a = b;
            ASSERT_NE(cells_around(seen(p, a)), 8) << "walk " << w << ", step " << s;
        }
    }
    EXPECT_GT(contacts, walks * steps / 20);
}

TYPED_TEST(Glides, NoChainLeaks) { expect_no_leaks<TypeParam>(40, 500, sizeof(TypeParam) == 4 ? 12 : 40, 3); }
TYPED_TEST(Glides, NoChainLeaksSoak) { expect_no_leaks<TypeParam>(1000, 2000, sizeof(TypeParam) == 4 ? 12 : 40, 4); }

// What is left of two motions that are the same is nothing, however large.
TYPED_TEST(Glides, APointThatGoesWithTheMeshMeetsNothing) {
    using V = Vec3<TypeParam>;
    const TriangleSoup<TypeParam> soup = moved<TypeParam>(corner_triangle(), 1, {0, 0, 0});
    const CollisionMesh<TypeParam> mesh(soup.view());
    for (const TypeParam size : {TypeParam(1), TypeParam(1000), TypeParam(1e6)}) {
        const V a(size, -size, 3 * size);
        const V b(-7 * size, size, size);
        const V on(1, 1, 0);
        EXPECT_FALSE(mesh.sweep({a + on, b + on}, Translation{a, b})) << "in the plane";
        // One unit deeper at the end, which no difference in one rounding shows.
        V deeper = b + on;
        deeper[2] = std::nextafter(deeper[2], TypeParam(-1));
        const auto hit = mesh.sweep({a + on, deeper}, Translation{a, b});
        ASSERT_TRUE(hit);
        EXPECT_TRUE(hit->at_start);
        EXPECT_EQ(hit->surface_motion.vec(), V(b - a));
        EXPECT_TRUE(hit->place_verified);
    }
}

// A mesh that stands still somewhere, or nowhere else: the answers of `first_hit`.
TYPED_TEST(Glides, AtRestItIsTheSweepOfAStillMesh) {
    const TriangleSoup<TypeParam> soup = moved<TypeParam>(bumpy_sphere(12), 1, {0, 0, 0});
    const CollisionMesh<TypeParam> mesh(soup.view());
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Segment<TypeParam> way{(1.5 * random.in_cube()).cast<TypeParam>(),
                                     (1.5 * random.in_cube()).cast<TypeParam>()};
        const QueryOptions options{.sides = static_cast<Sides>(random.below(3))};
        const auto still = mesh.first_hit(way, options);
        const Vec3<TypeParam> zero = Vec3<TypeParam>::Zero();
        const auto moving = mesh.sweep(way, Translation{zero, zero}, options);
        ASSERT_EQ(still.has_value(), moving.has_value());
        if (!still) continue;
        ++hits;
        ASSERT_EQ(still->triangle, moving->triangle);
        ASSERT_EQ(still->feature, moving->feature);
        ASSERT_NEAR(still->exact_fraction, moving->time, 2 * std::numeric_limits<TypeParam>::epsilon());
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(still->position[k], moving->position[k], 8 * std::numeric_limits<TypeParam>::epsilon());
            ASSERT_NEAR(still->normal[k], moving->normal[k], 1e-5);
            ASSERT_NEAR(still->position[k], moving->place[k], 64 * std::numeric_limits<TypeParam>::epsilon());
        }
    }
    EXPECT_GT(hits, 3000);
}

TYPED_TEST(Glides, BatchesAreTheSingleCalls) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(10), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(6);
    std::vector<Segment<Scalar>> ways;
    for (int i = 0; i < 5000; ++i) {
        const Vec3<double> from = 2 * random.in_cube();
        ways.push_back({from.cast<Scalar>(), (2 * random.in_cube()).cast<Scalar>()});
    }
    ways[7].to[1] = std::numeric_limits<Scalar>::quiet_NaN();
    const Translation<Scalar> motion{Vec3<Scalar>(Scalar(0.1), 0, Scalar(0.3)),
                                     Vec3<Scalar>(Scalar(-0.2), Scalar(0.7), 0)};
    using Out = std::vector<std::optional<SweepHit<Scalar>>>;
    for (const Executor& executor : {Executor{}, Executor{Reversed{}}, Executor{Threads{}}}) {
        Out out(ways.size());
        const auto invalid = mesh.statistics().invalid_queries;
        const std::size_t hits = mesh.sweeps(ways, motion, out, {.sides = Sides::both}, executor);
        EXPECT_EQ(mesh.statistics().invalid_queries, invalid + 1);
        std::size_t count = 0;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const auto single = mesh.sweep(ways[i], motion, {.sides = Sides::both});
            ASSERT_EQ(single.has_value(), out[i].has_value());
            if (!single) continue;
            ++count;
            ASSERT_EQ(single->time, out[i]->time);
            ASSERT_TRUE(single->place == out[i]->place && single->position == out[i]->position);
        }
        EXPECT_EQ(count, hits);
        EXPECT_GT(count, ways.size() / 10);
    }
    Out few(3);
    EXPECT_THROW(mesh.sweeps(ways, motion, few), std::invalid_argument);
}

// Of the least number one and three quarters, and a quarter: the quotients of doubles are 2 and 0.
TEST(GlidesOfDoubles, TimesBelowTheNormalNumbersAreLowerBounds) {
    const TriangleSoup<double> soup = corner_triangle();
    const CollisionMesh<double> mesh(soup.view());
    const Translation<double> still{{0, 0, 0}, {0, 0, 0}};
    EXPECT_EQ(mesh.sweep(Segment<double>{{1, 1, 0x1.cp-174}, {1, 1, -0x1p900}}, still)->time, 0x1p-1074);
    EXPECT_FALSE(mesh.sweep(Segment<double>{{1, 1, 0x1p-176}, {1, 1, -0x1p900}}, still, {.max_fraction = 0}));
}

TYPED_TEST(Glides, OptionsAndWhatHasNoMeaning) {
    using Scalar = TypeParam;
    using V = Vec3<Scalar>;
    const TriangleSoup<Scalar> soup = moved<Scalar>(corner_triangle(), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    const V zero = V::Zero();
    const Segment<Scalar> down{V(1, 1, 1), V(1, 1, -1)};
    const Translation<Scalar> up{zero, V(0, 0, 2)};
    ASSERT_TRUE(mesh.sweep(down, up));
    EXPECT_EQ(mesh.sweep(down, up)->time, Scalar(0.25));
    EXPECT_TRUE(mesh.sweep(down, up, {.max_fraction = 0.25}));
    EXPECT_FALSE(mesh.sweep(down, up, {.max_fraction = 0.2499}));
    EXPECT_FALSE(mesh.sweep(down, up, {.max_fraction = std::nan("")}));
    const std::uint8_t none = 0;
    EXPECT_FALSE(mesh.sweep(down, up, {.face_mask = {&none, 1}}));
    const auto refuse = [](const Contact& contact) { return contact.fraction != 0.25; };
    EXPECT_FALSE(mesh.sweep(down, up, {.accept = refuse}));
    QueryCounters counters;
    EXPECT_TRUE(mesh.sweep(down, up, {.counters = &counters}));
    EXPECT_EQ(counters.queries, 1U);

    const auto before = mesh.statistics().invalid_queries;
    const Scalar huge = std::numeric_limits<Scalar>::max();
    const Scalar infinite = std::numeric_limits<Scalar>::infinity();
    EXPECT_FALSE(mesh.sweep(down, Translation<Scalar>{zero, V(0, infinite, 0)}));
    EXPECT_FALSE(mesh.sweep({V(huge, 1, 1), V(1, 1, -1)}, Translation<Scalar>{V(-huge, 0, 0), zero}));
    EXPECT_EQ(mesh.statistics().invalid_queries, before + 2);
    EXPECT_FALSE(CollisionMesh<Scalar>().sweep(down, up));
    (void)mesh.sweep(down, {});  // the sweep of a mesh that stands still
}

}  // namespace
}  // namespace pierce::test
