// Are small faces, or short steps, overlooked? That comes of comparing a product of lengths with a fixed number.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include <Eigen/Geometry>

#include <support/random.h>

#include "experiments.h"
#include "table.h"

namespace pierce::bench {
namespace {

constexpr std::array k_edges = {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
constexpr std::array k_steps = {10.0, 1.0, 1e-1, 1e-2, 1e-3, 1e-4};
/// Lengths that coordinates at this distance still hold to a few per cent.
bool is_held(double length, double distance) { return length >= 32 * distance * std::numeric_limits<float>::epsilon(); }

constexpr std::array k_distances = {0.0, 1000.0};

std::string number(double x) {
    std::ostringstream out;
    out << x;
    return out.str();
}

/// An equilateral triangle, and the middle of it.
struct Target {
    TriangleSoup<float> soup;
    Point centroid;
    Point normal;
};

Target target(double edge, double distance, test::Random& random) {
    const Eigen::Quaterniond turn =
        Eigen::AngleAxisd(random.between(0, 2 * std::numbers::pi), random.direction()) * Eigen::Quaterniond::Identity();
    const Point middle = distance * random.direction();
    Target result;
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * std::numbers::pi * k / 3;
        const Point corner = turn * Point(std::cos(angle), std::sin(angle), 0);
        result.soup.positions.push_back((middle + edge / std::sqrt(3.0) * corner).cast<float>());
    }
    result.soup.triangles = {{0, 1, 2}};
    const auto corner = [&](std::size_t k) -> Point { return result.soup.positions[k].cast<double>(); };
    result.centroid = (corner(0) + corner(1) + corner(2)) / 3;
    result.normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    return result;
}

/// The steps that are missed, by some of the triangles at least.
std::string missed_steps(Run& run, const Library& library, double edge, double distance) {
    if (!is_held(edge, distance)) return "-";
    std::array<bool, k_steps.size()> missed = {};
    test::Random random(3);
    for (std::size_t i = 0; i < run.many(200); ++i) {
        const Target t = target(edge, distance, random);
        const auto peer = library.make(t.soup, Backs::count);
        for (std::size_t s = 0; s < k_steps.size(); ++s) {
            if (!is_held(k_steps[s], distance)) continue;
            const Point from = peer->rounded(t.centroid + 0.5 * k_steps[s] * t.normal);
            const Point to = peer->rounded(t.centroid - 0.5 * k_steps[s] * t.normal);
            const bool hit = peer->first(from, to).has_value();
            missed[s] = missed[s] || !hit;
            run.must(hit, library, "misses a triangle of edge " + number(edge), from, to);
        }
    }
    std::string list;
    for (std::size_t s = 0; s < k_steps.size(); ++s)
        if (missed[s]) list += (list.empty() ? "" : ", ") + number(k_steps[s]);
    return list.empty() ? "ok" : list;
}

}  // namespace

void scales(Run& run) {
    std::vector<std::string> head = {"", "distance"};
    for (const double edge : k_edges) head.push_back("edge " + number(edge));
    Table table(head);
    for (const double distance : k_distances)
        for (const Library& library : libraries()) {
            std::vector<std::string> row = {library.name, number(distance)};
            for (const double edge : k_edges) row.push_back(missed_steps(run, library, edge, distance));
            table.add(row);
        }
    std::cout
        << "### 3. Small faces, short steps\n\n"
        << run.many(200)
        << " equilateral triangles of each edge length, turned at random, at the origin and at a distance of 1000 "
           "from it. Steps of length 10, 1, 0.1, 0.01, 0.001 and 0.0001, half in front and half behind, go through "
           "the centroid at a right angle. Listed are the steps that missed some of the triangles; \"ok\": none. "
           "Left out is what floats at that distance can't hold to a few per cent (-).\n\n";
    table.print(std::cout);
}

}  // namespace pierce::bench
