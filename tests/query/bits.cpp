// Prints one fingerprint of many answers, so that builds by different compilers and flags can be compared (tests/same_bits).
#include <cstdio>

#include <pierce/collision_mesh.h>
#include <support/hash.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

template <class Scalar>
void add_answers(Hash& hash, const TriangleSoup<double>& unit, double scale, double offset) {
    // Made in double and rounded once; sines and the like are kept out of it, as they differ between C libraries.
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, scale, {offset, -offset, offset});
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(17);
    std::array<Hit<Scalar>, 4> hits;
    for (int i = 0; i < 20'000; ++i) {
        const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
        const Vec3<double> w = random.chance(0.3) ? Vec3<double>(0.5, 0.5, 0) : random.weights();
        Vec3<double> target = Vec3<double>::Zero();
        for (int k = 0; k < 3; ++k)
            target += w[k] * soup.positions[t[static_cast<std::size_t>(k)]].template cast<double>();
        // One random number a statement: compilers differ in the order of operands.
        const double length = scale * (random.chance(0.5) ? 0.01 : 3);
        const Vec3<double> d = length * random.in_cube();
        const double beyond = random.unit();
        const Segment<Scalar> segment{(target - d).template cast<Scalar>(), (target + beyond * d).template cast<Scalar>()};
        const std::size_t total = mesh.all_hits(segment, hits, {.sides = Sides::both});
        hash.add(total);
        for (std::size_t k = 0; k < std::min(total, hits.size()); ++k) hash.add(hits[k]);
        if (const auto hit = mesh.first_hit(segment)) hash.add(*hit);
        hash.add(static_cast<std::uint64_t>(mesh.crossings(segment)));
        hash.add(mesh.contains(segment.from) ? 1 : 0);
    }
}

}  // namespace
}  // namespace pierce::test

int main() {
    using namespace pierce::test;
    Hash hash;
    for (const double offset : {0.0, 1e3, 1e6}) {
        add_answers<float>(hash, polycube(4, 0.5, 2, 1), 1, offset);
        add_answers<double>(hash, polycube(4, 0.5, 2, 2), 0.1, offset);
        add_answers<float>(hash, terrain(40, 0.1, 3), 100, offset);
        add_answers<double>(hash, terrain(40, 0.1, 3), 1e-3, offset);
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
}
