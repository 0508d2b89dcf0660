// A spinning lidar is carried through a scene: range images, and a cloud of points.
//   lidar [MESH] [--range range.png] [--cloud cloud.ply] [--from X,Y,Z] [--to X,Y,Z]
// Each ray has an origin of its own, as the scanner moves on while it spins: a rolling shutter.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <vector>

#include <pierce/pierce.h>
#include <pierce/tbb.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "show/demo.h"
#include "show/image.h"
#include "show/shapes.h"

namespace {

using Vec3 = Eigen::Vector3f;

struct Scanner {
    int beams = 64;      // from 25 degrees below the horizon to 15 above
    int columns = 1024;  // in a turn
    float reach = 0;     // in the units of the mesh
};

/// One turn while the scanner goes from `from` to `to`, column by column. y is up.
std::vector<pierce::Ray<float>> turn(const Scanner& scanner, const Vec3& from, const Vec3& to) {
    std::vector<pierce::Ray<float>> rays;
    for (int column = 0; column < scanner.columns; ++column) {
        const float part = static_cast<float>(column) / static_cast<float>(scanner.columns);
        const float azimuth = 2 * std::numbers::pi_v<float> * part;
        for (int beam = 0; beam < scanner.beams; ++beam) {
            const float above = (-25 + 40 * static_cast<float>(beam) / static_cast<float>(scanner.beams - 1)) *
                                std::numbers::pi_v<float> / 180;
            const Vec3 direction(std::cos(above) * std::cos(azimuth), std::sin(above),
                                 std::cos(above) * std::sin(azimuth));
            rays.push_back({from + part * (to - from), direction, scanner.reach});
        }
    }
    return rays;
}

/// Near is bright, down to a sixteenth at the end of the rays; what nothing came back from is blue.
show::Image range_image(const Scanner& scanner, const std::vector<pierce::Hit<float>>& hits) {
    show::Image image{scanner.columns, scanner.beams, {}};
    for (int row = scanner.beams - 1; row >= 0; --row)
        for (int column = 0; column < scanner.columns; ++column) {
            const auto& hit = hits[static_cast<std::size_t>(column * scanner.beams + row)];
            const auto grey = static_cast<std::uint8_t>(hit ? 255 / (1 + 15 * hit.exact_fraction / scanner.reach) : 0);
            image.rgb.insert(image.rgb.end(), {grey, grey, static_cast<std::uint8_t>(hit ? grey : 60)});
        }
    return image;
}

/// The places, and how much light comes back: the cosine of the angle to the normal.
void write_cloud(const std::filesystem::path& path, const std::vector<pierce::Ray<float>>& rays,
                 const std::vector<pierce::Hit<float>>& hits) {
    const auto count = std::ranges::count_if(hits, [](const auto& hit) { return bool(hit); });
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << count
         << "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\nend_header\n";
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i]) continue;
        const Vec3 at = hits[i].position.vec();
        const std::array<float, 4> row = {at.x(), at.y(), at.z(), -rays[i].direction.dot(hits[i].facing())};
        file.write(reinterpret_cast<const char*>(row.data()), sizeof row);
    }
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": can't be written");
}

}  // namespace

int main(int argc, char** argv) {
    std::filesystem::path mesh_file, range_file = "range.png", cloud_file = "cloud.ply";
    std::vector<float> from, to;
    int turns = 10;
    Scanner scanner;
    CLI::App app("A spinning lidar is carried through a scene, y up: a picture of distances and a cloud of points.",
                 "lidar");
    app.add_option("MESH", mesh_file, "A mesh: OBJ, OFF, PLY or STL; else a hall of 40 x 12 x 40 is made")
        ->option_text(" ");
    app.add_option("--from", from, "Where it begins; else near the corner of least x and z, an eighth of the height up")
        ->delimiter(',')
        ->expected(3)
        ->check(show::finite)
        ->option_text("X,Y,Z");
    app.add_option("--to", to, "Where it ends; else near the opposite corner")
        ->delimiter(',')
        ->expected(3)
        ->check(show::finite)
        ->option_text("X,Y,Z");
    app.add_option("--turns", turns, "How often it turns on its way (10)")
        ->check(CLI::Range(1, 1'000'000))
        ->option_text("N");
    app.add_option("--reach", scanner.reach, "How far its rays go; else twice the mesh's diagonal")
        ->check(show::finite)
        ->check(CLI::Range(1e-30, 1e30))
        ->option_text("LENGTH");
    app.add_option("--range", range_file, "The last turn as a PNG picture: brighter is nearer (range.png)")
        ->option_text("FILE");
    app.add_option("--cloud", cloud_file, "The points of all turns, as PLY (cloud.ply)")->option_text("FILE");
    CLI11_PARSE(app, argc, argv);
    try {
        const auto soup =
            mesh_file.empty() ? show::hall(1, Eigen::Isometry3d::Identity()) : pierce::read_mesh<float>(mesh_file);
        const pierce::CollisionMesh<float> mesh(soup.view(), {.executor = pierce::tbb_executor()});

        Eigen::AlignedBox3f box;
        for (const Vec3& position : soup.positions) box.extend(position);
        const auto place = [&box](const std::vector<float>& asked, const Vec3& part) {
            return asked.empty() ? Vec3(box.min() + part.cwiseProduct(box.diagonal()))
                                 : Vec3(asked[0], asked[1], asked[2]);
        };
        const Vec3 start = place(from, {0.1f, 0.125f, 0.1f}), end = place(to, {0.9f, 0.125f, 0.9f});
        if (scanner.reach == 0) scanner.reach = 2 * box.diagonal().norm();
        std::vector<pierce::Ray<float>> rays, all_rays;
        std::vector<pierce::Hit<float>> hits, all_hits;
        double seconds = 0;
        for (int k = 0; k < turns; ++k) {
            const auto at = [&](int n) {
                return Vec3(start + static_cast<float>(n) / static_cast<float>(turns) * (end - start));
            };
            rays = turn(scanner, at(k), at(k + 1));
            hits.resize(rays.size());
            const auto begin = std::chrono::steady_clock::now();
            mesh.first_hits(rays, hits, {.sides = pierce::Sides::both}, pierce::tbb_executor());
            seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            all_rays.insert(all_rays.end(), rays.begin(), rays.end());
            all_hits.insert(all_hits.end(), hits.begin(), hits.end());
        }
        show::write_png(range_file, range_image(scanner, hits));
        write_cloud(cloud_file, all_rays, all_hits);
        std::cout << std::ranges::count_if(all_hits, [](const auto& hit) { return bool(hit); }) << " of "
                  << all_rays.size() << " rays came back, " << 1e-6 * static_cast<double>(all_rays.size()) / seconds
                  << " million rays a second\n";
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "lidar: " << error.what() << '\n';
        return 2;
    }
}
