// The experiment of Baldwin and Weber 2016, Table 1: pairs of a segment and its own triangle, in given numbers and with
// given shares of hits, tested by each kernel in turn.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <pierce/kernels.h>

namespace pierce::bench {

/// How the segments that miss do so: they pierce the plane beside the triangle, from its front; or they lie anywhere in
/// the cube of the triangles, and miss however they may (four in five do not pierce the plane in the right sense).
enum class Misses { beside, anywhere };

struct Pairs {
    std::vector<std::array<Vec3<float>, 3>> triangles;
    std::vector<kernels::Triple<float>> from;
    std::vector<kernels::Triple<float>> to;
    std::size_t hits = 0;  ///< counted with the exact kernel

    [[nodiscard]] std::size_t size() const { return from.size(); }
};

/// In random order; a pair that the exact kernel sees otherwise than planned is made anew.
Pairs make_pairs(std::size_t count, double hit_rate, Misses misses);

/// What all kernels must agree on, up to rounding; also what keeps the compiler from leaving the work out.
struct Sums {
    std::size_t hits = 0;
    double fraction = 0;
    double u = 0;
    double v = 0;
};

struct Timed {
    std::vector<double> ns;  ///< a pair, one for each repetition
    Sums sums;

    [[nodiscard]] double median() const {
        std::vector<double> sorted = ns;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

/// By name, what runs a kernel over all pairs once.
using Contest = std::vector<std::pair<std::string, std::function<Sums()>>>;

/// Time that this thread has had a processor: what others take from it in between does not count.
inline double processor_ns() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

/// One pass of each that counts for nothing but the answers, then `repetitions` rounds in which each has its turn.
inline std::map<std::string, Timed> run(const Contest& contest, std::size_t pairs, int repetitions) {
    std::map<std::string, Timed> timed;
    for (int round = -1; round < repetitions; ++round)
        for (const auto& [name, pass] : contest) {
            const double start = processor_ns();
            const Sums sums = pass();
            const double time = processor_ns() - start;
            timed[name].sums = sums;
            if (round >= 0) timed[name].ns.push_back(time / static_cast<double>(pairs));
        }
    return timed;
}

Contest scalar_contest(const Pairs& pairs);
/// Eight pairs a step; empty where the machine has no AVX2.
Contest wide_contest(const Pairs& pairs);

}  // namespace pierce::bench
