// Particles fall and bounce inside a closed mesh; none may get out, however long it runs.
//   particles [MESH]        without a mesh: inside an octahedron
// Ends with status 0 if all are still inside, 1 if not, 2 if the mesh can't be used.
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include <pierce/pierce.h>
#include <Eigen/Geometry>

namespace {

using Vec3 = pierce::Vec3<double>;

pierce::TriangleSoup<double> octahedron() {
    return {.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            .triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
            .faces = {}};
}

/// Uniform in [0, 1). The distributions of the standard library differ from one implementation to the next.
double random_number(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Vec3 random_vector(std::mt19937_64& random) {
    const double x = random_number(random), y = random_number(random), z = random_number(random);
    return {x, y, z};
}

/// A way out of `point` crosses the surface an odd number of times if the point is inside. A way through an edge or a
/// vertex hits several faces at one crossing: then another is tried.
bool is_inside(const pierce::CollisionMesh<double>& mesh, const Vec3& point, double far_away, std::mt19937_64& random) {
    std::vector<pierce::Hit<double>> hits(64);
    for (int attempt = 0; attempt < 100; ++attempt) {
        const Vec3 way = (2 * random_vector(random) - Vec3::Ones()) * far_away;
        const auto count = mesh.all_hits({point, point + way}, hits, {.sides = pierce::Sides::both});
        if (count > hits.size()) {
            hits.resize(count);
            continue;
        }
        std::size_t crossings = 0;
        bool clear = way.norm() > far_away / 4;
        for (std::size_t i = 0; i < count; ++i) {
            clear = clear && hits[i].feature == pierce::Feature::face;
            crossings += !hits[i].at_start;
        }
        // A point on the inner side of a face may lie on its plane. To go in from there crosses nothing; to go out is a
        // hit where only backs count, for which on the plane is behind.
        const auto leaves = mesh.first_hit({point, point + way}, {.sides = pierce::Sides::back});
        if (leaves && leaves->at_start) {
            clear = clear && leaves->feature == pierce::Feature::face;
            ++crossings;
        }
        if (clear) return crossings % 2 == 1;
    }
    return false;
}

struct Particle {
    Vec3 position;
    Vec3 velocity;
};

/// Moves a particle by one step of time; true if it bounced. Inside a closed mesh all faces are seen from the back.
bool step(Particle& particle, const pierce::CollisionMesh<double>& mesh, const Vec3& gravity, double seconds) {
    particle.velocity += gravity * seconds;
    const Vec3 target = particle.position + particle.velocity * seconds;
    const auto hit = mesh.sweep({particle.position, target}, {.sides = pierce::Sides::back});
    if (!hit) {
        particle.position = target;
        return false;
    }
    particle.position = hit->point;
    particle.velocity -= 2 * hit->normal.dot(particle.velocity) * hit->normal;
    return true;
}

int run(const pierce::TriangleSoup<double>& soup) {
    const pierce::CollisionMesh<double> mesh(soup.view());
    Eigen::AlignedBox3d box;
    for (const Vec3& position : soup.positions) box.extend(position);
    const double size = box.diagonal().maxCoeff();

    constexpr int particle_count = 1000, step_count = 1000;
    std::mt19937_64 random(1);
    std::vector<Particle> particles;
    for (int attempt = 0; attempt < 1000 * particle_count && particles.size() < particle_count; ++attempt) {
        const Vec3 position = box.min() + random_vector(random).cwiseProduct(box.diagonal());
        if (is_inside(mesh, position, 8 * size, random))
            particles.push_back({position, size * (2 * random_vector(random) - Vec3::Ones())});
    }
    if (particles.size() < particle_count) {
        std::cerr << "particles: hardly a point is inside this mesh; is it closed?\n";
        return 2;
    }

    std::uint64_t bounces = 0;
    for (int i = 0; i < step_count; ++i)
        for (Particle& particle : particles) bounces += step(particle, mesh, Vec3(0, -size, 0), 0.01);

    int inside = 0;
    for (const Particle& particle : particles) inside += is_inside(mesh, particle.position, 8 * size, random);
    std::cout << inside << " of " << particle_count << " particles are still inside after " << step_count
              << " steps each and " << bounces << " bounces in all\n";
    return inside == particle_count ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
        std::cerr << "usage: particles [MESH]\nMESH: closed, OBJ, OFF, PLY or STL; without one: an octahedron.\n";
        return 2;
    }
    try {
        return run(argc > 1 ? pierce::read_mesh<double>(argv[1]) : octahedron());
    } catch (const pierce::MeshError& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
}
