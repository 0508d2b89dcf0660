// Batches are single calls, to the last bit: however the queries are stored, cut into calls, spread over threads, and
// under all options.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>
#include <query/batch_world.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/real_meshes.h>
#include <support/setting.h>

namespace pierce::test {
namespace {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;

/// The answers of single calls.
template <class Scalar>
struct Expected {
    Expected(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments, QueryOptions options) {
        const std::uint64_t invalid_before = mesh.statistics().invalid_queries;
        options.counters = &counters;
        for (const Segment<Scalar>& s : segments) hits.push_back(mesh.first_hit(s, options));
        invalid = mesh.statistics().invalid_queries - invalid_before;
        options.counters = nullptr;
        for (const Segment<Scalar>& s : segments) any.push_back(mesh.any_hit(s, options) ? 1 : 0);
        for (const auto& hit : hits) count += hit ? 1U : 0U;
    }
    std::vector<std::optional<Hit<Scalar>>> hits;
    std::vector<std::uint8_t> any;
    std::size_t count = 0;
    std::uint64_t invalid = 0;
    QueryCounters counters;
};

/// Compares the calls of one batch with the expected answers. Every answer is something else before.
template <class Scalar>
class Comparison {
  public:
    Comparison(const CollisionMesh<Scalar>& mesh, const Expected<Scalar>& expected, const BatchOptions& options)
        : mesh_(mesh), expected_(expected), options_(options) {
        options_.counters = &counters_;
    }

    /// `call(out, options)` asks for first hits, or sweeps.
    template <class Answer, class Call>
    void first(const char* how, Call&& call) {
        std::vector<std::optional<Answer>> out(expected_.hits.size());
        for (std::size_t i = 0; i < out.size(); i += 2) out[i].emplace().face = 77;
        counted(how, [&] { return call(std::span(out), options_); });
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::optional<Hit<Scalar>> hit = out[i] ? std::optional<Hit<Scalar>>(*out[i]) : std::nullopt;
            ASSERT_TRUE(same_answer(hit, expected_.hits[i])) << how << ", query " << i;
            if constexpr (std::is_same_v<Answer, SweepHit<Scalar>>) {
                ASSERT_TRUE(!hit || bits(out[i]->time_of_impact) == bits(hit->fraction)) << how << ", query " << i;
            }
        }
    }
    template <class Call>
    void any(const char* how, Call&& call) {
        std::vector<std::uint8_t> out(expected_.any.size(), 77);
        counted(how, [&] { return call(std::span(out), options_); });
        ASSERT_EQ(out, expected_.any) << how;
    }

  private:
    template <class Call>
    void counted(const char* how, Call&& call) {
        counters_ = {};
        const std::uint64_t invalid_before = mesh_.statistics().invalid_queries;
        EXPECT_EQ(call(), expected_.count) << how;
        EXPECT_EQ(mesh_.statistics().invalid_queries - invalid_before, expected_.invalid) << how;
        EXPECT_EQ(counters_.queries, expected_.hits.size()) << how;
    }

    const CollisionMesh<Scalar>& mesh_;
    const Expected<Scalar>& expected_;
    BatchOptions options_;
    QueryCounters counters_;
};

/// All ways to ask.
template <class Scalar>
void compare(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments, const BatchOptions& options,
             const Expected<Scalar>& expected) {
    using Found = Hit<Scalar>;
    using Swept = SweepHit<Scalar>;
    const auto count = static_cast<Eigen::Index>(segments.size());
    std::vector<Vec3<Scalar>> starts;
    std::vector<Vec3<Scalar>> ends;
    Matrix<Scalar> from(3, count);
    Matrix<Scalar> to(3, count);
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> state =
        Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>::Zero(8, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Segment<Scalar>& s = segments[static_cast<std::size_t>(i)];
        starts.push_back(s.from);
        ends.push_back(s.to);
        from.col(i) = s.from;
        to.col(i) = s.to;
        state.col(i) << 7, s.from, s.to, 7;
    }
    const Eigen::Map<const Matrix<Scalar>> map(to.data(), 3, count);
    // Columns of this one are not contiguous: it is copied.
    const Eigen::Matrix<Scalar, 3, Eigen::Dynamic, Eigen::RowMajor> rows = from;

    Comparison<Scalar> c(mesh, expected, options);
    c.template first<Found>("segments", [&](auto out, const auto& o) { return mesh.first_hits(segments, out, o); });
    c.template first<Found>("matrices", [&](auto out, const auto& o) { return mesh.first_hits(from, to, out, o); });
    c.template first<Found>("a map", [&](auto out, const auto& o) { return mesh.first_hits(from, map, out, o); });
    c.template first<Found>("blocks", [&](auto out, const auto& o) {
        return mesh.first_hits(state.middleRows(1, 3), state.middleRows(4, 3), out, o);
    });
    c.template first<Swept>("swept spans",
                            [&](auto out, const auto& o) { return mesh.sweep_points(starts, ends, out, o); });
    c.template first<Swept>("swept rows", [&](auto out, const auto& o) { return mesh.sweep_points(rows, to, out, o); });
    c.template first<Swept>("swept blocks", [&](auto out, const auto& o) {
        return mesh.sweep_points(from, state.middleRows(4, 3), out, o);
    });
    c.any("any of segments", [&](auto out, const auto& o) { return mesh.any_hits(segments, out, o); });
    c.any("any of blocks", [&](auto out, const auto& o) { return mesh.any_hits(state.middleRows(1, 3), map, out, o); });
}

template <class Scalar>
void compare(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments,
             const BatchOptions& options = {}) {
    compare<Scalar>(mesh, segments, options, Expected<Scalar>(mesh, segments, options));
}

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
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Sides sides : {Sides::front, Sides::back, Sides::both})
        for (const double most : {0.0, 0.3, 1.0, 1e300, -0.5, nan})
            for (const bool masked : {false, true})
                for (const bool asked : {false, true}) {
                    SCOPED_TRACE(::testing::Message() << int(sides) << ' ' << most << ' ' << masked << ' ' << asked);
                    BatchOptions options;
                    options.sides = sides;
                    options.max_fraction = most;
                    if (masked) options.face_mask = mask;
                    if (asked) options.accept = accept;
                    compare<TypeParam>(this->mesh_, segments, options);
                }
}

