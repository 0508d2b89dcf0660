// Baldwin and Weber's Table 1 again: each kernel's time as a share of Moller and Trumbore's and of the Embree-style
// test's.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "table1.h"

namespace pierce::bench {
namespace {

struct Published {
    std::size_t pairs;
    double rate;
    int twelve_mt, twelve_embree, nine_mt, nine_embree;
};
// Baldwin and Weber 2016, Table 1.
constexpr Published k_published[] = {
    {500'000, 0.1, 46, 57, 67, 82},    {500'000, 0.5, 46, 74, 59, 96},    {500'000, 0.9, 49, 92, 72, 136},
    {1'000'000, 0.1, 46, 56, 68, 83},  {1'000'000, 0.5, 48, 79, 62, 102}, {1'000'000, 0.9, 42, 94, 62, 138},
    {5'000'000, 0.1, 38, 48, 56, 71},  {5'000'000, 0.5, 35, 58, 51, 84},  {5'000'000, 0.9, 42, 95, 62, 140},
    {10'000'000, 0.1, 38, 48, 56, 71}, {10'000'000, 0.5, 35, 57, 51, 84}, {10'000'000, 0.9, 42, 95, 62, 139}};

using Times = std::map<std::string, Timed>;

/// All found the same: as many hits as were counted exactly but for those at the very edge, and the same mean values.
bool agree(const Times& times, const Pairs& pairs) {
    bool good = true;
    for (const auto& [name, timed] : times) {
        if (name == "dummy") continue;
        const Sums& s = timed.sums;
        const Sums& mt = times.at("moller_trumbore").sums;
        const double n = static_cast<double>(pairs.size());
        const double missed = std::abs(static_cast<double>(s.hits) - static_cast<double>(pairs.hits));
        const bool same = missed <= 1e-5 * n && std::abs(s.fraction - mt.fraction) <= 1e-4 * n &&
                          std::abs(s.u - mt.u) <= 1e-4 * n && std::abs(s.v - mt.v) <= 1e-4 * n;
        if (!same) std::printf("%s answers differently: %zu hits of %zu\n", name.c_str(), s.hits, pairs.hits);
        good = good && same;
    }
    return good;
}

std::string heading(Misses misses) { return misses == Misses::beside ? "beside" : "anywhere"; }

struct Options {
    int repetitions = 7;
    bool quick = false;
    std::ofstream csv;
    std::map<std::string, std::vector<double>> ratios;  // Moller and Trumbore's time over the kernel's, by run and name
};

/// What the paper has for the kernel: of Moller and Trumbore's time, and of Embree's. Empty for those that it has not.
std::string published(const Published& p, const std::string& name) {
    if (name == "baldwin_weber_12" || name == "bw12_in_one_go")
        return std::to_string(p.twelve_mt) + " | " + std::to_string(p.twelve_embree);
    if (name == "baldwin_weber_9") return std::to_string(p.nine_mt) + " | " + std::to_string(p.nine_embree);
    return " | ";
}

double percent(const Times& times, const std::string& name, const std::string& of, double dummy = 0) {
    return 100 * (times.at(name).median() - dummy) / (times.at(of).median() - dummy);
}

bool cell(const Published& p, Misses misses, Options& options) {
    const std::size_t count = options.quick ? p.pairs / 10 : p.pairs;
    const Pairs pairs = make_pairs(count, p.rate, misses);
    const Times scalar = run(scalar_contest(pairs), count, options.repetitions);
    const Times wide = run(wide_contest(pairs), count, options.repetitions);
    std::printf("\n%zu pairs, misses %s, hit rate %.1f asked, %.4f counted; theirs: Baldwin and Weber 2016, Table 1\n",
                count, heading(misses).c_str(), p.rate, double(pairs.hits) / double(count));
    std::printf(
        "| %-16s | %7s | theirs, %% of M-T | theirs, %% of Embree | %8s | %9s | %12s | %7s | %11s | %14s | %16s |\n",
        "kernel", "ns", "% of M-T", "% of Emb.", "% of M-T - d", "wide ns", "% wide M-T", "% wide Embree",
        "% of scalar M-T");
    std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
    const double dummy = scalar.at("dummy").median();
    for (const auto& [name, timed] : scalar) {
        std::printf("| %-16s | %7.2f | %s | %8.0f | %9.0f | %12.0f |", name.c_str(), timed.median(),
                    published(p, name).c_str(), percent(scalar, name, "moller_trumbore"),
                    percent(scalar, name, "embree_style"), percent(scalar, name, "moller_trumbore", dummy));
        const bool has_wide = wide.contains(name);
        if (has_wide)
            std::printf(" %7.2f | %11.0f | %14.0f | %16.0f |\n", wide.at(name).median(),
                        percent(wide, name, "moller_trumbore"), percent(wide, name, "embree_style"),
                        100 * wide.at(name).median() / scalar.at("moller_trumbore").median());
        else
            std::printf(" %7s | %11s | %14s | %16s |\n", "-", "-", "-", "-");
        if (name == "dummy") continue;
        options.csv << heading(misses) << ' ' << count << ' ' << p.rate << ' ' << name << ' '
                    << percent(scalar, name, "moller_trumbore") << ' '
                    << (has_wide ? percent(wide, name, "moller_trumbore") : 0) << ' '
                    << (has_wide ? 100 * wide.at(name).median() / scalar.at("moller_trumbore").median() : 0) << ' '
                    << p.twelve_mt << ' ' << p.nine_mt << '\n';
        options.ratios["table1_" + heading(misses) + "_scalar_" + name].push_back(
            100 / percent(scalar, name, "moller_trumbore"));
        if (has_wide)
            options.ratios["table1_" + heading(misses) + "_wide_" + name].push_back(
                100 / percent(wide, name, "moller_trumbore"));
    }
    std::fflush(stdout);
    return agree(scalar, pairs) && (wide.empty() || agree(wide, pairs));
}

int table(Options& options) {
    bool good = true;
    for (const Misses misses : {Misses::beside, Misses::anywhere})
        for (const Published& p : k_published)
            if (!options.quick || p.pairs == 1'000'000) good = cell(p, misses, options) && good;
    std::printf("\n");
    for (auto& [name, values] : options.ratios) {
        std::sort(values.begin(), values.end());
        std::printf("ratio %s %.3f\n", name.c_str(), values[values.size() / 2]);
    }
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    pierce::bench::Options options;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--quick") == 0) options.quick = true;
        else options.csv.open(argv[i]);
    }
    return pierce::bench::table(options);
}
