// What the exact room costs: its integers and its accumulator against floating-point expansions, on coordinates of
// several kinds, in one run.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <exact/planes.h>
#include <support/expansion.h>
#include <support/pairs.h>

namespace pierce::test {
namespace {

/// Nanoseconds for one call of `work(i)`, i in 0 .. count - 1: the median of nine passes.
template <class Work>
double time_of(std::size_t count, Work&& work) {
    std::vector<double> passes;
    long long sink = 0;
    for (int pass = 0; pass < 9; ++pass) {
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t i = 0; i < count; ++i) sink += static_cast<long long>(work(i));
        passes.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
                         static_cast<double>(count));
    }
    if (sink == 42) std::puts("");  // keeps the work
    std::nth_element(passes.begin(), passes.begin() + 4, passes.end());
    return passes[4];
}

enum class Exponents { alike, spread, one_subnormal, all };

template <class Scalar>
void measure_all(const char* what, double offset, Exponents exponents) {
    Random random(1);
    std::vector<Pair> pairs;
    for (int i = 0; i < 4096; ++i) {
        Pair pair = make_pair_of<Scalar>(static_cast<Family>(i % 3), 1, offset, random);
        auto& [path, corners] = pair;
        if (exponents == Exponents::spread)  // more limbs
            for (double& x : corners[0]) x *= std::exp(random.between(-60, 0));
        if (exponents == Exponents::one_subnormal) {  // a particle at rest on a floor at 0
            for (detail::Point& corner : corners) corner[2] = 0;
            path.from[2] = 5e-324;
            path.to[2] = -0.01;
        }
        if (exponents == Exponents::all)
            for (detail::Point* p : {&path.from, &path.to, &corners[0], &corners[1], &corners[2]})
                for (double& x : *p) x *= std::exp2(random.between(-1070, 1000));
        pairs.push_back(pair);
    }
    const std::size_t n = pairs.size();
    const double expansions =
        time_of(n, [&](std::size_t i) { return side_by_expansions(pairs[i].corners, pairs[i].path.from); });
    const double integers =
        time_of(n, [&](std::size_t i) { return detail::side_of(pairs[i].corners, pairs[i].path.from); });
    const double decision =
        time_of(n, [&](std::size_t i) { return detail::decide(pairs[i].path, pairs[i].corners, Sides::both).hit; });
    const double order = time_of(n, [&](std::size_t i) {
        return detail::compare_fractions(pairs[i].path, pairs[i].corners, pairs[(i + 1) % n].corners);
    });
    const double values =
        time_of(n, [&](std::size_t i) { return detail::measure(pairs[i].path, pairs[i].corners).fraction * 8; });
    const double planes =
        time_of(n, [&](std::size_t i) { return detail::exact_planes(pairs[i].corners).normal[0] * 8; });
    std::printf("| %-28s | %6.0f | %6.0f | %6.0f | %6.0f | %6.0f | %6.0f |\n", what, expansions, integers, decision,
                order, values, planes);
    std::printf("ratio exact.%s %.2f\n", what, expansions / integers);
}

}  // namespace
}  // namespace pierce::test

int main() {
    std::puts(
        "ns a call: side of a point by expansions and by the exact room; a whole decision; order of two hits; "
        "values; planes");
    pierce::test::measure_all<float>("float", 0, pierce::test::Exponents::alike);
    pierce::test::measure_all<float>("float_far", 1e3, pierce::test::Exponents::alike);
    pierce::test::measure_all<double>("double", 0, pierce::test::Exponents::alike);
    pierce::test::measure_all<double>("double_far", 1e6, pierce::test::Exponents::alike);
    pierce::test::measure_all<double>("double_wide", 0, pierce::test::Exponents::spread);
    pierce::test::measure_all<double>("double_one_subnormal", 0, pierce::test::Exponents::one_subnormal);
    pierce::test::measure_all<double>("double_all", 0, pierce::test::Exponents::all);
}
