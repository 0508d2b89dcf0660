#include "report.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "../table.h"
#include "builds.h"
#include "column.h"
#include "segment_sets.h"

namespace pierce::bench {
namespace {

/// Three digits, and more only before the point.
std::string number(double value) {
    std::array<char, 32> text{};
    int decimals = 0;
    for (double limit = 99.95; decimals < 5 && value < limit; limit /= 10) ++decimals;
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string cell(const std::optional<double>& value) { return value ? number(*value) : "-"; }

constexpr std::array k_columns = {column::pierce,        column::pierce_two_threads,  column::pierce_batch,
                                  column::pierce_both,   column::pierce_any,          column::pierce_any_batch,
                                  column::pierce_double, column::pierce_double_batch, column::embree,
                                  column::embree_any,    column::embree_stream,       column::embree_robust,
                                  column::embree_low,    column::embree_low_again,    column::bullet,
                                  column::cgal_any,      column::cgal_first};

void print_set(const Results& results, const std::vector<Measured>& meshes, std::string_view set,
               std::string_view title) {
    const auto measured = [&](std::string_view column) {
        return std::any_of(meshes.begin(), meshes.end(),
                           [&](const Measured& m) { return results.value(m.mesh.name, set, column).has_value(); });
    };
    std::vector<std::string_view> columns;
    std::copy_if(k_columns.begin(), k_columns.end(), std::back_inserter(columns), measured);
    if (columns.empty()) return;
    std::vector<std::string> head = {std::string(set), "faces"};
    head.insert(head.end(), columns.begin(), columns.end());
    Table table(head);
    for (const Measured& m : meshes) {
        std::vector<std::string> row = {m.mesh.name, std::to_string(m.faces)};
        for (const std::string_view column : columns) row.push_back(cell(results.value(m.mesh.name, set, column)));
        if (std::any_of(row.begin() + 2, row.end(), [](const std::string& text) { return text != "-"; }))
            table.add(row);
    }
    std::cout << "### " << title << "\n\n";
    table.print(std::cout);
}

struct RatioLine {
    std::string name;
    std::vector<std::string_view> sets;
    std::string_view peer;
    std::string_view ours;
};

std::vector<RatioLine> ratio_lines() {
    using namespace column;
    const auto of = [](auto... sets) { return std::vector<std::string_view>{name_of(sets)...}; };
    const auto shorts = of(SegmentSet::short_02, SegmentSet::short_1);
    const auto longs = of(SegmentSet::aimed, SegmentSet::random);
    const auto mediums = of(SegmentSet::medium);
    const auto clouds = of(SegmentSet::cloud);
    return {{"embree.short.single", shorts, embree, pierce},
            {"embree.short.batch", shorts, embree, pierce_batch},
            {"embree.cloud.single", clouds, embree, pierce},
            {"embree.cloud.batch", clouds, embree, pierce_batch},
            {"embree.medium.single", mediums, embree, pierce},
            {"embree.medium.batch", mediums, embree, pierce_batch},
            {"embree.long.single", longs, embree, pierce},
            {"embree.long.batch", longs, embree, pierce_batch},
            {"embree.any.single", shorts, embree_any, pierce_any},
            {"embree.rest.single", of(SegmentSet::rest), embree, pierce},
            {"embree.axis.single", of(SegmentSet::axis), embree, pierce},
            {"bullet.short.single", shorts, bullet, pierce},
            {"cgal.short.single", shorts, cgal_any, pierce},
            {"embree.build", {set_name::build}, embree_low, pierce},
            {"embree.memory", {set_name::memory}, embree, pierce},
            {"threads.batch", {set_name::threads}, pierce_batch, pierce_two_threads},
            {"threads.build", {set_name::thread_build}, pierce, pierce_two_threads}};
}

/// embree.short.single -> stadium.short.single, bullet.short.single -> stadium.bullet.short.single
std::string stadium_name(const std::string& name) {
    constexpr std::string_view main_peer = "embree.";
    return "stadium." + (name.starts_with(main_peer) ? name.substr(main_peer.size()) : name);
}

}  // namespace

void print_figures(const Results& results, const std::vector<Measured>& meshes) {
    for (const SegmentSet set : k_segment_sets)
        print_set(results, meshes, name_of(set), "ns a query; " + std::string(description_of(set)));
    print_set(results, meshes, set_name::build,
              "Build: milliseconds of one thread, from positions and indices to the first answer");
    print_set(results, meshes, set_name::memory,
              "Memory after the build: bytes a face, buffers of vertices and indices included");
    print_set(results, meshes, set_name::threads, "Threads: ns a query in batches of short1, on the wall");
    print_set(results, meshes, set_name::thread_build, "Threads: milliseconds for a build, on the wall");
}

void print_ratios(const Results& results, const std::vector<Measured>& meshes) {
    std::vector<std::string> head = {"time of the peer over ours"};
    for (const Measured& m : meshes) head.push_back(m.mesh.name);
    head.emplace_back("median, real");
    Table table(head);
    std::string lines;
    for (const RatioLine& line : ratio_lines()) {
        std::vector<std::string> row = {line.name};
        std::vector<double> real;
        std::string stadium;
        for (const Measured& m : meshes) {
            const auto ratio = results.ratio(m.mesh.name, line.sets, line.peer, line.ours);
            row.push_back(cell(ratio));
            if (ratio && m.mesh.kind == MeshKind::real) real.push_back(*ratio);
            if (ratio && m.mesh.kind == MeshKind::stadium)
                stadium = "ratio " + stadium_name(line.name) + ' ' + number(*ratio) + '\n';
        }
        row.push_back(real.empty() ? "-" : number(median(real)));
        if (!real.empty()) lines += "ratio " + line.name + ' ' + number(median(real)) + '\n';
        lines += stadium;
        if (std::any_of(row.begin() + 1, row.end(), [](const std::string& text) { return text != "-"; }))
            table.add(row);
    }
    std::cout << "### Ratios\n\nThe peer's time (or bytes) over ours, the median of the repetitions' ratios: more is "
                 "better. The sets of "
                 "short and of long segments count half each, in time.\n\n";
    table.print(std::cout);
    std::cout << lines << std::flush;
}

}  // namespace pierce::bench
