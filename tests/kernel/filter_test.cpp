// The filter is never wrong when it is certain: a million decisions against exact rational arithmetic, and a hundred
// million in the slow run. Both scalar types; all sizes from the smallest to the largest numbers there are.
#include <atomic>
#include <thread>

#include <gtest/gtest.h>
#include <exact/decide.h>
#include <exact/fraction.h>
#include <kernel/filter.h>
#include <kernel/finer_filter.h>
#include <support/gmp_oracle.h>
#include <support/pairs.h>

namespace pierce::test {
namespace {

using namespace detail;

struct Tally {
    std::atomic<std::int64_t> decisions = 0;
    std::atomic<std::int64_t> hits = 0;
    std::atomic<std::int64_t> certain = 0;
    std::atomic<std::int64_t> touching = 0;  ///< of those, by volumes that are certainly 0
    std::atomic<std::int64_t> settled = 0;   ///< of what was doubtful, by the finer filter
    std::atomic<std::int64_t> wrong = 0;
};

// Around one triangle, several segments: the pair's own, that with its ends exchanged, and some that start or end on a
// corner.
template <class Scalar>
void judge(Family family, int power, double offset, Random& random, GmpOracle& oracle, Tally& tally) {
    Pair pair = make_pair_of<Scalar>(family, 1, offset, random);
    for (Point* p : {&pair.path.from, &pair.path.to, &pair.corners[0], &pair.corners[1], &pair.corners[2]})
        for (double& x : *p) x = static_cast<double>(static_cast<Scalar>(std::ldexp(x, power)));
    if (has_zero_area(pair.corners)) return;
    const Point from = pair.path.from;
    const Point to = pair.path.to;
    const std::array<Path, 4> paths = {Path{from, to}, {to, from}, {from, pair.corners[random.below(3)]},
                                       {pair.corners[random.below(3)], to}};
    std::int64_t hits = 0;
    std::int64_t certain = 0;
    std::int64_t touching = 0;
    std::int64_t settled = 0;
    for (const Path& path : paths) {
        pair.path = path;
        const int truth = oracle.hit_side(pair.path, pair.corners);
        hits += truth != 0 ? 1 : 0;
        const auto compare = [&](const char* who, bool hit, Sides side) {
            if ((hit ? (side == Sides::front ? 1 : -1) : 0) == truth) return;
            ++tally.wrong;
            ADD_FAILURE() << who << ": " << describe(pair);
        };
        const Decision decision = decide(pair.path, pair.corners, Sides::both);
        compare("the exact room", decision.hit, decision.side);
        Measured measured;
        measure_path<Scalar>(pair.corners, pair.path, measured);
        for (const Sides sides : {Sides::both, Sides::front, Sides::back}) {
            const Decision right = sides == Sides::both ? decision : decide(pair.path, pair.corners, sides);
            const Filtered filtered = filter(measured, sides);
            const Verdict strict = filter_strictly(measured, sides).verdict;
            // What it says strictly it says of the closed rule too; what is a hit lies in the face.
            if (strict != Verdict::doubtful &&
                (strict != filtered.verdict || (strict == Verdict::hit && right.feature != Feature::face)))
                ADD_FAILURE() << "strictly: " << describe(pair);
            const auto judge_verdict = [&](const char* who, const Filtered& said) {
                const Decision& d = said.decision;
                if ((said.verdict == Verdict::hit) != right.hit ||
                    (right.hit && (d.side != right.side || d.feature != right.feature ||
                                   d.feature_index != right.feature_index || d.at_start != right.at_start))) {
                    ++tally.wrong;
                    ADD_FAILURE() << who << ": " << describe(pair);
                }
                if (!right.hit) return;
                if (!fraction_at_most(pair.path, pair.corners, std::min(1.0, said.latest)) ||
                    (said.earliest > 0 &&
                     fraction_at_most(pair.path, pair.corners, std::nextafter(said.earliest, 0)))) {
                    ++tally.wrong;
                    ADD_FAILURE() << who << "'s interval: " << describe(pair);
                }
            };
            const Filtered finer = finer_filter(measured, sides);
            if (finer.verdict != Verdict::doubtful) judge_verdict("the finer filter", finer);
            if (filtered.verdict == Verdict::doubtful) {
                settled += finer.verdict != Verdict::doubtful ? 1 : 0;
                continue;
            }
            ++certain;
            touching += strict == Verdict::doubtful ? 1 : 0;
            judge_verdict("the filter", filtered);
        }
    }
    tally.decisions += 4;
    tally.hits += hits;
    tally.certain += certain;
    tally.touching += touching;
    tally.settled += settled;
}

template <class Scalar>
void run(std::int64_t decisions, int lowest_power, int highest_power) {
    Tally tally;
    const auto work = [&](std::uint64_t seed, std::int64_t share) {
        Random random(seed);
        GmpOracle oracle;
        for (std::int64_t i = 0; i < share && tally.wrong == 0; i += 4) {
            const auto family = static_cast<Family>(random.below(k_family_names.size()));
            // The size of everyday coordinates; any size that the filter works in, and those where its products become
            // denormal or overflow; and both ends of the range.
            int power = random.between_ints(-20, 20);
            const double kind = random.unit();
            if (kind < 0.3) power = random.between_ints(std::max(lowest_power, -380), std::min(highest_power, 360));
            else if (kind < 0.4) power = random.between_ints(lowest_power, lowest_power + 60);
            else if (kind < 0.5) power = random.between_ints(highest_power - 30, highest_power);
            const double offset = random.chance(0.5) ? 0 : random.chance(0.5) ? 1e3 : 1e6;
            judge<Scalar>(family, power, offset, random, oracle, tally);
        }
    };
    // Triangles of area zero drop out of the count, so each thread is asked for more than its share.
    const unsigned count = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < count; ++i) threads.emplace_back(work, 1000 + i, decisions / count * 3 / 2);
    for (std::thread& thread : threads) thread.join();
    std::cout << tally.decisions << " decisions, " << tally.hits << " hits, " << tally.certain
              << " certain of three sides each, " << tally.touching << " of them with volumes of 0, " << tally.settled
              << " settled by the finer filter, " << tally.wrong << " wrong\n";
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GE(tally.decisions, decisions);
    EXPECT_GT(tally.hits, tally.decisions / 20);
    EXPECT_GT(tally.touching, tally.decisions / 200);
    // Of floats the filter leaves nothing in doubt that is not exactly on a plane or an edge.
    if (sizeof(Scalar) == sizeof(double)) {
        EXPECT_GT(tally.settled, tally.decisions / 1000);
    }
    EXPECT_GT(tally.certain, tally.decisions * 3 / 5);  // a filter that is always in doubt would be right as well
}

// The largest coordinates of a pair at offset 1e6 are below 2^21: they stay finite.
void run_both(std::int64_t each) {
    run<float>(each, -149, 106);
    run<double>(each, -1074, 1002);
}

TEST(Filter, is_never_wrong_in_a_million) { run_both(500'000); }
TEST(FilterSoak, is_never_wrong_in_a_hundred_million) { run_both(50'000'000); }

TEST(Filter, is_in_doubt_where_it_can_t_tell_and_knows_zeros_along_axes) {
    const auto filtered = [&](const Corners& corners, const Point& from, const Point& to) {
        Measured measured;
        measure_path<double>(corners, {from, to}, measured);
        return filter(measured, Sides::front);
    };
    const Corners corners = {Point{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto verdict = [&](const Point& from, const Point& to) { return filtered(corners, from, to).verdict; };
    EXPECT_EQ(verdict({1, 1, 1}, {1, 1, -1}), Verdict::hit);
    EXPECT_EQ(verdict({5, 5, 1}, {5, 5, -1}), Verdict::miss);
    EXPECT_EQ(verdict({1, 1, 2}, {1, 1, 1}), Verdict::miss);
    EXPECT_EQ(verdict({1, 1, -1}, {1, 1, 1}), Verdict::miss);
    // Starts on a plane along two axes, edges along one, a corner.
    EXPECT_EQ(verdict({1, 1, 0}, {1, 1, -1}), Verdict::hit);
    EXPECT_TRUE(filtered(corners, {1, 1, 0}, {1, 1, -1}).decision.at_start);
    EXPECT_EQ(filtered(corners, {1, 1, 0}, {1, 1, -1}).latest, 0);
    EXPECT_EQ(verdict({1, 1, 0}, {1, 1, 1}), Verdict::miss);
    EXPECT_EQ(verdict({1, 1, 0}, {2, 1, 0}), Verdict::miss);
    EXPECT_EQ(verdict({1, 0, 1}, {1, 0, -1}), Verdict::hit);
    EXPECT_EQ(filtered(corners, {1, 0, 1}, {1, 0, -1}).decision.feature, Feature::edge);
    EXPECT_EQ(verdict({0, 0, 1}, {0, 0, -1}), Verdict::hit);
    EXPECT_EQ(filtered(corners, {0, 0, 1}, {0, 0, -1}).decision.feature, Feature::vertex);
    EXPECT_EQ(verdict({4, 0, 0}, {4, 0, 0}), Verdict::miss);  // both ends on a corner
    // Oblique ones.
    const Corners oblique = {Point{0, 0, 0}, {4, 1, 2}, {1, 4, 3}};
    EXPECT_EQ(filtered(oblique, {1.25, 1.25, 1.25}, {1.25, 1.25, -1}).verdict, Verdict::doubtful)
        << "starts on the plane";
    EXPECT_EQ(filtered(oblique, {2, 0.5, 3}, {2, 0.5, -1}).verdict, Verdict::doubtful);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(verdict({nan, 1, 1}, {1, 1, -1}), Verdict::doubtful);
    EXPECT_EQ(verdict({1, 1, 1}, {1, 1, -1e100}), Verdict::doubtful);
    EXPECT_EQ(verdict({1, 1, 1}, {1, std::numeric_limits<double>::infinity(), -1}), Verdict::doubtful);
    EXPECT_EQ(verdict({1, 1, 0x1p-60}, {1, 1, -1}), Verdict::hit) << "along axes nothing is too close";
    EXPECT_EQ(filtered(oblique, {2.5, 2.5, 2.5 + 0x1p-51}, {2.5, 2.5, 1}).verdict, Verdict::doubtful)
        << "too close to the plane to be certain";
}

}  // namespace
}  // namespace pierce::test
