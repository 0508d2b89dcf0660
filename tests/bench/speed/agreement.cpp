#include "agreement.h"

#include <cmath>
#include <string>

#include "measure.h"

namespace pierce::bench {
namespace {

/// A hit this near to an end of the segment is a hit or a miss by rules that differ, and by rounding.
constexpr double k_end = 1e-3;
/// Fractions that differ by more are those of different hits.
constexpr double k_same = 1e-3;

bool at_an_end(const Answer& answer) { return answer.hit && (answer.fraction < k_end || answer.fraction > 1 - k_end); }

Column* find(const Columns& columns, std::string_view name) {
    for (const auto& column : columns)
        if (column->name() == name) return column.get();
    return nullptr;
}

}  // namespace

void Agreement::compare(std::string_view mesh, std::string_view set, const Columns& columns, std::size_t count,
                        double seconds) {
    Column& pierce = *find(columns, column::pierce);
    Column& embree = *find(columns, column::embree);
    Column* cgal = find(columns, column::cgal_any);
    Row row{.place = std::string(mesh) + '/' + std::string(set), .at_ends = {}, .embree = {}, .cgal = {}, .hits = {}};
    const double start = seconds_now(Clock::thread);
    for (std::size_t i = 0; i < count && seconds_now(Clock::thread) < start + seconds; ++i) {
        const Answer ours = pierce.answer(i);
        const Answer theirs = embree.answer(i);
        row.hits.add(ours.hit);
        const bool end = at_an_end(ours) || at_an_end(theirs);
        row.at_ends.add(end);
        if (!end)
            row.embree.add(ours.hit != theirs.hit || (ours.hit && std::abs(ours.fraction - theirs.fraction) > k_same));
        if (cgal != nullptr) row.cgal.add(cgal->answer(i).hit != ours.hit);
    }
    rows_.push_back(std::move(row));
}

bool Agreement::report() const {
    if (rows_.empty()) return true;
    Share embree;
    Share cgal;
    Table table({"mesh/set", "compared", "hits", "Embree differs", "at an end", "CGAL differs"});
    for (const Row& row : rows_) {
        embree.add(row.embree);
        cgal.add(row.cgal);
        table.add({row.place, std::to_string(row.hits.whole), row.hits.percent(), row.embree.percent(),
                   row.at_ends.percent(), row.cgal.whole == 0 ? "-" : std::to_string(row.cgal.part)});
    }
    const double rate = embree.whole == 0 ? 0 : static_cast<double>(embree.part) / static_cast<double>(embree.whole);
    const bool fine = rate <= k_tolerated && cgal.part == 0;
    std::cout
        << "### Answers\n\nThe first hit for both sides, before time was taken. Embree differs: hit or not, or a "
           "fraction by more "
           "than 0.001; hits that either sees within 0.001 of an end are set aside, as rules and rounding decide there "
           "(at an end). CGAL "
           "differs: of the triangles that the segment meets, whether any has its ends on different sides, where "
           "on the plane counts as in front, which is pierce's rule.\n\n";
    table.print(std::cout);
    std::cout << "Embree differs in " << embree.part << " of " << embree.whole
              << " answers; tolerated: 1 of 1000. CGAL differs in " << cgal.part << " of " << cgal.whole
              << "; tolerated: none. " << (fine ? "Fine." : "FAILED.") << "\n\n";
    return fine;
}

}  // namespace pierce::bench
