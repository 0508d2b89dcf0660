// Moving points and triangles against the rational judge: every decision, feature and time.
#include <gtest/gtest.h>

#include <motion/decide.h>
#include <motion/filter.h>
#include <motion/judge.h>
#include <motion/made.h>

namespace pierce::test {

namespace {

constexpr ContactRule k_contacts[] = {ContactRule::front, ContactRule::back, ContactRule::both, ContactRule::closed};

std::string text(const Query& q) {
    std::string out;
    const auto add = [&out](const detail::Point& p) {
        char line[128];
        std::snprintf(line, sizeof line, "{%.17g, %.17g, %.17g} ", p[0], p[1], p[2]);
        out += line;
    };
    for (int i = 0; i < 2; ++i) {
        add(q.point.at[i]);
        out += "| ";
        for (const detail::Point& p : q.triangle.at[i]) add(p);
        out += "\n";
    }
    return out;
}

struct Counts {
    int hits = 0, in_plane = 0, several = 0, filtered = 0, all = 0;
};

void check(const Query& q, ContactRule contact, Counts& counts) {
    const Judgement truth = Judge(q.point, q.triangle).decide(contact);
    const detail::Impact impact = detail::first_contact(q.point, q.triangle, contact);
    ++counts.all;
    counts.hits += truth.hit ? 1 : 0;
    counts.in_plane += truth.always_in_plane ? 1 : 0;
    counts.several += truth.roots > 1 ? 1 : 0;
    detail::Impact unused;
    counts.filtered += detail::filter(q.point, q.triangle, contact, unused) != detail::Certainty::doubtful ? 1 : 0;
    // The exact room is asked as well where the filter could tell.
    const detail::Impact sharp = detail::decide_contact(q.point, q.triangle, contact);
    ASSERT_EQ(sharp.hit, truth.hit) << "contact " << static_cast<int>(contact) << "\n" << text(q);
    ASSERT_EQ(impact.hit, truth.hit) << "contact " << static_cast<int>(contact) << "\n" << text(q);
    if (!truth.hit) return;
    ASSERT_EQ(impact.feature, truth.feature) << text(q);
    ASSERT_EQ(impact.feature_index, truth.index) << text(q);
    if (!truth.always_in_plane) {
        ASSERT_EQ(impact.side, truth.side) << text(q);
    }
    ASSERT_EQ(impact.at_start, truth.time.compare(mpq_class(0)) == 0) << text(q);
    ASSERT_LE(0, impact.earliest);
    ASSERT_LE(impact.latest, 1);
    ASSERT_GE(truth.time.compare(mpq_class(impact.earliest)), 0) << text(q);
    ASSERT_LE(truth.time.compare(mpq_class(impact.latest)), 0) << text(q);
    ASSERT_EQ(sharp.side, impact.side) << text(q);
    ASSERT_EQ(sharp.feature, truth.feature) << text(q);
    ASSERT_GE(truth.time.compare(mpq_class(sharp.earliest)), 0) << text(q);
    ASSERT_LE(truth.time.compare(mpq_class(sharp.latest)), 0) << text(q);
    ASSERT_TRUE(sharp.latest - sharp.earliest <= 0x1p-62 || std::nextafter(sharp.earliest, 2.0) >= sharp.latest)
        << text(q);
    if (impact.earliest == impact.latest) {
        ASSERT_EQ(truth.time.compare(mpq_class(impact.earliest)), 0);
    }
}

void check_many(int rounds, unsigned seed) {
    QueryMaker maker(seed);
    for (const Kind kind : k_kinds) {
        Counts counts;
        for (int i = 0; i < rounds; ++i) {
            check(maker.make(kind), k_contacts[i % 4], counts);
            if (testing::Test::HasFatalFailure()) return;
        }
        EXPECT_GT(counts.hits, counts.all / 20);
        EXPECT_GT(counts.filtered, counts.all / 8);
        EXPECT_LT(counts.filtered, kind == Kind::anywhere ? counts.all + 1 : counts.all);
        if (kind == Kind::in_plane) {
            EXPECT_EQ(counts.in_plane, counts.all);
        } else if (kind != Kind::folding) {
            EXPECT_GT(counts.several, counts.all / 10);
        }
    }
}

}  // namespace

TEST(MovingDecisions, AreTheJudges) { check_many(2500, 1); }

TEST(MovingDecisionsSoak, AreTheJudges) { check_many(130000, 2); }

}  // namespace pierce::test
