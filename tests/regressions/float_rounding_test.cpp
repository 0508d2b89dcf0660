// GCC 12.2 at -O2 compiles double(float(x)) for two neighbouring coordinates into nothing: its straight-line vectorizer
// pairs the two conversions there and back, and folds the pair away, rounding included. The third coordinate, left
// scalar, is rounded.
//
// What it broke: the "float" pairs that the decisions test makes had coordinates that no float has. The same pattern
// stands in place.h, where it would prove one point clear and return another, off by half a unit in the last place
// (6e-8 of the coordinate). It does not matter whether the values come from Eigen or from an array. Clang and GCC's
// loop vectorizer are not affected. CMakeLists.txt turns the other one off.
#include <gtest/gtest.h>
#include <query/place.h>

namespace pierce::test {
namespace {

[[gnu::noinline]] detail::Point there_and_back(const detail::Path& path, double fraction) {
    detail::Point point{};
    for (std::size_t k = 0; k < 3; ++k) point[k] = path.from[k] + fraction * (path.to[k] - path.from[k]);
    return detail::rounded_to<float>(point);
}

[[gnu::noinline]] detail::Point there_and_back(const Vec3<double>& p, double scale, const Vec3<double>& shift) {
    return detail::to_point(Vec3<float>((scale * p + shift).cast<float>()));
}

void expect_floats(const detail::Point& p) {
    for (double x : p) {
        const volatile float rounded = static_cast<float>(x);  // volatile: really stored as a float
        EXPECT_EQ(x, static_cast<double>(rounded));
    }
}

TEST(FloatRounding, is_not_optimised_away) {
    expect_floats(there_and_back({{0, 0, 0}, {0.1, 0.2, 0.3}}, 0.7));
    expect_floats(there_and_back({0.1, 0.2, 0.3}, 0.7, {1, 2, 3}));
}

}  // namespace
}  // namespace pierce::test
