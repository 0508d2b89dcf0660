// Do particles stay in a closed bowl if they are put exactly where they hit, and slide on from there? With no skin, and
// with one.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <support/inside_oracle.h>
#include <support/meshes.h>

#include "experiments.h"
#include "table.h"

namespace pierce::bench {
namespace {

constexpr double k_radius = 100;
constexpr double k_gravity = 5 * k_radius;
constexpr double k_seconds = 1.0 / 60;
constexpr int k_steps = 240;
constexpr double k_skin = 0.01;

struct Particle {
    Point position;
    Point velocity;
    std::size_t contacts = 0;
    double way_after_contact = 0;
};

/// On each contact the particle keeps the part of its velocity that is along the face. With a skin it stops that much
/// earlier on its way.
void step(const Peer& peer, double skin, Particle& particle) {
    particle.velocity[2] -= k_gravity * k_seconds;
    double left = k_seconds;
    for (int slide = 0; slide < 4 && left > 0; ++slide) {
        const Point from = particle.position;
        const Point to = peer.rounded(from + left * particle.velocity);
        const auto stop = peer.first(from, to);
        particle.position = stop ? stop->point : to;
        if (stop && skin > 0) {
            const Point way = stop->point - from;
            particle.position = peer.rounded(from + std::max(0.0, 1 - skin / way.norm()) * way);
        }
        const double length = (to - from).norm();
        const double moved = (particle.position - from).norm();
        if (particle.contacts > 0) particle.way_after_contact += moved;
        if (!stop) return;
        ++particle.contacts;
        left *= length > 0 ? std::max(0.0, 1 - moved / length) : 0;
        particle.velocity -= particle.velocity.dot(stop->normal) * stop->normal;
    }
}

/// A bowl around `centre`, and who says what is outside of it.
struct Bowl {
    explicit Bowl(double offset)
        : centre(offset * Point(1, -1, 1)), soup(test::moved<float>(test::bowl(24), k_radius, centre)) {
        TriangleSoup<double> in_double;
        for (const Vec3<float>& p : soup.positions) in_double.positions.push_back(p.cast<double>());
        in_double.triangles = soup.triangles;
        oracle.emplace(in_double);
        soup = test::turned_inside_out(soup);
    }
    Point centre;
    TriangleSoup<float> soup;
    std::optional<test::InsideOracle<double>> oracle;
};

struct Outcome {
    Share outside;
    double way_after_contact = 0;  ///< mean, in radii
};

Outcome measure(Run& run, const Library& library, const Bowl& bowl, double skin, std::size_t particles) {
    const auto peer = library.make(bowl.soup, Backs::culled);
    test::Random random(5);
    Outcome outcome;
    for (std::size_t i = 0; i < particles; ++i) {
        const Point start = peer->rounded(bowl.centre + 0.25 * k_radius * random.in_cube());
        const double speed = k_radius * std::exp(random.between(-1, 2));
        Particle particle{.position = start, .velocity = speed * random.direction()};
        for (int s = 0; s < k_steps; ++s) step(*peer, skin, particle);
        const bool is_outside = bowl.oracle->outside(particle.position);
        outcome.outside.add(is_outside);
        outcome.way_after_contact += particle.way_after_contact / k_radius / static_cast<double>(particles);
        run.must(!is_outside, library, "a particle got out of the bowl", start, particle.position);
    }
    return outcome;
}

}  // namespace

void collide_and_slide(Run& run) {
    const std::size_t particles = run.many(2000);
    Table table({"outside at the end", "offset 0", "skin 0.01", "offset 1e3", "skin 0.01", "offset 1e6", "skin 0.01"});
    std::vector<std::vector<std::string>> rows;
    for (const Library& library : libraries()) rows.push_back({library.name});
    std::ostringstream notes;
    for (const double offset : {0.0, 1e3, 1e6}) {
        const Bowl bowl(offset);
        for (std::size_t i = 0; const Library& library : libraries()) {
            std::vector<std::string>& row = rows[i++];
            if (library.hangs_at_ends) {  // its particles would stand on faces
                row.insert(row.end(), {"-", "-"});
                continue;
            }
            const Outcome outcome = measure(run, library, bowl, 0, particles);
            row.push_back(outcome.outside.percent());
            const Outcome with_skin = library.is_pierce ? outcome : measure(run, library, bowl, k_skin, particles);
            row.push_back(library.is_pierce ? "-" : with_skin.outside.percent());
            if (offset == 0)
                notes << (i == 1 ? "" : ", ") << library.name << ' ' << std::setprecision(3)
                      << with_skin.way_after_contact;
        }
    }
    for (const std::vector<std::string>& row : rows) table.add(row);
    std::cout
        << "### 5. Collide and slide\n\n"
        << particles << " particles, " << k_steps
        << " steps of 1/60 s, in a closed bowl of 4,608 faces and radius 100. Gravity pulls; on a hit the particle "
           "is put where the library says, keeps its velocity along the face, and goes on for the rest of the "
           "step, at most four times. With no skin, and with one: there it stops 0.01 earlier on its way, as "
           "users of such libraries do; pierce needs none. Embree and CGAL cull backs here, by the sign of normal "
           "times direction: a particle that got out can come in again. Outside is what CGAL's "
           "Side_of_triangle_mesh says, at the end. Staying inside is not sticking: at the origin the way of a "
           "particle after its first contact is, in radii, "
        << notes.str() << " (pierce without a skin, the others with one).\n\n";
    table.print(std::cout);
}

}  // namespace pierce::bench
