// Rays against an oracle of exact rationals: directions that no segment can express, limits from the least number to
// infinity and on faces, in all sizes of numbers; and particles that fly by rays and must stay inside.
//
// A ray used to be a segment to origin + limit * direction, which rounds: at a limit of 1e9 mesh sizes the end of a
// float ray is off by tens of mesh sizes, and a ray aimed at a vertex by way of a direction missed it.
#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/random.h>
#include <support/ray_oracle.h>
#include <support/within_an_ulp.h>

namespace pierce::test {
namespace {

template <class Scalar>
struct Question {
    Ray<Scalar> ray;
    QueryOptions options;
};

template <class Scalar>
class RaySource {
  public:
    RaySource(const TriangleSoup<Scalar>& soup, double size, Random& random)
        : soup_(soup), size_(size), random_(random) {}

    Question<Scalar> question() {
        Question<Scalar> asked;
        Ray<Scalar>& ray = asked.ray;
        ray.origin = origin();
        ray.direction = direction(ray.origin);
        ray.limit = limit(ray);
        asked.options.sides = std::array{Sides::front, Sides::back, Sides::both}[random_.below(3)];
        if (random_.chance(0.1)) asked.options.max_fraction = static_cast<double>(limit(ray));
        return asked;
    }

  private:
    using V = Vec3<Scalar>;
    static Scalar rounded(double x) { return static_cast<Scalar>(x); }

    V lattice_point() {
        V p;
        for (int k = 0; k < 3; ++k) p[k] = rounded(size_ * random_.between_ints(-3, 3));
        return p;
    }
    V some_vertex() { return soup_.positions[random_.below(soup_.positions.size())]; }

    V origin() {
        switch (random_.below(6)) {
            case 0:
                return some_vertex();
            case 1:
                return lattice_point();
            case 2:  // far away
                return (size_ * std::ldexp(1.0, random_.between_ints(3, 40)) * random_.in_cube())
                    .template cast<Scalar>();
            case 3:  // in a face
                return ((some_vertex() + some_vertex()) / 2).eval();
            default:
                return (4 * size_ * random_.in_cube()).template cast<Scalar>();
        }
    }

    V direction(const V& from) {
        V d;
        switch (random_.below(5)) {
            case 0:  // at a vertex, as exactly as a difference is
                d = some_vertex() - from;
                break;
            case 1:
                for (int k = 0; k < 3; ++k) d[k] = rounded(random_.between_ints(-2, 2));
                break;
            case 2:  // in the plane of a face, or along an edge
                d = some_vertex() - some_vertex();
                break;
            default:
                d = random_.direction().template cast<Scalar>();
        }
        // Of all sizes.
        constexpr int k_range = std::numeric_limits<Scalar>::max_exponent - 10;
        if (random_.chance(0.5)) d = d * std::ldexp(Scalar(1), random_.between_ints(-k_range / 2, k_range / 2));
        if (random_.chance(0.1)) d = d * std::ldexp(Scalar(1), random_.between_ints(-k_range / 2, k_range / 2));
        if (random_.chance(0.1)) d[static_cast<int>(random_.below(3))] = std::numeric_limits<Scalar>::denorm_min();
        if (random_.chance(0.1)) d[static_cast<int>(random_.below(3))] *= std::ldexp(Scalar(1), -k_range / 2);
        return d.allFinite() ? d : V(1, 0, 0);
    }

    // Some of them where a component is that of a vertex, and beside these.
    Scalar limit(const Ray<Scalar>& ray) {
        constexpr Scalar k_infinite = std::numeric_limits<Scalar>::infinity();
        if (random_.chance(0.4)) return k_infinite;
        if (random_.chance(0.1)) return std::ldexp(Scalar(1), random_.between_ints(-1000, 1000));
        const int k = static_cast<int>(random_.below(3));
        Scalar t = std::abs((some_vertex()[k] - ray.origin[k]) / ray.direction[k]);
        if (std::isnan(t)) return 1;
        if (random_.chance(0.3)) t = std::nextafter(t, random_.chance(0.5) ? k_infinite : Scalar(0));
        return random_.chance(0.2) ? t * rounded(random_.between(0.5, 2)) : t;
    }

