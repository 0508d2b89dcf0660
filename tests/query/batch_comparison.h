// Batches against single calls, to the last bit, for every way to ask and every kind of places for the answers.
#pragma once

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>

namespace pierce::test {

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

/// Every kind of places for answers, each with something else in it before.
template <class Scalar>
struct Places {
    explicit Places(std::size_t count) : optionals(count), plain(count), numbers(14 * count, -7), bytes(5 * count, 77) {
        for (std::size_t i = 0; i < count; i += 2) optionals[i].emplace().face = 77;
        std::memset(static_cast<void*>(plain.data()), 0xab, count * sizeof(Hit<Scalar>));
        words.assign(2 * count, 77);
        sides.assign(count, Sides::both);
        features.assign(count, Feature::vertex);
        arrays.count = count;
        Scalar* number = numbers.data();
        for (Scalar** array : {&arrays.fraction, &arrays.exact_fraction})
            *array = std::exchange(number, number + count);
        for (Scalar** array : {&arrays.point, &arrays.position, &arrays.normal, &arrays.barycentric})
            *array = std::exchange(number, number + 3 * count);
        arrays.face = words.data();
        arrays.triangle = words.data() + count;
        arrays.side = sides.data();
        arrays.feature = features.data();
        std::uint8_t* byte = bytes.data();
        for (std::uint8_t** array : {&arrays.hit, &arrays.feature_index, &arrays.at_start})
            *array = std::exchange(byte, byte + count);
    }
    /// What the arrays say of query i.
    [[nodiscard]] Hit<Scalar> gathered(std::size_t i) const {
        const auto three = [i](const Scalar* x) { return Coordinates<Scalar>(x[3 * i], x[3 * i + 1], x[3 * i + 2]); };
        return {arrays.fraction[i],
                three(arrays.point),
                three(arrays.position),
                three(arrays.normal),
                three(arrays.barycentric),
                arrays.exact_fraction[i],
                arrays.face[i],
                arrays.triangle[i],
                arrays.side[i],
                arrays.feature[i],
                arrays.feature_index[i],
                arrays.at_start[i] != 0,
                0};
    }
    std::vector<std::optional<Hit<Scalar>>> optionals;
    std::vector<Hit<Scalar>> plain;
    std::vector<Scalar> numbers;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint32_t> words;
    std::vector<Sides> sides;
    std::vector<Feature> features;
    HitArrays<Scalar> arrays;
};

/// Compares the calls of one batch with the expected answers.
template <class Scalar>
class Comparison {
  public:
    Comparison(const CollisionMesh<Scalar>& mesh, const Expected<Scalar>& expected, const QueryOptions& options,
               const Executor& executor)
        : mesh_(mesh), expected_(expected), options_(options), executor_(executor) {
        options_.counters = &counters_;
    }

