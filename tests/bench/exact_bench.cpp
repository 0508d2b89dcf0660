// What the exact room costs: its integers against floating-point expansions, on coordinates of several kinds, in one run.
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

template <class Scalar>
void measure_all(const char* what, double offset, bool wide) {
    Random random(1);
    std::vector<Pair> pairs;
    for (int i = 0; i < 4096; ++i) {
        Pair pair = make_pair_of<Scalar>(static_cast<Family>(i % 3), 1, offset, random);
        if (wide)  // exponents far apart: more limbs
            for (double& x : pair.corners[0]) x *= std::exp(random.between(-60, 0));
        pairs.push_back(pair);
    }
    const std::size_t n = pairs.size();
    const double expansions = time_of(n, [&](std::size_t i) { return side_by_expansions(pairs[i].corners, pairs[i].path.from); });
    const double integers = time_of(n, [&](std::size_t i) { return detail::side_of(pairs[i].corners, pairs[i].path.from); });
    const double decision = time_of(n, [&](std::size_t i) { return detail::decide(pairs[i].path, pairs[i].corners, Sides::both).hit; });
    const double order = time_of(n, [&](std::size_t i) {
        return detail::compare_fractions(pairs[i].path, pairs[i].corners, pairs[(i + 1) % n].corners);
    });
    const double values = time_of(n, [&](std::size_t i) { return detail::measure(pairs[i].path, pairs[i].corners).fraction * 8; });
    const double planes = time_of(n, [&](std::size_t i) { return detail::exact_planes(pairs[i].corners).normal[0] * 8; });
    std::printf("| %-28s | %6.0f | %6.0f | %6.0f | %6.0f | %6.0f | %6.0f |\n", what, expansions, integers, decision, order, values,
                planes);
    std::printf("ratio exact.%s %.2f\n", what, expansions / integers);
}

}  // namespace
}  // namespace pierce::test

int main() {
    std::puts("ns a call: side of a point by expansions and by integers; a whole decision; order of two hits; values; planes");
    pierce::test::measure_all<float>("float", 0, false);
    pierce::test::measure_all<float>("float_far", 1e3, false);
    pierce::test::measure_all<double>("double", 0, false);
    pierce::test::measure_all<double>("double_far", 1e6, false);
    pierce::test::measure_all<double>("double_wide", 0, true);
}
