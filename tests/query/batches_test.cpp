// Batches are single calls, to the last bit: however the queries are stored, cut into calls, spread over threads, and
// under all options.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>
#include <query/batch_comparison.h>
#include <query/batch_world.h>
#include <support/executors.h>
#include <support/real_meshes.h>
#include <support/setting.h>

namespace pierce::test {
namespace {

template <class Scalar>
class Batches : public ::testing::Test {
  protected:
    [[nodiscard]] std::vector<Segment<Scalar>> segments(std::size_t count, std::uint64_t seed) const {
        return batch_segments(soup_.view(), count, seed);
    }
    const TriangleSoup<Scalar> soup_ = lattice_and_shards<Scalar>();
    const CollisionMesh<Scalar> mesh_{soup_.view()};
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Batches, Scalars);

// None, one, around the 16 that are under way together, around the 1024 of a part, and several parts with a rest.
TYPED_TEST(Batches, are_single_calls_for_every_size) {
    for (const std::size_t count :
         {0U, 1U, 2U, 15U, 16U, 17U, 31U, 32U, 33U, 100U, 1023U, 1024U, 1025U, 2049U, 5000U}) {
        SCOPED_TRACE(count);
        compare<TypeParam>(this->mesh_, this->segments(count, count));
    }
}

TYPED_TEST(Batches, count_what_is_not_finite) {
    const auto segments = this->segments(3000, 1);
    const Expected<TypeParam> expected(this->mesh_, segments, {});
    EXPECT_GT(expected.invalid, 30U);
    EXPECT_GT(expected.count, 600U);
    EXPECT_LT(expected.count, 2400U);
    // Nothing but such queries, so that none is ever under way.
    const Vec3<TypeParam> nowhere(0, std::numeric_limits<TypeParam>::quiet_NaN(), 0);
    compare<TypeParam>(this->mesh_, std::vector<Segment<TypeParam>>(1100, Segment<TypeParam>{nowhere, nowhere}));
}

TYPED_TEST(Batches, hold_under_all_options) {
    const auto segments = this->segments(1300, 2);
    std::vector<std::uint8_t> mask(this->soup_.triangles.size() / 2 - 9);
    Random random(3);
    for (auto& m : mask) m = random.chance(0.6) ? 1 : 0;
    const auto accept = [](const Contact& contact) {
        return contact.triangle % 3 != 0 || contact.feature != Feature::face;
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Sides sides : {Sides::front, Sides::back, Sides::both})
        for (const double most : {0.0, 0.3, 1.0, 1e300, infinity, -0.5, nan})
            for (const bool masked : {false, true})
                for (const bool asked : {false, true}) {
                    SCOPED_TRACE(::testing::Message() << int(sides) << ' ' << most << ' ' << masked << ' ' << asked);
                    QueryOptions options{.sides = sides, .max_fraction = most};
                    if (masked) options.face_mask = mask;
                    if (asked) options.accept = accept;
                    compare<TypeParam>(this->mesh_, segments, options);
                }
}

TYPED_TEST(Batches, hold_for_every_executor_and_chunking) {
    const auto segments = this->segments(5000, 4);
    const Expected<TypeParam> expected(this->mesh_, segments, {});
    compare<TypeParam>(this->mesh_, segments, {}, Reversed(), expected);
    for (int repetition = 0; repetition < 5; ++repetition)
        compare<TypeParam>(this->mesh_, segments, {}, Threads(), expected);

    Random random(5);
    std::vector<std::optional<Hit<TypeParam>>> out(segments.size());
    std::size_t hits = 0;
    for (std::size_t first = 0; first < segments.size();) {
        const std::size_t some = std::min(segments.size() - first, random.below(random.chance(0.1) ? 2000 : 40));
        hits += this->mesh_.first_hits(std::span(segments).subspan(first, some), std::span(out).subspan(first, some),
                                       {}, Threads());
        first += some;
    }
    EXPECT_EQ(hits, expected.count);
    for (std::size_t i = 0; i < out.size(); ++i) ASSERT_TRUE(same_answer(out[i], expected.hits[i])) << i;
}

// One cell for all triangles, which is read in parts; cells much smaller than the triangles; levels in between.
TYPED_TEST(Batches, hold_for_every_grid) {
    const auto segments = this->segments(1500, 6);
    for (const double cell : {1e300, 0.05, 0.5}) {
        SCOPED_TRACE(cell);
        const CollisionMesh<TypeParam> mesh(this->soup_.view(),
                                            {.cell_size = cell, .max_grid_bytes = std::size_t{1} << 24});
        compare<TypeParam>(mesh, segments, {}, {}, Expected<TypeParam>(this->mesh_, segments, {}));
    }
    const CollisionMesh<TypeParam> nothing{MeshView<TypeParam>{}};
    compare<TypeParam>(nothing, segments);
}

// A thread starts in the arithmetic of the one that made it.
std::array<std::uint64_t, 9> fields(const QueryCounters& c) {
    static_assert(sizeof c == 9 * sizeof(std::uint64_t));
    return {c.queries,      c.nodes,        c.clusters,    c.triangles, c.exact_decisions,
            c.exact_orders, c.exact_values, c.exact_sides, c.retreats};
}

// What is counted once depended on a query's neighbours: with crowded cells, on whether the list of all of them was
// full.
TYPED_TEST(Batches, count_as_single_calls_do_whoever_is_beside_them) {
    auto stadium = this->soup_;  // small and large triangles, for more than one level
    const auto hills = moved<TypeParam>(terrain(40, 0.1, 3), 1e-3, Vec3<double>::Zero());
    stadium.faces.clear();
    append(stadium, hills);
    for (const double cell : {0.0, 0.1, 1.0, 10.0}) {
        const CollisionMesh<TypeParam> mesh(stadium.view(), {.cell_size = cell});
        std::vector<Segment<TypeParam>> segments = batch_segments(stadium.view(), 1500, 9);
        const auto near = batch_segments(hills.view(), 1500, 10);
        for (std::size_t i = 0; i < near.size(); ++i)
            segments.insert(segments.begin() + static_cast<std::ptrdiff_t>(2 * i), near[i]);
        QueryCounters single;
        for (const auto& s : segments) std::ignore = mesh.first_hit(s, {.counters = &single});
        QueryCounters any;
        for (const auto& s : segments) std::ignore = mesh.any_hit(s, {.counters = &any});
        std::vector<std::optional<Hit<TypeParam>>> hits(segments.size());
        std::vector<std::uint8_t> found(segments.size());
        for (int order = 0; order < 3; ++order) {
            SCOPED_TRACE(std::to_string(cell) + ", order " + std::to_string(order));
            QueryCounters counters;
            mesh.first_hits(segments, hits, {.counters = &counters});
            EXPECT_EQ(fields(counters), fields(single));
            counters = {};
            mesh.any_hits(segments, found, {.counters = &counters});
            EXPECT_EQ(fields(counters), fields(any));
            std::rotate(segments.begin(), segments.begin() + 7, segments.end());
            if (order == 1)
                std::sort(segments.begin(), segments.end(),
                          [](const auto& a, const auto& b) { return a.from[0] < b.from[0]; });
        }
    }
}

TYPED_TEST(Batches, hold_in_every_floating_point_environment) {
    const auto segments = this->segments(1500, 9);
    const Expected<TypeParam> expected(this->mesh_, segments, {});
    for_each_setting([&](int rounding, bool flush) {
        for (const Executor& executor : {Executor(), Executor(Threads())}) {
            std::vector<std::optional<Hit<TypeParam>>> out(segments.size());
            {
                const Setting setting(rounding, flush);
                this->mesh_.first_hits(segments, out, {}, executor);
                setting.expect_given_back();
            }
            for (std::size_t i = 0; i < out.size(); ++i)
                ASSERT_TRUE(same_answer(out[i], expected.hits[i])) << rounding << ' ' << flush << ' ' << i;
        }
    });
}

TYPED_TEST(Batches, hold_for_a_real_mesh) {
    const TriangleSoup<TypeParam> soup = real_mesh<TypeParam>("elephant");
    const CollisionMesh<TypeParam> mesh(soup.view());
    compare<TypeParam>(mesh, batch_segments(soup.view(), 10'000, 7), {}, Threads());
}

template <class Call>
void expect_refused(Call&& call, const char* message) {
    try {
        call();
        ADD_FAILURE() << "not refused: " << message;
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), message);
    }
}

TYPED_TEST(Batches, refuse_sizes_that_do_not_fit) {
    const auto segments = this->segments(41, 8);
    const std::vector<Vec3<TypeParam>> points(41, Vec3<TypeParam>::Zero());
    const std::vector<Vec3<TypeParam>> fewer(39, Vec3<TypeParam>::Zero());
    const Matrix<TypeParam> columns = Matrix<TypeParam>::Zero(3, 41);
    std::vector<std::optional<Hit<TypeParam>>> hits(43);
    std::vector<Hit<TypeParam>> plain(41, no_hit<TypeParam>);
    std::vector<std::uint8_t> any(40, 77);
    const HitArrays<TypeParam> arrays{.count = 40, .hit = any.data()};
    const auto& mesh = this->mesh_;
    expect_refused([&] { mesh.first_hits(segments, hits); }, "first_hits: 41 segments and 43 places for answers");
    expect_refused([&] { mesh.first_hits(segments, arrays); }, "first_hits: 41 segments and 40 places for answers");
    expect_refused([&] { mesh.any_hits({columns, points}, any); }, "any_hits: 41 segments and 40 places for answers");
    expect_refused([&] { mesh.first_hits({columns, fewer}, hits); }, "first_hits: 41 starts and 39 ends");
    expect_refused([&] { mesh.sweeps({fewer, columns}, plain); }, "sweeps: 39 starts and 41 ends");
    expect_refused([&] { mesh.any_hits(std::span(segments).first(0), any); },
                   "any_hits: 0 segments and 40 places for answers");
    EXPECT_EQ(any, std::vector<std::uint8_t>(40, 77));
}

}  // namespace
}  // namespace pierce::test
