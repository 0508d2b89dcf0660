// What a query went through is counted, all of it, one by one and in batches; and the longest of segments ask little of
// the exact room.
#include <numeric>
#include <utility>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

void expect_equal(const QueryCounters& x, const QueryCounters& y) {
    EXPECT_EQ(x.queries, y.queries);
    EXPECT_EQ(x.nodes, y.nodes);
    EXPECT_EQ(x.clusters, y.clusters);
    EXPECT_EQ(x.triangles, y.triangles);
    EXPECT_EQ(x.exact_decisions, y.exact_decisions);
    EXPECT_EQ(x.exact_orders, y.exact_orders);
    EXPECT_EQ(x.exact_values, y.exact_values);
    EXPECT_EQ(x.exact_sides, y.exact_sides);
    EXPECT_EQ(x.retreats, y.retreats);
}

template <class Scalar>
void expect_all_counted() {
    TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(6), 1, {100, 0, 0});  // so that sides of points are close
    // Two faces in one tilted plane that share no corner: hits on them are ties that only exact arithmetic finds.
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const auto& [x, y] : {std::pair{90, -10}, {110, -10}, {100, 10}, {91, -12}, {111, -9}, {99, 12}})
        soup.positions.push_back(
            {static_cast<Scalar>(x), static_cast<Scalar>(y), static_cast<Scalar>(5 + (x - 100) * 0.25 + y * 0.5)});
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.triangles.push_back({first + 3, first + 4, first + 5});
    // Two sheets at 45 degrees that meet above all this, in a valley: what comes down on one of them close to the
    // valley must keep off both.
    const auto valley = static_cast<std::uint32_t>(soup.positions.size());
    for (const auto& [x, y, z] : {std::array{100, -10, 20}, {100, 10, 20}, {115, 0, 23}, {115, 0, 40}})
        soup.positions.push_back({static_cast<Scalar>(x), static_cast<Scalar>(y), static_cast<Scalar>(z)});
    soup.triangles.push_back({valley, valley + 2, valley + 1});
    soup.triangles.push_back({valley, valley + 1, valley + 3});
    const CollisionMesh<Scalar> mesh(soup.view());
    const Extent<Scalar> extent(soup.view());
    Random random(4);
    std::vector<Segment<Scalar>> segments;
    for (int i = 0; i < 3000; ++i) segments.push_back(mixed_segment(soup.view(), extent, random));

    for (int i = 0; i < 200; ++i) {
        const Vec3<Scalar> from = random.in_cube().template cast<Scalar>() + Vec3<Scalar>(100, 0, 7);
        const Vec3<Scalar> to = random.in_cube().template cast<Scalar>() + Vec3<Scalar>(100, 0, 3);
        segments.push_back({from, to});
    }

    for (int i = 0; i < 500; ++i) {
        const Vec3<double> at(100 + 2000 * random.unit() * double(std::numeric_limits<Scalar>::epsilon()),
                              random.between(-9, 9), 20);
        const Vec3<double> way(-random.between(1, 8), random.between(-1, 1), -random.between(0.3, 1.2));
        segments.push_back({(at - way).template cast<Scalar>(), (at + way).template cast<Scalar>()});
    }

    // And on from where they stop, a grain off a plane.
    for (std::size_t i = 0, count = segments.size(); i < count; ++i)
        if (const auto hit = mesh.first_hit(segments[i])) segments.push_back({hit->point, segments[i].to});

    QueryCounters single;
    for (const Segment<Scalar>& s : segments) (void)mesh.first_hit(s, {.counters = &single});
    EXPECT_GT(single.exact_decisions, 100U);
    EXPECT_GT(single.exact_orders, 100U);
    // Of floats, numbers of twice a double's precision leave next to nothing in doubt.
    constexpr bool k_double = sizeof(Scalar) == sizeof(double);
    EXPECT_GT(single.exact_values, k_double ? 100U : 0U);
    EXPECT_GT(single.exact_sides, 0U);
    EXPECT_GT(single.retreats, 0U);

    QueryCounters batch;
    QueryOptions options;
    options.counters = &batch;
    std::vector<std::optional<Hit<Scalar>>> hits(segments.size());
    mesh.first_hits(segments, hits, options);
    expect_equal(batch, single);

    // Values that nobody but the caller's own test sees are values all the same.
    QueryCounters asked;
    const auto no = [](const Contact&) { return false; };
    for (const Segment<Scalar>& s : segments) (void)mesh.any_hit(s, {.accept = no, .counters = &asked});
    QueryCounters unasked;
    for (const Segment<Scalar>& s : segments) (void)mesh.any_hit(s, {.counters = &unasked});
    if (k_double) {
        EXPECT_GT(asked.exact_values, unasked.exact_values);
    }
}

TEST(Counters, count_all_exact_arithmetic_in_float) { expect_all_counted<float>(); }
TEST(Counters, count_all_exact_arithmetic_in_double) { expect_all_counted<double>(); }

// A segment so long that no grid can be walked: each triangle is asked once, and the filter does not work on such a
// length.
TEST(Counters, the_longest_segments_ask_for_each_triangle_once) {
    const TriangleSoup<double> soup = bumpy_sphere(6);
    const CollisionMesh<double> mesh(soup.view());
    const std::size_t triangles = soup.triangles.size();
    Random random(5);
    int crossed = 0;
    for (int i = 0; i < 20; ++i) {
        const Vec3<double> d = 1e300 * random.direction();
        // From far away to far away past the middle, or from within.
        const Segment<double> segment{random.chance(0.5) ? Vec3<double>(-d) : Vec3<double>(0.1 * random.in_cube()), d};
        QueryCounters counters;
        crossed += mesh.any_hit(segment, {.sides = Sides::both, .counters = &counters}) ? 1 : 0;
        EXPECT_LE(counters.exact_decisions, triangles);
        EXPECT_LE(counters.triangles, triangles);
        counters = {};
        (void)mesh.crossings(segment, &counters);
        EXPECT_LE(counters.exact_decisions, triangles);
        EXPECT_LE(counters.triangles, triangles);
        counters = {};
        // Each point that is verified asks again, for the way up to it.
        EXPECT_TRUE(mesh.first_hit(segment, {.sides = Sides::both, .counters = &counters}));
        EXPECT_LE(counters.exact_decisions, triangles * (2 + counters.retreats));
    }
    EXPECT_EQ(crossed, 20);
    // One that misses everything asks for each.
    QueryCounters counters;
    EXPECT_FALSE(mesh.any_hit({{3, 3, 3}, {3, 1e300, 3}}, {.counters = &counters}));
    EXPECT_LE(counters.exact_decisions, triangles);
}

}  // namespace
}  // namespace pierce::test
