// The filter's certain answers where its bounds are needed most: nearly touching, at every size, at the ends of the
// range.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <motion/decide.h>
#include <motion/filter.h>
#include <motion/made.h>

namespace pierce::test {

namespace {

using detail::ContactRule;

constexpr ContactRule k_contacts[] = {ContactRule::front, ContactRule::back, ContactRule::both, ContactRule::closed};

/// Against exact arithmetic, which the judge has judged (decisions_test.cpp).
void expect_sound(const Query& q, int& certain) {
    for (const ContactRule contact : k_contacts) {
        detail::Impact impact;
        const detail::Certainty certainty = detail::filter(q.point, q.triangle, contact, impact);
        if (certainty == detail::Certainty::doubtful) continue;
        ++certain;
        const detail::Impact exact = detail::decide_contact(q.point, q.triangle, contact);
        ASSERT_EQ(certainty == detail::Certainty::hit, exact.hit);
        if (!exact.hit) continue;
        ASSERT_EQ(impact.side, exact.side);
        ASSERT_EQ(exact.feature, Feature::face);
        ASSERT_LE(impact.earliest, exact.latest);
        ASSERT_GE(impact.latest, exact.earliest);
    }
}

}  // namespace

TEST(MovingFilter, IsSoundWhereItIsCertain) {
    QueryMaker maker(1);
    int certain = 0;
    for (int i = 0; i < 40000; ++i) {
        Query q = maker.make(k_kinds[i % 9]);
        const double size = std::ldexp(1.0, i % 3 == 0 ? maker.number(-364, -340) : maker.number(-40, 40));
        const double noise = std::ldexp(1.0, -maker.number(30, 60));
        QueryMaker::each(q, [&](detail::Point& p) {
            for (double& x : p) x = (x + (i % 2 == 0 ? maker.real(-noise, noise) : 0)) * size;
        });
        expect_sound(q, certain);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(certain, 40000);
}

// Two close roots, or none: the point is less than a hair's breadth in front of the turning triangle or behind it.
TEST(MovingFilter, NearlyDoubleRoots) {
    QueryMaker maker(2);
    int certain = 0;
    for (int i = 0; i < 20000; ++i) {
        Query q = maker.make(Kind::turning);
        // z of the plane over the point is quadratic at least: its extreme is near to 0.
        const double hair = std::ldexp(maker.real(-1, 1), -maker.number(1, 60));
        q.point.at[0] = {-0.25, 0, hair};
        q.point.at[1] = {0.25, maker.number(0, 1) * 0.25, hair};
        const double tilt = maker.number(1, 2);
        for (int k = 0; k < 2; ++k) {
            q.triangle.at[k] = {detail::Point{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}};
            q.triangle.at[k][0][2] = (k == 0 ? -1 : 1) * tilt;
            q.triangle.at[k][1][2] = (k == 0 ? 1 : -1) * tilt;
        }
        expect_sound(q, certain);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(certain, 20000);
}

// What is lost of an area below the least double is multiplied by a corner far away.
TEST(MovingFilter, HugeAndTiny) {
    QueryMaker maker(4);
    int certain = 0;
    for (int i = 0; i < 2000; ++i) {
        Query q;
        const double huge = std::ldexp(1.0, maker.number(190, 340));
        const double tiny = std::ldexp(1.0, -maker.number(533, 540));
        for (int k = 0; k < 2; ++k) {
            q.point.at[k] = {0, 0, 0};
            for (std::size_t corner = 0; corner < 3; ++corner)
                for (double& x : q.triangle.at[k][corner]) x = maker.real(-1, 1) * (corner == 0 ? huge : tiny);
        }
        expect_sound(q, certain);
        if (HasFatalFailure()) return;
    }
}

TEST(MovingFilter, TakesAnyNumber) {
    QueryMaker maker(3);
    const double odd[] = {0.0,
                          -0.0,
                          1.0,
                          -1.0,
                          0x1p1023,
                          -0x1p1023,
                          0x1.fffffffffffffp1023,
                          0x1p-1074,
                          -0x1p-1074,
                          0x1p-540,
                          0x1p200,
                          0x1p201,
                          -0x1p340,
                          std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN()};
    int finite = 0;
    for (int i = 0; i < 20000; ++i) {
        Query q;
        const int range = i % 2 == 0 ? 8 : i % 4 == 1 ? 12 : 15;
        bool all_finite = true;
        QueryMaker::each(q, [&](detail::Point& p) {
            for (double& x : p) {
                x = maker.number(0, 9) < 6 ? maker.number(-2, 2) : odd[maker.number(0, range)];
                all_finite = all_finite && std::isfinite(x);
            }
        });
        const ContactRule contact = k_contacts[maker.number(0, 3)];
        detail::Impact unused;
        if (all_finite && detail::filter(q.point, q.triangle, contact, unused) == detail::Certainty::doubtful &&
            finite++ > 60)
            continue;  // exact arithmetic over the whole range is slow
        const detail::Impact impact = detail::first_contact(q.point, q.triangle, contact);
        if (!all_finite) {
            ASSERT_FALSE(impact.hit);
        }
    }
}

}  // namespace pierce::test
