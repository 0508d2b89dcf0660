// Do segments get out of a closed surface between its faces? They are aimed at vertices and edges, where neighbours
// have to agree.
#include <array>

#include <support/meshes.h>

#include "experiments.h"
#include "table.h"

namespace pierce::bench {
namespace {

enum class Aim { vertex, edge, face };
constexpr std::array k_aims = {Aim::vertex, Aim::edge, Aim::face};

struct Shot {
    Point from;
    Point to;
    bool exact;  ///< the middle of the segment is the vertex, or the middle of the edge, to the last bit
};

Point to_float(const Point& p) { return p.cast<float>().cast<double>(); }

/// From near the centre to far outside. If it is to go exactly through a vertex, or the middle of an edge, it does if
/// 16 attempts find coordinates for that; else it is aimed as nearly as coordinates allow.
Shot shot(const TriangleSoup<float>& soup, const Point& centre, Aim aim, bool exact, test::Random& random) {
    const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
    const std::size_t k = random.below(3);
    const auto corner = [&](std::size_t i) -> Point { return soup.positions[t[i % 3]].cast<double>(); };
    for (int attempt = 0; exact && attempt < 16; ++attempt) {
        const Point twice_target = aim == Aim::vertex ? Point(2 * corner(k)) : Point(corner(k) + corner(k + 1));
        const Point to = to_float(twice_target - to_float(centre + 0.1 * random.in_cube()));
        const Point from = to_float(twice_target - to);
        if (from + to == twice_target) return {from, to, true};
    }
    Point w = random.weights();
    if (aim == Aim::vertex) w = {1, 0, 0};
    if (aim == Aim::edge) w = {1 - w[1], w[1], 0};
    const Point target = w[0] * corner(k) + w[1] * corner(k + 1) + w[2] * corner(k + 2);
    const Point from = to_float(centre + 0.1 * random.in_cube());
    return {from, to_float(target + random.between(0.5, 1.5) * (target - from)), false};
}

struct Tally {
    Share missed;
    Share several;
    Share not_crossed_once;
};

Tally measure(Run& run, const Library& library, const Peer& peer, const std::vector<Shot>& shots) {
    Tally tally;
    for (const Shot& s : shots) {
        const bool found = peer.first(s.from, s.to).has_value();
        const std::size_t count = peer.count(s.from, s.to);
        const int crossings = peer.crossings(s.from, s.to).value_or(1);
        tally.missed.add(!found);
        tally.several.add(count > 1);
        tally.not_crossed_once.add(crossings != 1);
        run.must(found, library, "gets out of a closed surface", s.from, s.to);
        run.must((count > 0) == found, library, "first_hit and all_hits disagree", s.from, s.to);
        run.must(crossings == 1, library, "does not cross a closed surface exactly once", s.from, s.to);
    }
    return tally;
}

}  // namespace

void seams(Run& run) {
    const std::size_t count = run.many(100'000);
    Share exact;
    Table table({"", "offset", "vertices: missed", "> 1 report", "edges: missed", "> 1 report", "faces: missed",
                 "> 1 report", "crossings not 1"});
    for (const double offset : {0.0, 1000.0}) {
        const Point centre = offset * Point(1, -1, 1);
        const auto soup = test::turned_inside_out(test::moved<float>(test::bumpy_sphere(50), 1, centre));
        std::array<std::vector<Shot>, k_aims.size()> shots;
        test::Random random(1);
        for (std::size_t a = 0; a < k_aims.size(); ++a)
            for (std::size_t i = 0; i < count; ++i) {
                shots[a].push_back(shot(soup, centre, k_aims[a], k_aims[a] != Aim::face && i % 2 == 0, random));
                if (k_aims[a] != Aim::face) exact.add(shots[a].back().exact);
            }
        for (const Library& library : libraries()) {
            const auto peer = library.make(soup, Backs::count);
            std::vector<std::string> row = {library.name, offset == 0 ? "0" : "1000"};
            Share not_crossed_once;
            for (const std::vector<Shot>& aimed : shots) {
                const Tally tally = measure(run, library, *peer, aimed);
                row.push_back(tally.missed.percent());
                row.push_back(tally.several.percent());
                not_crossed_once.add(tally.not_crossed_once);
            }
            row.push_back(library.is_pierce ? not_crossed_once.percent() : "-");
            table.add(row);
        }
    }
    std::cout
        << "### 1. Seams\n\n"
        << "From inside to outside of a closed bumpy sphere of 20,000 faces and radius 1, in float, at the origin "
           "and at (1000, -1000, 1000): "
        << count << " segments each, aimed at vertices, at edges and at points of faces. " << exact.percent()
        << " of those aimed at vertices and edges pass exactly through a vertex or the middle of an edge, the "
           "others as nearly as coordinates allow. Missed: the first hit was asked for, and there was none. > 1 "
           "report: all hits were asked for, and there were several. On a segment that passes exactly through a "
           "vertex or an edge that is no fault, as it does meet several faces; but it is why hits can't be counted "
           "to find out what is inside. `crossings` must be 1: the faces look inwards.\n\n";
    table.print(std::cout);
}

}  // namespace pierce::bench
