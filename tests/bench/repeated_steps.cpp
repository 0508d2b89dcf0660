// Does a point that stops where a library says, and then makes the rest of its step, still run into what stopped it?
#include <cmath>

#include <support/meshes.h>

#include "experiments.h"
#include "table.h"

namespace pierce::bench {
namespace {

/// Share of second steps that nothing stops.
Share measure(Run& run, const Library& library, const TriangleSoup<float>& soup, const Point& centre,
              std::size_t count) {
    const auto peer = library.make(soup, Backs::count);
    test::Random random(2);
    Share through;
    for (std::size_t i = 0; i < count; ++i) {
        // Seen from the centre the surface is a star: below one of its points is inside, above is outside.
        const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
        const auto on_face = [&]() -> Point {
            const Point w = random.weights();
            return w[0] * soup.positions[t[0]].cast<double>() + w[1] * soup.positions[t[1]].cast<double>() +
                   w[2] * soup.positions[t[2]].cast<double>();
        };
        const double below = std::exp(random.between(std::log(0.01), 0));
        const double above = std::exp(random.between(std::log(0.01), 0));
        const Point from = (centre + (1 - below) * (on_face() - centre)).cast<float>().cast<double>();
        const Point to = (centre + (1 + above) * (on_face() - centre)).cast<float>().cast<double>();
        const auto stop = peer->first(from, to);
        run.must(stop.has_value(), library, "gets out of a closed surface", from, to);
        if (!stop) continue;
        const bool again = peer->first(stop->point, to).has_value();
        through.add(!again);
        run.must(again, library, "stops a step, but not the rest of it", from, to);
    }
    return through;
}

}  // namespace

void repeated_steps(Run& run) {
    const std::size_t count = run.many(400'000);
    Table table({"", "offset 0: no second hit", "offset 1000: no second hit"});
    for (const Library& library : libraries()) {
        std::vector<std::string> row = {library.name};
        for (const double offset : {0.0, 1000.0}) {
            const Point centre = offset * Point(1, -1, 1);
            const auto soup = test::turned_inside_out(test::moved<float>(test::bumpy_sphere(50), 1, centre));
            row.push_back(measure(run, library, soup, centre, count).percent());
        }
        table.add(row);
    }
    std::cout << "### 2. Stop at the hit, and go on\n\n"
              << "From inside to outside of the same sphere, " << count
              << " steps. The point is moved to where the library says that it hits, and from there to the same end "
                 "again: share of those that hit nothing the second time, and so are outside.\n\n";
    table.print(std::cout);
}

}  // namespace pierce::bench