    void first(const char* how, const Segments<Scalar>& segments) {
        Places<Scalar> places(expected_.hits.size());
        counted(how, [&] { return mesh_.first_hits(segments, places.optionals, options_, executor_); });
        for (std::size_t i = 0; i < segments.size(); ++i)
            ASSERT_TRUE(same_answer(places.optionals[i], expected_.hits[i])) << how << ", query " << i;
    }
    void sweeps_to_plain_hits(const char* how, const Segments<Scalar>& segments) {
        Places<Scalar> places(expected_.hits.size());
        counted(how, [&] { return mesh_.sweeps(segments, places.plain, options_, executor_); });
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Hit<Scalar> expected = expected_.hits[i].value_or(no_hit<Scalar>);
            ASSERT_EQ(static_cast<bool>(places.plain[i]), expected_.hits[i].has_value()) << how << ", query " << i;
            // The caller's bytes, all of them: nothing of what was there before is left.
            ASSERT_EQ(std::memcmp(&places.plain[i], &expected, sizeof expected), 0) << how << ", query " << i;
        }
    }
    void first_to_arrays(const char* how, const Segments<Scalar>& segments) {
        Places<Scalar> places(expected_.hits.size());
        counted(how, [&] { return mesh_.first_hits(segments, places.arrays, options_, executor_); });
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Hit<Scalar> hit = places.gathered(i);
            ASSERT_EQ(places.arrays.hit[i], expected_.hits[i] ? 1 : 0) << how << ", query " << i;
            ASSERT_TRUE(same_bits(hit, expected_.hits[i].value_or(no_hit<Scalar>))) << how << ", query " << i;
        }
        // Only some of them.
        Places<Scalar> some(expected_.hits.size());
        const HitArrays<Scalar> two{.count = segments.size(), .point = some.arrays.point, .face = some.arrays.face};
        counted(how, [&] { return mesh_.first_hits(segments, two, options_, executor_); });
        EXPECT_EQ(some.words.size(), 2 * segments.size());
        EXPECT_TRUE(
            std::equal(some.words.begin(), some.words.begin() + std::ptrdiff_t(segments.size()), places.words.begin()));
        EXPECT_EQ(std::count(some.bytes.begin(), some.bytes.end(), 77), std::ptrdiff_t(some.bytes.size()));
        EXPECT_EQ(std::count(some.words.begin() + std::ptrdiff_t(segments.size()), some.words.end(), 77U),
                  std::ptrdiff_t(segments.size()));
    }
    void any(const char* how, const Segments<Scalar>& segments) {
        std::vector<std::uint8_t> out(expected_.any.size(), 77);
        counted(how, [&] { return mesh_.any_hits(segments, out, options_, executor_); });
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
    QueryOptions options_;
    Executor executor_;
    QueryCounters counters_;
};

/// All ways to ask.
template <class Scalar>
void compare(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments, const QueryOptions& options,
             const Executor& executor, const Expected<Scalar>& expected) {
    const auto count = static_cast<Eigen::Index>(segments.size());
    std::vector<Vec3<Scalar>> starts;
    std::vector<Vec3<Scalar>> ends;
    Matrix<Scalar> from(3, count);
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> state =
        Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>::Zero(8, count);
    // As a game has them: something else between the points, and no alignment; the last one first.
    constexpr std::size_t k_stride = 3 * sizeof(Scalar) + 5;
    std::vector<unsigned char> bytes(k_stride * segments.size() + 1);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Segment<Scalar>& s = segments[static_cast<std::size_t>(i)];
        starts.push_back(s.from);
        ends.push_back(s.to);
        from.col(i) = s.from;
        state.col(i) << 7, s.from, s.to, 7;
        std::memcpy(bytes.data() + 1 + k_stride * static_cast<std::size_t>(count - 1 - i), s.to.data(), sizeof s.to);
    }
    const Eigen::Map<const Matrix<Scalar>> map(ends.empty() ? nullptr : ends[0].data(), 3, count);
    const void* last = bytes.data() + 1 + (segments.empty() ? 0 : k_stride * (segments.size() - 1));
    const PointsView<Scalar> backwards(static_cast<const Scalar*>(last), segments.size(),
                                       -static_cast<std::ptrdiff_t>(k_stride));

    Comparison<Scalar> c(mesh, expected, options, executor);
    c.first("segments", segments);
    c.first("matrices", {from, map});
    c.first("blocks", {state.middleRows(1, 3), state.middleRows(4, 3)});
    c.first("bytes", {starts, backwards});
    c.sweeps_to_plain_hits("swept spans", {starts, ends});
    c.sweeps_to_plain_hits("swept blocks", {from, state.middleRows(4, 3)});
    c.first_to_arrays("arrays", segments);
    c.any("any of segments", segments);
    c.any("any of blocks", {state.middleRows(1, 3), map});
}

template <class Scalar>
void compare(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments,
             const QueryOptions& options = {}, const Executor& executor = {}) {
    compare<Scalar>(mesh, segments, options, executor, Expected<Scalar>(mesh, segments, options));
}

}  // namespace pierce::test