    const TriangleSoup<Scalar>& soup_;
    double size_;
    Random& random_;
};

/// A few triangles in one place: some on a lattice, with vertices in common, some anywhere.
template <class Scalar>
TriangleSoup<Scalar> handful(double size, Random& random) {
    TriangleSoup<Scalar> soup;
    const auto some = [&]() -> Vec3<double> {
        if (random.chance(0.3)) return 3 * size * random.in_cube();
        Vec3<double> p;
        for (int k = 0; k < 3; ++k) p[k] = size * random.between_ints(-2, 2);
        return p;
    };
    for (int i = 0; i < 12; ++i) add_triangle(soup, some(), some(), some());
    return soup;
}

/// Returns the number of decisions; what is wrong is a failure.
template <class Scalar>
std::size_t judge(std::size_t rounds, std::size_t count_each, std::uint64_t seed) {
    Random random(seed);
    std::size_t decisions = 0;
    std::size_t hits = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
        constexpr int k_range = sizeof(Scalar) == 4 ? 60 : 300;
        const int exponent = random.chance(0.5) ? 0 : random.between_ints(-k_range, k_range);
        const double size = std::ldexp(random.chance(0.5) ? 1 : random.between(1, 2), exponent);
        const TriangleSoup<Scalar> soup = handful<Scalar>(size, random);
        const CollisionMesh<Scalar> mesh(soup.view());
        RaySource<Scalar> source(soup, size, random);
        for (std::size_t i = 0; i < count_each; ++i) {
            const Question<Scalar> asked = source.question();
            const RayOracle<Scalar> oracle(asked.ray);
            std::vector<std::pair<RayMeeting, std::uint32_t>> expected;
            int crossings = 0;
            for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
                const auto [a, b, c] = soup.triangles[t];
                const RayMeeting meeting =
                    oracle.meet({soup.positions[a], soup.positions[b], soup.positions[c]}, asked.options.sides);
                crossings += meeting.crossing;
                ++decisions;
                if (meeting.hit &&
                    (std::isinf(asked.options.max_fraction) || meeting.parameter <= asked.options.max_fraction))
                    expected.emplace_back(meeting, t);
            }
            std::stable_sort(expected.begin(), expected.end(),
                             [](const auto& x, const auto& y) { return x.first.parameter < y.first.parameter; });
            const auto said = [&] {
                std::ostringstream text;
                text << std::hexfloat << "round " << round << " ray " << i << " origin " << asked.ray.origin.transpose()
                     << " direction " << asked.ray.direction.transpose() << " limit " << asked.ray.limit << " most "
                     << asked.options.max_fraction << " sides " << int(asked.options.sides);
                return text.str();
            };
            std::array<Hit<Scalar>, 16> all;
            const std::size_t count = mesh.all_hits(asked.ray, all, asked.options);
            const auto first = mesh.first_hit(asked.ray, asked.options);
            EXPECT_EQ(mesh.crossings(asked.ray), crossings) << said();
            EXPECT_EQ(mesh.any_hit(asked.ray, asked.options), !expected.empty()) << said();
            EXPECT_EQ(first.has_value(), !expected.empty()) << said();
            EXPECT_EQ(count, expected.size()) << said();
            if (count != expected.size() || first.has_value() != !expected.empty()) return decisions;
            for (std::size_t h = 0; h < count; ++h) {
                const auto& [meeting, triangle] = expected[h];
                const Hit<Scalar>& hit = all[h];
                EXPECT_EQ(hit.triangle, triangle) << said();
                EXPECT_EQ(hit.side, meeting.side) << said();
                EXPECT_EQ(hit.feature, meeting.feature) << said();
                EXPECT_EQ(hit.feature_index, meeting.feature_index) << said();
                EXPECT_EQ(hit.at_start, meeting.at_start) << said();
                EXPECT_TRUE(within_an_ulp(hit.exact_fraction, meeting.parameter))
                    << said() << ' ' << hit.exact_fraction << " for " << meeting.parameter.get_d();
                EXPECT_TRUE(mpq_class(static_cast<double>(hit.fraction)) <= meeting.parameter) << said();
            }
            if (!first) continue;
            ++hits;
            EXPECT_EQ(first->triangle, expected[0].second) << said();
            EXPECT_FALSE(mesh.any_hit({asked.ray.origin, first->point}, {.sides = asked.options.sides})) << said();
            if (::testing::Test::HasFailure()) return decisions;
        }
    }
    EXPECT_GT(hits, rounds * count_each / 20);
    return decisions;
}

template <class Scalar>
class RayQueries : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RayQueries, Scalars, );

TYPED_TEST(RayQueries, are_decided_exactly) { judge<TypeParam>(200, 50, 91); }

