// What mesh_report costs beside a build of the same mesh: time of the report over time of the build, one thread, warm
// memory.
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <malloc.h>

#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>
#include <support/meshes.h>

#include "table.h"

namespace pierce::bench {
namespace {

using Soup = TriangleSoup<float>;

double seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);  // other programs do not count
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::string number(double value, int digits) {
    std::ostringstream out;
    out << std::setprecision(digits) << value;
    return out.str();
}

Soup in_float(const TriangleSoup<double>& soup) { return test::moved<float>(soup, 1, {0, 0, 0}); }

/// The same triangles and vertices in random order: each with memory far from its neighbours'.
Soup shuffled(Soup soup) {
    test::Random random(1);
    std::vector<std::uint32_t> place(soup.positions.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
    for (std::size_t i = place.size(); i-- > 1;) std::swap(place[i], place[random.below(i + 1)]);
    Soup out;
    out.positions.resize(soup.positions.size());
    for (std::size_t i = 0; i < place.size(); ++i) out.positions[place[i]] = soup.positions[i];
    for (std::size_t i = soup.triangles.size(); i-- > 1;)
        std::swap(soup.triangles[i], soup.triangles[random.below(i + 1)]);
    for (const IndexTriple& t : soup.triangles) out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    return out;
}

/// Two vertices that all triangles share.
Soup spindle(std::uint32_t count) {
    Soup soup;
    soup.positions = {{0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * i / count;
        soup.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
        const std::uint32_t a = 2 + i;
        const std::uint32_t b = 2 + (i + 1) % count;
        soup.triangles.push_back({0, a, b});
        soup.triangles.push_back({1, b, a});
    }
    return soup;
}

/// Triangles with random corners in a cube, or (flat) in a square: each edge is a border, and passes among many others'
/// ends.
Soup random_triangles(std::uint32_t count, bool flat) {
    test::Random random(4);
    Soup soup;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            Vec3<double> p = random.in_cube();
            if (flat) p[2] = 0;
            soup.positions.push_back(p.cast<float>());
        }
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return soup;
}

struct Row {
    std::string name;
    std::function<Soup()> make;
};

std::vector<Row> rows(const std::filesystem::path& folder) {
    const auto n = [](std::uint32_t count) { return [count] { return random_triangles(count, false); }; };
    const auto flat = [](std::uint32_t count) { return [count] { return random_triangles(count, true); }; };
    const auto sphere = [](int size) { return in_float(test::bumpy_sphere(size)); };
    std::vector<Row> all = {
        {"sphere_10k", [=] { return sphere(36); }},
        {"sphere_1M", [=] { return sphere(354); }},
        {"sphere_1M_shuffled", [=] { return shuffled(sphere(354)); }},
        {"sphere_1M_apart", [=] { return test::apart(sphere(354)); }},
        {"polycube_380k", [] { return in_float(test::polycube(50, 0.5, 1, 1)); }},
        {"spindle_200k", [] { return spindle(100'000); }},
        {"random_1k", n(1000)},
        {"random_4k", n(4000)},
        {"random_16k", n(16'000)},
        {"flat_1k", flat(1000)},
        {"flat_4k", flat(4000)},
        {"shards_50k", [] { return in_float(test::shards(50'000, 1)); }},
    };
    for (const char* file : {"dragon.ply", "stanford-bunny.obj", "kitchen_merged.ply", "jacksboro_dem.ply",
                             "teapot_in_stadium.ply", "dungeon.obj"})
        if (const auto path = folder / file; exists(path))
            all.push_back({path.stem().string(), [path] { return read_mesh<float>(path.string()); }});
    return all;
}

void run(const std::filesystem::path& folder, const std::string& filter) {
    // Freed memory is kept, so that neither side waits for the system's pages.
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
    Table table({"", "faces", "build, ns a face", "report, ns a face", "borders", "T-junctions", "report / build"});
    std::vector<std::pair<std::string, double>> ratios;
    for (const Row& row : rows(folder)) {
        if (row.name.find(filter) == std::string::npos) continue;
        const Soup soup = row.make();
        std::vector<double> builds;
        std::vector<double> reports;
        std::vector<double> shares;
        MeshReport report;
        const double begin = seconds();
        for (int i = 0; i < 2 || (i < 41 && seconds() - begin < 3); ++i) {
            const double start = seconds();
            const CollisionMesh<float> mesh(soup.view());
            const double built = seconds();
            report = mesh.mesh_report();
            const double reported = seconds();
            if (i == 0) continue;  // it fetches the memory
            builds.push_back(built - start);
            reports.push_back(reported - built);
            shares.push_back(reports.back() / builds.back());
        }
        const auto faces = static_cast<double>(soup.triangles.size());
        const double ratio = median(shares);
        table.add({row.name, std::to_string(soup.triangles.size()), number(1e9 * median(builds) / faces, 4),
                   number(1e9 * median(reports) / faces, 4), std::to_string(report.border_edges),
                   std::to_string(report.t_junctions), number(ratio, 3)});
        ratios.emplace_back(row.name, ratio);
    }
    table.print(std::cout);
    for (const auto& [name, ratio] : ratios) std::cout << "ratio report." << name << ' ' << ratio << '\n';
}

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    pierce::bench::run(PIERCE_SHARED_MESHES, argc > 1 ? argv[1] : "");
    return 0;
}
