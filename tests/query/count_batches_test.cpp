// Batches of counts and places, and of all hits as compressed rows, are single calls to the last bit: whatever the
// executor, the broadphase and the order of the queries.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>
#include <query/batch_world.h>
#include <support/executors.h>
#include <support/expect_hit.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

/// Points of all kinds: anywhere in and around the mesh, on its faces, edges and corners, and not finite; and those of
/// a grid. Few are in its order, many in no order, so that they are sorted.
template <class Scalar>
std::vector<Vec3<Scalar>> batch_points(const MeshView<Scalar>& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<Vec3<Scalar>> points;
    for (const Segment<Scalar>& segment : batch_segments(mesh, count / 2, seed)) points.push_back(segment.to);
    const Extent<Scalar> extent(mesh);
    constexpr int n = 16;
    for (int i = 0; points.size() < count; ++i) {
        const V part = (V(i % n, i / n % n, i / n / n) + V(0.5, 0.5, 0.5)) / n;
        points.push_back((extent.low + (extent.high - extent.low).cwiseProduct(part)).template cast<Scalar>());
    }
    Random random(seed);
    if (count > 5000)
        for (std::size_t i = points.size(); i-- > 1;) std::swap(points[i], points[random.below(i + 1)]);
    return points;
}

template <class Scalar>
void expect_same_as_single_calls(const TriangleSoup<Scalar>& soup, std::size_t count,
                                 std::size_t on_surface_at_least = 0) {
    const std::vector<Vec3<Scalar>> points = batch_points(soup.view(), count, 4);
    const std::vector<Segment<Scalar>> segments = batch_segments(soup.view(), count, 5);
    const Reversed reversed;
    const Threads threads;
    for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
        const CollisionMesh<Scalar> mesh(soup.view(), {.broadphase = broadphase});
        for (const Executor& executor : {Executor(), Executor(reversed), Executor(threads)}) {
            QueryCounters counters;
            std::vector<std::uint8_t> inside(count, 77);
            std::vector<int> winding(count, 77);
            std::vector<Location> places(count, {Place::inside, 77, 77});
            std::vector<int> crossings(count, 77);
            const std::uint64_t before = mesh.statistics().invalid_queries;
            const std::size_t contained = mesh.contains_points(points, inside, &counters, executor);
            mesh.winding_numbers(points, winding, &counters, executor);
            const std::size_t on_surface = mesh.locate_points(points, places, &counters, executor);
            mesh.crossings(segments, crossings, &counters, executor);
            const std::uint64_t invalid = mesh.statistics().invalid_queries - before;
            EXPECT_EQ(counters.queries, 4 * count);
            EXPECT_GT(counters.nodes, count);
            std::size_t expected_contained = 0;
            std::size_t expected_on_surface = 0;
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(inside[i], mesh.contains(points[i]) ? 1 : 0) << points[i].transpose();
                ASSERT_EQ(winding[i], mesh.winding_number(points[i])) << points[i].transpose();
                const Location location = mesh.locate(points[i]);
                ASSERT_EQ(places[i].place, location.place) << points[i].transpose();
                ASSERT_EQ(places[i].winding_number, location.winding_number);
                ASSERT_EQ(places[i].face_count, location.face_count);
                ASSERT_EQ(crossings[i], mesh.crossings(segments[i])) << to_text(segments[i]);
                expected_contained += inside[i];
                expected_on_surface += location.place == Place::on_surface ? 1U : 0U;
            }
            EXPECT_EQ(mesh.statistics().invalid_queries - before, 2 * invalid);
            EXPECT_EQ(contained, expected_contained);
            EXPECT_EQ(on_surface, expected_on_surface);
            EXPECT_GT(contained, count / 50);
            EXPECT_LT(contained, count - count / 50);
            EXPECT_GE(on_surface, on_surface_at_least);
            EXPECT_GT(invalid, 0U);
        }
    }
}

TEST(CountBatches, are_single_calls) {
    expect_same_as_single_calls(lattice_and_shards<float>(), 3000, 60);
    expect_same_as_single_calls(lattice_and_shards<double>(), 3000, 60);
    expect_same_as_single_calls(moved<double>(bumpy_sphere(60), 1e5, V(1e5, 0, 3)), 6000);
    expect_same_as_single_calls(moved<float>(bumpy_sphere(60), 1e-20, V(0, 0, 0)), 6000);
    expect_same_as_single_calls(moved<double>(bumpy_sphere(20), 1e-300, V(0, 0, 0)), 3000);
    expect_same_as_single_calls(moved<double>(bumpy_sphere(20), 1e300, V(0, 0, 0)), 3000);
}

