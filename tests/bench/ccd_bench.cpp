// What a moving point against a moving triangle costs, by scene, on published queries with ground truth; all answers
// are checked first. Prints `ratio ccd.typical VALUE`: the 0.74 us a query that are published for Tight-Inclusion on
// simulation data (Wang et al. 2021, table 1, another machine, 18 million queries of which these are not a sample)
// over the mean time of the simulation scenes here.
//   ccd_bench FOLDER      with a folder for each scene: vertex_face.csv, truth.json
#include <algorithm>
#include <ctime>
#include <iostream>
#include <numeric>

#include <bench/table.h>
#include <motion/filter.h>
#include <motion/moving.h>
#include <motion/queries.h>

namespace pierce::bench {
namespace {

using test::SharedQuery;

constexpr double k_published = 0.74e-6;

double seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);  // other programs do not count
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class F>
double least_time(int rounds, F&& work) {
    double least = 1e300;
    for (int i = 0; i < rounds; ++i) {
        const double start = seconds();
        work();
        least = std::min(least, seconds() - start);
    }
    return least;
}

volatile int g_sink = 0;

struct Cost {
    std::vector<double> each;  ///< asked many times over
    double in_a_row = 0;       ///< of all, one after the other
    Share exact;
};

Cost measure(const std::vector<SharedQuery>& queries) {
    constexpr int repetitions = 64;
    Cost cost;
    for (const SharedQuery& q : queries) {
        cost.each.push_back(least_time(5,
                                       [&q] {
                                           for (int i = 0; i < repetitions; ++i)
                                               g_sink = g_sink + (detail::meets(q.point, q.triangle).hit ? 1 : 0);
                                       }) /
                            repetitions);
        detail::Impact impact;
        cost.exact.add(detail::filter(q.point, q.triangle, detail::ContactRule::closed, impact) ==
                       detail::Certainty::doubtful);
    }
    std::sort(cost.each.begin(), cost.each.end());
    cost.in_a_row = least_time(21, [&queries] {
        int hits = 0;
        for (const SharedQuery& q : queries) hits += detail::meets(q.point, q.triangle).hit ? 1 : 0;
        g_sink = hits;
    });
    return cost;
}

std::string microseconds(double time) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(3) << time * 1e6;
    return out.str();
}

std::vector<std::string> row_of(const std::string& name, const Cost& cost, std::size_t hits) {
    const std::size_t count = cost.each.size();
    return {name,
            std::to_string(count),
            std::to_string(hits),
            microseconds(cost.each.front()),
            microseconds(cost.each[count / 2]),
            microseconds(cost.each[std::min(count - 1, count * 99 / 100)]),
            microseconds(cost.in_a_row / static_cast<double>(count)),
            cost.exact.percent()};
}

int run(const std::string& folder) {
    Table table({"scene", "queries", "hits", "min us", "median us", "p99 us", "mean us in a row", "exact"});
    double simulated = 0;
    std::size_t simulations = 0;
    const auto scenes = test::scenes_of(folder);
    if (scenes.empty()) {
        std::cerr << folder << " has no scenes\n";
        return 1;
    }
    for (const std::string& scene : scenes) {
        const auto queries = test::read_queries(folder + "/" + scene);
        std::size_t hits = 0;
        for (const SharedQuery& q : queries) {
            const bool hit = detail::meets(q.point, q.triangle).hit;
            if (hit != q.truth) {
                std::cerr << scene << ": a decision is wrong\n";
                return 1;
            }
            hits += hit ? 1 : 0;
        }
        const Cost cost = measure(queries);
        table.add(row_of(scene, cost, hits));
        if (scene.starts_with("erleben")) continue;  // made by hand
        simulated += cost.in_a_row;
        simulations += queries.size();
    }
    table.print(std::cout);
    const double mean = simulated / static_cast<double>(simulations);
    std::cout << "Simulation scenes: " << microseconds(mean)
              << " us a query; published for Tight-Inclusion: " << microseconds(k_published) << "\n\nratio ccd.typical "
              << std::setprecision(3) << k_published / mean << '\n';
    return 0;
}

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    return argc == 2 ? pierce::bench::run(argv[1]) : (std::cerr << "ccd_bench FOLDER\n", 2);
}
