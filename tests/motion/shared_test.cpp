// The vertex-face queries with ground truth that others published (PIERCE_SHARED/ccd), as they are, scaled and moved.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <motion/filter.h>
#include <motion/moving.h>
#include <motion/queries.h>

namespace pierce::test {

namespace {

std::vector<SharedQuery> all_queries() {
    std::vector<SharedQuery> all;
    const char* const shared = std::getenv("PIERCE_SHARED");
    if (shared == nullptr) return all;
    const std::filesystem::path folder = std::filesystem::path(shared) / "ccd";
    for (const std::string& scene : scenes_of(folder)) {
        const std::vector<SharedQuery> queries = read_queries(folder / scene);
        all.insert(all.end(), queries.begin(), queries.end());
    }
    return all;
}

template <class F>
void each_coordinate(SharedQuery& q, F&& f) {
    for (int i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 3; ++k) f(q.point.at[i][k], k);
        for (detail::Point& p : q.triangle.at[i])
            for (std::size_t k = 0; k < 3; ++k) f(p[k], k);
    }
}

}  // namespace

TEST(MovingShared, TheTruthAndItsCopies) {
    const std::vector<SharedQuery> queries = all_queries();
    if (queries.empty()) GTEST_SKIP() << "PIERCE_SHARED names no folder with ccd in it: no published query was asked";
    EXPECT_EQ(queries.size(), 7079U);
    for (const int scale : {0, -300, -1000, 300, 900})
        for (const SharedQuery& query : queries) {
            SharedQuery q = query;
            bool exact = true;
            each_coordinate(q, [&](double& x, std::size_t) {
                const double scaled = std::ldexp(x, scale);
                exact = exact && std::ldexp(scaled, -scale) == x;
                x = scaled;
            });
            if (!exact) continue;
            ASSERT_EQ(detail::meets(q.point, q.triangle).hit, q.truth) << "times 2^" << scale;
        }
    for (int k = -40; k <= 40; ++k)
        for (const SharedQuery& query : queries) {
            SharedQuery q = query;
            each_coordinate(q, [&](double& x, std::size_t) { x = std::ldexp(x, k); });
            ASSERT_EQ(detail::meets(q.point, q.triangle).hit, q.truth) << "times 2^" << k;
        }
    int moved = 0;
    for (int k = -20; k <= 40; k += 4)
        for (std::size_t axis = 0; axis < 4; ++axis)
            for (const SharedQuery& query : queries) {
                SharedQuery q = query;
                bool exact = true;
                const double way = std::ldexp(k % 8 == 0 ? 1 : -1, k);
                each_coordinate(q, [&](double& x, std::size_t at) {
                    if (axis < 3 && at != axis) return;
                    const double there = x + way;
                    exact = exact && there - way == x && there - x == way;
                    x = there;
                });
                if (!exact) continue;
                ++moved;
                ASSERT_EQ(detail::meets(q.point, q.triangle).hit, q.truth) << "moved by " << way;
            }
    EXPECT_GT(moved, 10000);
}

}  // namespace pierce::test
