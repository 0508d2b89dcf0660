// The order of impact times is exact, for equal and for nearly equal ones too.
#include <gtest/gtest.h>

#include <motion/judge.h>
#include <motion/made.h>

namespace pierce::test {

namespace {

/// Another triangle for the same point, often with the same time of impact.
detail::MovingTriangle another(QueryMaker& maker, const Query& q, Kind kind) {
    detail::MovingTriangle other = q.triangle;
    switch (maker.number(0, 4)) {
        case 0:
            for (auto& corners : other.at) std::swap(corners[0], corners[1]);
            break;
        case 1:  // the same edge
            for (auto& corners : other.at)
                for (double& x : corners[2]) x = maker.number(-2, 2);
            break;
        case 2: {  // in the same plane: corners moved along the edges, which also makes the numbers larger
            for (auto& corners : other.at)
                for (std::size_t k = 0; k < 3; ++k) {
                    corners[2][k] += 2 * (corners[2][k] - corners[0][k]);
                    corners[1][k] += 4 * (corners[1][k] - corners[0][k]);
                }
            break;
        }
        case 3: {  // nearly the same time
            double& x = other.at[maker.number(0, 1)][static_cast<std::size_t>(maker.number(0, 2))]
                                [static_cast<std::size_t>(maker.number(0, 2))];
            x = std::nextafter(x, 100.0);
            break;
        }
        default:
            other = maker.make(kind).triangle;
    }
    return other;
}

void check_order(int rounds, unsigned seed) {
    QueryMaker maker(seed);
    int orders[3] = {};
    for (int i = 0; i < rounds; ++i) {
        const Kind kind = k_kinds[i % 6];
        const ContactRule contact = i % 3 == 0   ? ContactRule::front
                                    : i % 3 == 1 ? ContactRule::both
                                                 : ContactRule::closed;
        const Query q = maker.make(kind);
        const detail::MovingTriangle other = another(maker, q, kind);
        const detail::Impact one = detail::first_contact(q.point, q.triangle, contact);
        const detail::Impact two = detail::first_contact(q.point, other, contact);
        if (one.hit) {
            const Judgement truth = Judge(q.point, q.triangle).decide(contact);
            for (const double time : {one.earliest, one.latest, 0.5, 0.25, 0.0, 1.0, -1.0, 2.0,
                                      one.earliest / 2 + one.latest / 2, std::nextafter(one.earliest, 2.0)})
                ASSERT_EQ(detail::compare_time(q.point, contact, q.triangle, one, time),
                          truth.time.compare(mpq_class(time)));
        }
        if (!one.hit || !two.hit) continue;
        const int truth =
            Judge(q.point, q.triangle).decide(contact).time.compare(Judge(q.point, other).decide(contact).time);
        ASSERT_EQ(detail::compare_impacts(q.point, contact, q.triangle, one, other, two), truth);
        ASSERT_EQ(detail::compare_impacts(q.point, contact, other, two, q.triangle, one), -truth);
        ++orders[truth + 1];
    }
    for (const int count : orders) EXPECT_GT(count, rounds / 100);
}

}  // namespace

TEST(MovingOrder, IsTheJudges) { check_order(6000, 1); }

TEST(MovingOrderSoak, IsTheJudges) { check_order(300000, 2); }

}  // namespace pierce::test