// Batches: the bits of the single calls, from an array of rays and from arrays of origins, directions and limits.
TYPED_TEST(RayQueries, in_batches_have_the_bits_of_single_calls) {
    using Scalar = TypeParam;
    Random random(93);
    const Threads threads;
    for (int round = 0; round < 4; ++round) {
        const TriangleSoup<Scalar> soup = handful<Scalar>(1, random);
        const CollisionMesh<Scalar> mesh(soup.view());
        RaySource<Scalar> source(soup, 1, random);
        std::vector<Ray<Scalar>> rays;
        std::vector<Vec3<Scalar>> origins;
        std::vector<Vec3<Scalar>> directions;
        std::vector<Scalar> limits;
        for (int i = 0; i < 3000; ++i) {
            rays.push_back(source.question().ray);
            if (i % 100 == 7) rays.back().limit = -1;
            if (i % 100 == 8) rays.back().limit = std::numeric_limits<Scalar>::quiet_NaN();
            if (i % 100 == 9) rays.back().direction[1] = std::numeric_limits<Scalar>::infinity();
            origins.push_back(rays.back().origin);
            directions.push_back(rays.back().direction);
            limits.push_back(rays.back().limit);
        }
        const QueryOptions options{.sides = round % 2 == 0 ? Sides::front : Sides::both};
        const Rays<Scalar> of_array(rays);
        const Rays<Scalar> of_parts(origins, directions, limits.data());
        std::vector<std::optional<Hit<Scalar>>> hits(rays.size());
        std::vector<Hit<Scalar>> plain(rays.size());
        std::vector<std::uint8_t> any(rays.size(), 9);
        std::vector<int> crossings(rays.size(), 9);
        std::vector<std::size_t> offsets(rays.size() + 1);
        const std::uint64_t invalid = mesh.statistics().invalid_queries;
        mesh.first_hits(rays, hits, options, std::ref(threads));
        EXPECT_EQ(mesh.statistics().invalid_queries - invalid, 90U);
        mesh.first_hits(of_parts, plain, options);
        mesh.any_hits(of_parts, any, options, std::ref(threads));
        mesh.crossings(of_array, crossings);
        std::vector<Hit<Scalar>> rows(mesh.all_hits(of_array, offsets, {}, options));
        mesh.all_hits(of_array, offsets, rows, options);
        std::array<Hit<Scalar>, 16> row;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto expected = mesh.first_hit(rays[i], options);
            ASSERT_TRUE(same_answer(hits[i], expected)) << i;
            ASSERT_EQ(static_cast<bool>(plain[i]), expected.has_value());
            if (expected) {
                ASSERT_TRUE(same_bits(plain[i], *expected)) << i;
            }
            ASSERT_EQ(any[i], mesh.any_hit(rays[i], options) ? 1 : 0);
            ASSERT_EQ(crossings[i], mesh.crossings(rays[i]));
            const std::size_t count = mesh.all_hits(rays[i], row, options);
            ASSERT_EQ(count, offsets[i + 1] - offsets[i]);
            for (std::size_t k = 0; k < count; ++k) {
                ASSERT_TRUE(same_bits(rows[offsets[i] + k], row[k])) << i;
            }
        }
        // One limit for all of them.
        mesh.any_hits(Rays<Scalar>(origins, directions, 2), any, options);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(any[i], mesh.any_hit(Ray<Scalar>{origins[i], directions[i], 2}, options) ? 1 : 0);
        }
        EXPECT_THROW(mesh.any_hits(Rays<Scalar>(origins, std::span(directions).first(2)), any), std::invalid_argument);
    }
}

// A wall at x = 0 and one 2^83 behind it; a ray that starts a denormal number in front of the first. Its way to the
// mesh's far side is 2^1157 times as long as to the hit, so the fraction was rounded to 0, and t with it: it is 2^-840.
TEST(RayParameters, of_hits_whose_fraction_is_below_all_numbers) {
    using V = Vec3<double>;
    TriangleSoup<double> soup;
    for (const double x : {0.0, -0x1p83})
        add_triangle(soup, V(x, -0x1p83, -0x1p83), V(x, 0x1p83, -0x1p83), V(x, 0, 0x1p83));
    const CollisionMesh<double> mesh(soup.view());
    const Ray<double> ray{V(0x1p-1074, 0, 0), V(-0x1p-234, 0, 0)};
    double asked = 0;
    const auto accept = [&asked](const Contact& contact) { return asked = contact.fraction, true; };
    const auto hit = mesh.first_hit(ray, {.sides = Sides::both, .accept = std::ref(accept)});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 0U);
    EXPECT_EQ(hit->exact_fraction, 0x1p-840);
    EXPECT_LE(hit->fraction, 0x1p-840);
    EXPECT_EQ(asked, 0x1p-840);
    std::array<Hit<double>, 2> hits;
    ASSERT_EQ(mesh.all_hits(ray, hits, {.sides = Sides::both}), 2U);
    EXPECT_EQ(hits[0].exact_fraction, 0x1p-840);
    EXPECT_EQ(hits[1].exact_fraction, 0x1p317);
    const std::array<FaceRegions, 2> labels{FaceRegions{1, 2}, FaceRegions{2, 3}};
    const Regions<double> regions(mesh, labels, 9);
    std::array<Leg<double>, 4> legs;
    ASSERT_EQ(regions.walk(ray, legs), 3U);
    EXPECT_EQ(legs[0].exit, 0x1p-840);
    EXPECT_EQ(legs[1].entry, 0x1p-840);
}

template <class Scalar>
class RayQueriesSoak : public ::testing::Test {};
TYPED_TEST_SUITE(RayQueriesSoak, Scalars, );

TYPED_TEST(RayQueriesSoak, ten_million_decisions) {
    EXPECT_GE(judge<TypeParam>(10000, 50, 92), std::size_t{5'000'000});
}

}  // namespace
}  // namespace pierce::test
