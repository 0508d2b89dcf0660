#include <algorithm>
#include <array>
#include <iostream>
#include <map>

#include "../table.h"
#include "builds.h"
#include "column.h"
#include "memory.h"
#include "report.h"
#include "segment_sets.h"

namespace pierce::bench {
namespace {

using Sets = std::vector<std::string_view>;

struct RatioLine {
    std::string name;
    Sets sets;
    std::string_view peer;
    std::string_view ours;
    bool alone = false;  ///< also printed for each mesh of `k_alone`
};

/// Scenes unlike the scans of which most of the real meshes are.
constexpr std::array<std::string_view, 3> k_alone = {"kitchen", "dungeon", "stadium"};
constexpr std::string_view k_main_peer = "embree.";

template <class... Set>
Sets of(Set... sets) {
    return {name_of(sets)...};
}

std::vector<RatioLine> ratio_lines() {
    using namespace column;
    const Sets shorts = of(SegmentSet::short_02, SegmentSet::short_1);
    const Sets longs = of(SegmentSet::aimed, SegmentSet::random);
    std::vector<RatioLine> lines;
    const auto add = [&](const std::string& name, const Sets& sets, std::string_view peer, std::string_view single,
                         std::string_view batch, bool alone = false) {
        lines.push_back({name + ".single", sets, peer, single, alone});
        lines.push_back({name + ".batch", sets, peer, batch, alone});
    };
    const auto add_lengths = [&](const std::string& prefix, std::string_view single, std::string_view batch,
                                 bool alone) {
        add(prefix + "short", shorts, embree, single, batch, alone);
        add(prefix + "cloud", of(SegmentSet::cloud), embree, single, batch, alone);
        add(prefix + "medium", of(SegmentSet::medium), embree, single, batch, alone);
        add(prefix + "long", longs, embree, single, batch, alone);
    };
    add_lengths(std::string(k_main_peer), pierce, pierce_batch, true);
    Sets lines_of_sight = shorts;
    lines_of_sight.insert(lines_of_sight.end(), longs.begin(), longs.end());
    add("embree.any", lines_of_sight, embree_any, pierce_any, pierce_any_batch);
    add("embree.rest", of(SegmentSet::rest), embree, pierce, pierce_batch);
    add("embree.axis", of(SegmentSet::axis), embree, pierce, pierce_batch);
    add_lengths("fronts.", fronts, fronts_batch, false);
    add_lengths("grid.", grid, grid_batch, false);
    const std::vector<RatioLine> others = {
        {"embree.build", {set_name::build}, embree_low, pierce},
        {"embree.build_fresh", {set_name::build_fresh}, embree_low, pierce},
        {"embree.build_high", {set_name::build}, embree, pierce},
        {"embree.memory", {set_name::memory}, embree, pierce},
        {"grid.build", {set_name::build}, embree_low, grid},
        {"grid.memory", {set_name::memory}, embree, grid},
        {"bullet.short.single", shorts, bullet, pierce},
        {"cgal.short.single", shorts, cgal_any, pierce},
        {"threads.batch", {set_name::threads}, pierce_batch, pierce_two_threads},
        {"threads.build", {set_name::thread_build}, pierce, pierce_two_threads}};
    lines.insert(lines.end(), others.begin(), others.end());
    return lines;
}

std::string line_of(const std::string& name, double value) { return "ratio " + name + ' ' + number(value) + '\n'; }

/// What a thousand times the faces cost us, over what they cost Embree.
std::string growth_line(const Results& results) {
    const auto ratio = [&](std::string_view mesh) {
        return results.ratio(mesh, of(SegmentSet::short_02, SegmentSet::short_1), column::embree, column::pierce);
    };
    const auto small = ratio("sphere10k");
    const auto large = ratio("sphere10M");
    return small && large ? line_of("ours.growth", *small / *large) : "";
}

}  // namespace

void print_ratios(const Results& results, const std::vector<Measured>& meshes) {
    std::vector<std::string> head = {"time of the peer over ours"};
    for (const Measured& m : meshes) head.push_back(m.mesh.name);
    head.emplace_back("median, real");
    Table table(head);
    std::string medians;
    std::map<std::string_view, std::string> alone;
    for (const RatioLine& line : ratio_lines()) {
        std::vector<std::string> row = {line.name};
        std::vector<double> real;
        for (const Measured& m : meshes) {
            const auto ratio = results.ratio(m.mesh.name, line.sets, line.peer, line.ours);
            row.push_back(cell(ratio));
            if (!ratio) continue;
            if (m.mesh.kind == MeshKind::real) real.push_back(*ratio);
            if (line.alone && std::find(k_alone.begin(), k_alone.end(), m.mesh.name) != k_alone.end())
                alone[m.mesh.name] += line_of(m.mesh.name + '.' + line.name.substr(k_main_peer.size()), *ratio);
        }
        row.push_back(real.empty() ? "-" : number(median(real)));
        if (!real.empty()) medians += line_of(line.name, median(real));
        if (std::any_of(row.begin() + 1, row.end(), [](const std::string& text) { return text != "-"; }))
            table.add(row);
    }
    std::cout << "### Ratios\n\nThe peer's time (or bytes) over ours, the median of the repetitions' ratios: more is "
                 "better. Sets that are taken together count by their time. What is timed, and how: "
                 "tests/bench/README.md.\n\n";
    table.print(std::cout);
    std::cout << medians;
    for (const auto& [mesh, lines] : alone) std::cout << lines;
    std::cout << growth_line(results) << std::flush;
}

}  // namespace pierce::bench
