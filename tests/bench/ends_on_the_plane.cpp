// What counts when a step ends, starts or lies exactly on a face? Any answer will do, unless the end of one step and
// the start of the next are both left out: then a point that stops there once is through.
#include <array>

#include <Eigen/Geometry>

#include <support/random.h>

#include "experiments.h"
#include "table.h"

namespace pierce::bench {
namespace {

/// A triangle with integer corners, an integer point inside of it, and an integer way from there to its front.
struct Place {
    TriangleSoup<float> soup;
    Point on;
    Point forward;
    Point along;
};

Place place(test::Random& random) {
    const auto integers = [&](int size) {
        return Point(random.between_ints(-size, size), random.between_ints(-size, size),
                     random.between_ints(-size, size));
    };
    for (;;) {
        const Point a = integers(16);
        const Point u = integers(4);
        const Point v = integers(4);
        const Point normal = u.cross(v);
        const Point forward = integers(8);
        if (normal.squaredNorm() == 0 || normal.dot(forward) <= 0) continue;
        Place result;
        for (const Point& p : {a, Point(a + 16 * u), Point(a + 16 * v)})
            result.soup.positions.push_back(p.cast<float>());
        result.soup.triangles = {{0, 1, 2}};
        const int i = random.between_ints(2, 7);
        const int j = random.between_ints(2, 7);
        result.on = a + i * u + j * v;
        result.forward = forward;
        result.along = random.chance(0.5) ? u : v;
        return result;
    }
}

enum Case { ends, goes_in, goes_out, lies, passes, tunnels, case_count };
using Tally = std::array<Share, case_count>;

Tally measure(Run& run, const Library& library, std::size_t count) {
    Tally tally = {};
    test::Random random(4);
    for (std::size_t i = 0; i < count; ++i) {
        const Place p = place(random);
        const auto peer = library.make(p.soup, Backs::count);
        const Point front = p.on + p.forward;
        const Point behind = p.on - p.forward;
        const auto stop = peer->first(front, p.on);
        const bool is_seen_again = peer->first(stop ? stop->point : p.on, behind).has_value();
        const bool is_left = peer->first(p.on, front).has_value();
        const bool is_lain_in = peer->first(p.on, p.on + p.along).has_value();
        tally[ends].add(stop.has_value());
        tally[goes_in].add(peer->first(p.on, behind).has_value());
        tally[goes_out].add(is_left);
        tally[lies].add(is_lain_in);
        tally[passes].add(stop && !is_seen_again);
        tally[tunnels].add(!stop && !is_seen_again);
        run.must(!stop, library, "hits a face that it only ends on", front, p.on);
        run.must(is_seen_again, library, "tunnels in two steps", front, behind);
        run.must(!is_left, library, "hits a face that it leaves", p.on, front);
        run.must(!is_lain_in, library, "hits a face that it lies in", p.on, p.on + p.along);
    }
    return tally;
}

std::string verdict(const Tally& tally) {
    std::string text;
    if (tally[tunnels].part > 0) text = tally[tunnels].percent() + " tunnel";
    if (tally[passes].part > 0) text += (text.empty() ? "" : ", ") + tally[passes].percent() + " pass in the second";
    return text.empty() ? "ok" : text;
}

}  // namespace

void ends_on_the_plane(Run& run) {
    const std::size_t count = run.many(2000);
    Table table({"", "ends on it", "starts on it, goes in", "starts on it, goes out", "lies in it",
                 "two steps: ends on it, goes in"});
    for (const Library& library : libraries()) {
        if (library.hangs_at_ends) {
            table.add({library.name, "-", "-", "-", "-", "-"});
            continue;
        }
        std::vector<std::string> row = {library.name};
        const Tally tally = measure(run, library, count);
        for (const Case c : {ends, goes_in, goes_out, lies})
            row.push_back(tally[c].part == 0 ? "no" : tally[c].all() ? "yes" : tally[c].percent());
        row.push_back(verdict(tally));
        table.add(row);
    }
    std::cout << "### 4. Ends on the plane\n\n"
              << "Is there a hit when a segment ends, starts or lies exactly on a triangle, in " << count
              << " positions with integer coordinates? A share, where it depends. Of two steps the first ends on the "
                 "triangle and the second goes from there, or from where the first was stopped, to behind it: they "
                 "tunnel if neither has a hit, and pass in the second if the first has one, but not the second.\n\n";
    table.print(std::cout);
}

}  // namespace pierce::bench
