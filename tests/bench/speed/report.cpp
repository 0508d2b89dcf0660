#include "report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>

#include "../table.h"
#include "builds.h"
#include "column.h"
#include "memory.h"
#include "segment_sets.h"

namespace pierce::bench {
namespace {

constexpr std::array k_columns = {
    column::pierce,        column::pierce_two_threads,  column::pierce_batch,  column::pierce_any,
    column::pierce_any_batch, column::fronts,           column::fronts_batch,  column::grid,
    column::grid_batch,    column::pierce_double,       column::pierce_double_batch, column::embree,
    column::embree_any,    column::embree_stream,       column::embree_robust, column::embree_low,
    column::bullet,        column::cgal_any,            column::cgal_first};

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

}  // namespace

std::string number(double value) {
    std::array<char, 32> text{};
    int decimals = 0;
    for (double limit = 99.95; decimals < 5 && value < limit; limit /= 10) ++decimals;
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string cell(const std::optional<double>& value) { return value ? number(*value) : "-"; }

void print_figures(const Results& results, const std::vector<Measured>& meshes) {
    for (const SegmentSet set : k_segment_sets)
        print_set(results, meshes, name_of(set), "ns a query; " + std::string(description_of(set)));
    print_set(results, meshes, set_name::build,
              "Build: milliseconds of one thread to the first answer, in warm memory; Embree builds again");
    print_set(results, meshes, set_name::build_fresh,
              "First build: the same in fresh memory; Embree's scene is made anew, its buffers filled");
    print_set(results, meshes, set_name::memory,
              "Memory after the build: bytes a face, buffers of vertices and indices included");
    print_set(results, meshes, set_name::threads, "Threads: ns a query in batches of short1, on the wall");
    print_set(results, meshes, set_name::thread_build, "Threads: milliseconds for a build, on the wall");
}

}  // namespace pierce::bench