TYPED_TEST(Batches, hold_for_every_executor_and_chunking) {
    const auto segments = this->segments(5000, 4);
    const Expected<TypeParam> expected(this->mesh_, segments, {});
    const Reversed reversed;
    const Threads threads;
    BatchOptions options;
    options.executor = reversed;
    compare<TypeParam>(this->mesh_, segments, options, expected);
    options.executor = threads;
    for (int repetition = 0; repetition < 5; ++repetition) compare<TypeParam>(this->mesh_, segments, options, expected);

    Random random(5);
    std::vector<std::optional<Hit<TypeParam>>> out(segments.size());
    std::size_t hits = 0;
    for (std::size_t first = 0; first < segments.size();) {
        const std::size_t some = std::min(segments.size() - first, random.below(random.chance(0.1) ? 2000 : 40));
        hits += this->mesh_.first_hits(std::span(segments).subspan(first, some), std::span(out).subspan(first, some),
                                       options);
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
        compare<TypeParam>(mesh, segments, {}, Expected<TypeParam>(this->mesh_, segments, {}));
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
            BatchOptions options;
            options.counters = &counters;
            mesh.first_hits(segments, hits, options);
            EXPECT_EQ(fields(counters), fields(single));
            counters = {};
            mesh.any_hits(segments, found, options);
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
    const Threads threads;
    for_each_setting([&](int rounding, bool flush) {
        for (const Executor executor : {Executor(), Executor(threads)}) {
            BatchOptions options;
            options.executor = executor;
            std::vector<std::optional<Hit<TypeParam>>> out(segments.size());
            {
                const Setting setting(rounding, flush);
                this->mesh_.first_hits(segments, out, options);
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
    const Threads threads;
    BatchOptions options;
    options.executor = threads;
    compare<TypeParam>(mesh, batch_segments(soup.view(), 10'000, 7), options);
}

template <class Call>
void expect_refused(Call&& call, const std::array<const char*, 3>& numbers) {
    try {
        call();
        ADD_FAILURE() << "not refused";
    } catch (const std::invalid_argument& error) {
        const std::string_view what = error.what();
        EXPECT_NE(what.find(std::string(numbers[0]) + " starts"), what.npos) << what;
        EXPECT_NE(what.find(std::string(numbers[1]) + " ends"), what.npos) << what;
        EXPECT_NE(what.find(std::string(numbers[2]) + " answers"), what.npos) << what;
    }
}

TYPED_TEST(Batches, refuse_sizes_that_do_not_fit) {
    const auto segments = this->segments(41, 8);
    const std::vector<Vec3<TypeParam>> points(41, Vec3<TypeParam>::Zero());
    const std::vector<Vec3<TypeParam>> fewer(39, Vec3<TypeParam>::Zero());
    const Matrix<TypeParam> columns = Matrix<TypeParam>::Zero(3, 41);
    const Matrix<TypeParam> less = columns.leftCols(39);
    std::vector<std::optional<Hit<TypeParam>>> hits(43);
    std::vector<std::optional<SweepHit<TypeParam>>> swept(41);
    std::vector<std::uint8_t> any(40, 77);
    const auto& mesh = this->mesh_;
    expect_refused([&] { mesh.first_hits(segments, hits); }, {"41", "41", "43"});
    expect_refused([&] { mesh.any_hits(segments, any); }, {"41", "41", "40"});
    expect_refused([&] { mesh.any_hits(columns, columns, any); }, {"41", "41", "40"});
    expect_refused([&] { mesh.first_hits(columns, less, hits); }, {"41", "39", "43"});
    expect_refused([&] { mesh.sweep_points(points, fewer, swept); }, {"41", "39", "41"});
    expect_refused([&] { mesh.sweep_points(less, columns, swept); }, {"39", "41", "41"});
    expect_refused([&] { mesh.any_hits(std::span(segments).first(0), any); }, {"0", "0", "40"});
    EXPECT_EQ(any, std::vector<std::uint8_t>(40, 77));
}

}  // namespace
}  // namespace pierce::test