// On an open mesh the answer is that of a point's own way out: a batch that shared ways would differ here.
TEST(CountBatches, keep_the_ways_out_of_open_meshes) {
    TriangleSoup<double> soup = bumpy_sphere(40);
    Random random(9);
    std::erase_if(soup.triangles, [&](const IndexTriple&) { return random.chance(0.3); });
    const CollisionMesh<double> mesh(soup.view());
    std::vector<V> points;
    for (int i = 0; i < 20'000; ++i) points.push_back(0.9 * random.in_cube());
    std::vector<int> winding(points.size());
    mesh.winding_numbers(points, winding);
    int inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(winding[i], mesh.winding_number(points[i])) << points[i].transpose();
        inside += winding[i];
    }
    EXPECT_GT(inside, 5'000);
    EXPECT_LT(inside, 15'000);
}

TEST(CountBatches, say_what_does_not_fit) {
    const CollisionMesh<double> mesh(bumpy_sphere(4).view());
    const std::vector<V> points(3, V(0, 0, 0));
    std::vector<std::uint8_t> two(2);
    std::vector<int> four(4);
    std::vector<Location> none;
    std::vector<std::size_t> offsets(3);
    const std::vector<Segment<double>> segments(3, {V(0, 0, 0), V(9, 0, 0)});
    try {
        mesh.contains_points(points, two);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "contains_points: 3 points and 2 places for answers");
    }
    EXPECT_THROW(mesh.winding_numbers(points, four), std::invalid_argument);
    EXPECT_THROW(mesh.locate_points(points, none), std::invalid_argument);
    EXPECT_THROW(mesh.crossings(segments, four), std::invalid_argument);
    EXPECT_THROW(mesh.all_hits(segments, offsets, {}), std::invalid_argument);
    mesh.winding_numbers({}, {});
    mesh.crossings({}, std::span<int>());
}

template <class Scalar>
void expect_rows(const QueryOptions& given, const Executor& executor = {}) {
    const TriangleSoup<Scalar> soup = lattice_and_shards<Scalar>();
    const CollisionMesh<Scalar> mesh(soup.view());
    const std::vector<Segment<Scalar>> segments = batch_segments(soup.view(), 2500, 6);
    QueryCounters counters;
    QueryOptions options = given;
    options.counters = &counters;
    std::vector<std::size_t> offsets(segments.size() + 1, 77);
    const std::uint64_t before = mesh.statistics().invalid_queries;
    const std::size_t total = mesh.all_hits(segments, offsets, {}, options, executor);
    EXPECT_GT(mesh.statistics().invalid_queries, before);
    EXPECT_EQ(counters.queries, segments.size());
    ASSERT_EQ(offsets.back(), total);
    ASSERT_EQ(offsets.front(), 0U);
    std::vector<Hit<Scalar>> row(1000);
    for (const std::size_t room : {total, total + 5, total / 2}) {
        std::vector<Hit<Scalar>> hits(room);
        for (Hit<Scalar>& hit : hits) hit.face = 123'456;
        std::fill(offsets.begin(), offsets.end(), 77);
        ASSERT_EQ(mesh.all_hits(segments, offsets, hits, options, executor), total);
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const std::size_t count = mesh.all_hits(segments[i], row, given);
            ASSERT_EQ(offsets[i + 1] - offsets[i], count);
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t at = offsets[i] + k;
                if (offsets[i + 1] <= room) {
                    ASSERT_TRUE(same_bits(hits[at], row[k])) << i;
                } else if (at < room) {
                    ASSERT_EQ(hits[at].face, 123'456U) << i;
                }
            }
        }
    }
}

TEST(HitRows, are_those_of_single_calls) {
    const Threads threads;
    QueryOptions options;
    expect_rows<double>(options);
    options.sides = Sides::both;
    expect_rows<float>(options, std::ref(threads));
    options.max_fraction = 0.3;
    expect_rows<double>(options, std::ref(threads));
    const CollisionMesh<double> mesh(bumpy_sphere(4).view());
    const std::vector<Segment<double>> segments(3, {V(9, 0.1, 0.2), V(0, 0.1, 0.2)});
    std::vector<std::size_t> offsets(4);
    EXPECT_EQ(mesh.all_hits(segments, offsets, {}), 3U);
    options.max_fraction = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(mesh.all_hits(segments, offsets, {}, options), 0U);
    std::vector<std::size_t> one(1, 7);
    EXPECT_EQ(mesh.all_hits({}, one, {}), 0U);
    EXPECT_EQ(one[0], 0U);
}

}  // namespace
}  // namespace pierce::test
