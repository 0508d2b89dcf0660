// Sweeps against a mesh that moves straight, or turns, beside `first_hit` of the way as the mesh sees it: one thread,
// all ways in turn, medians of repetitions. Prints nanoseconds a query, and
//   ratio static.glide.SCALAR.LENGTH   first_hit of the same relative way / a sweep against a mesh that moves
//   ratio static.turn.SCALAR.ANGLE     first_hit of the chord between the ends / a sweep against a mesh that turns
// The sphere has 80,000 triangles and radius 1; lengths are in diagonals of its box, and tolerances in its radius.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>
#include <type_traits>
#include <vector>

#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/random.h>

#include "table.h"

namespace pierce::bench {
namespace {

constexpr int k_ways = 20'000;
constexpr int k_repetitions = 7;

double nanoseconds(const std::function<void()>& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
    };
    const double start = now();
    work();
    return (now() - start) / k_ways;
}

/// Medians, the works in turn.
std::vector<double> medians(const std::vector<std::function<void()>>& works) {
    std::vector<std::vector<double>> times(works.size());
    for (int r = 0; r < k_repetitions; ++r)
        for (std::size_t i = 0; i < works.size(); ++i) times[i].push_back(nanoseconds(works[i]));
    std::vector<double> out;
    for (auto& t : times) {
        std::nth_element(t.begin(), t.begin() + k_repetitions / 2, t.end());
        out.push_back(t[k_repetitions / 2]);
    }
    return out;
}

std::string text(double x) {
    std::ostringstream out;
    out << std::setprecision(3) << x;
    return out.str();
}

template <class Scalar>
struct Ways {
    std::vector<Segment<Scalar>> still;   ///< as the mesh sees them
    std::vector<Segment<Scalar>> moving;  ///< in the world
};

/// Near the surface, half of them through it; `motion` is added to the ends.
template <class Scalar>
Ways<Scalar> make_ways(double length, const Translation<Scalar>& motion, std::uint64_t seed) {
    test::Random random(seed);
    Ways<Scalar> ways;
    for (int i = 0; i < k_ways; ++i) {
        const Vec3<double> middle = (1 + 0.5 * length * (2 * random.unit() - 1)) * random.direction();
        const Vec3<double> half = length * random.direction();
        const Vec3<Scalar> from = (middle - half).cast<Scalar>();
        const Vec3<Scalar> to = (middle + half).cast<Scalar>();
        ways.still.push_back({from, to});
        ways.moving.push_back({from + motion.from, to + motion.to});
    }
    return ways;
}

volatile std::size_t sink;

template <class Scalar>
void run(const char* scalar, Table& table, std::vector<std::string>& ratios) {
    const TriangleSoup<Scalar> soup = test::moved<Scalar>(test::bumpy_sphere(100), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    const QueryOptions both{.sides = Sides::both};
    for (const double length : {0.01, 0.1, 1.0}) {
        // Powers of two, so that nearly all sums are numbers; and any, of which nearly none is.
        const Translation<Scalar> even{{Scalar(0.5), 0, Scalar(-0.25)}, {Scalar(0.25), Scalar(0.125), 0}};
        const Translation<Scalar> odd{{Scalar(0.7), Scalar(0.1), Scalar(-0.3)},
                                      {Scalar(0.2), Scalar(0.9), Scalar(0.3)}};
        const Ways<Scalar> ways = make_ways<Scalar>(length, even, 1);
        const Ways<Scalar> rough = make_ways<Scalar>(length, odd, 1);
        std::size_t hits = 0, differ = 0;
        for (int i = 0; i < k_ways; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const auto still = mesh.first_hit(ways.still[k], both);
            const auto moving = mesh.sweep(ways.moving[k], even, both);
            hits += still ? 1 : 0;
            differ += still.has_value() != moving.has_value() || (still && still->triangle != moving->triangle) ? 1 : 0;
        }
        // Sums are rounded when the ways are made, so some ways are others.
        if (differ > k_ways / 100) std::cerr << "answers differ: " << differ << '\n', std::exit(1);
        const auto sweeps = [&](const Ways<Scalar>& of, const Translation<Scalar>& motion) {
            return [&mesh, &of, motion, both] {
                for (const Segment<Scalar>& way : of.moving) sink = sink + mesh.sweep(way, motion, both).has_value();
            };
        };
        const auto first_hits = [&] {
            for (const Segment<Scalar>& way : ways.still) sink = sink + mesh.first_hit(way, both).has_value();
        };
        const auto t = medians({first_hits, sweeps(ways, even), sweeps(rough, odd)});
        table.add({scalar, "moved, way " + text(length), text(100.0 * static_cast<double>(hits) / k_ways) + " %", "1",
                   text(t[0]), text(t[1]) + " / " + text(t[2])});
        ratios.push_back("ratio static.glide." + std::string(scalar) + "." + text(length) + " " + text(t[0] / t[2]));
    }
    for (const double tolerance : {1e-3, 1e-5})
        for (const double angle : {0.001, 0.01, 0.1, 1.0}) {
            const Screw screw{{0.1, 0.2, 0.3}, {1, 2, 3}, angle};
            const RigidMotion motion({}, screw, tolerance);
            const Ways<Scalar> ways = make_ways<Scalar>(0.05, {Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero()}, 2);
            std::vector<Segment<Scalar>> chords;
            double count = 0;
            std::size_t hits = 0;
            for (const Segment<Scalar>& way : ways.moving) {
                chords.push_back({motion.start_in_mesh(way.from), motion.end_in_mesh(way.to)});
                count += static_cast<double>(motion.chords(way)) / k_ways;
                hits += mesh.sweep(way, motion, both) ? 1 : 0;
            }
            const auto first_hits = [&] {
                for (const Segment<Scalar>& chord : chords) sink = sink + mesh.first_hit(chord, both).has_value();
            };
            const auto sweeps = [&] {
                for (const Segment<Scalar>& way : ways.moving) sink = sink + mesh.sweep(way, motion, both).has_value();
            };
            const auto t = medians({first_hits, sweeps});
            table.add({scalar, "turned by " + text(angle) + ", tolerance " + text(tolerance),
                       text(100.0 * static_cast<double>(hits) / k_ways) + " %", text(count), text(t[0]), text(t[1])});
            if (tolerance == 1e-3)
                ratios.push_back("ratio static.turn." + std::string(scalar) + "." + text(angle) + " " +
                                 text(t[0] / t[1]));
        }
}

}  // namespace
}  // namespace pierce::bench

int main() {
    using namespace pierce::bench;
    Table table({"numbers", "mesh", "hits", "chords", "first_hit, ns", "sweep, ns"});
    std::vector<std::string> ratios;
    run<float>("float", table, ratios);
    run<double>("double", table, ratios);
    table.print(std::cout);
    for (const std::string& ratio : ratios) std::cout << ratio << '\n';
}
