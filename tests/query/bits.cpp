// Prints one fingerprint of many answers, so that builds by different compilers and flags can be compared
// (tests/same_bits).
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <pierce/collision_mesh.h>
#include <pierce/regions.h>
#include <support/hash.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

// Triangles of all sizes and shapes. One random number a statement: compilers differ in the order of operands.
TriangleSoup<double> splinters(std::uint32_t count, std::uint64_t seed) {
    Random random(seed);
    TriangleSoup<double> soup;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3<double> a = random.in_cube();
        const double size = std::ldexp(1.0, -static_cast<int>(random.below(12)));
        const double thin = random.chance(0.3) ? 1e-6 : 1;
        const Vec3<double> along = size * random.direction();
        const Vec3<double> across = thin * size * random.direction();
        const double part = random.unit();
        add_triangle(soup, a, a + along, a + part * along + across);
    }
    return soup;
}

template <class Scalar>
void add_sphere(Hash& hash, const SphereHit<Scalar>& hit) {
    std::array<std::uint32_t, sizeof hit / 4> words;
    std::memcpy(words.data(), &hit, sizeof hit);
    for (const std::uint32_t word : words) hash.add(word);
}

template <class Scalar>
void add_spheres(Hash& hash, const CollisionMesh<Scalar>& mesh, const Segment<Scalar>& step, Scalar radius) {
    if (const auto hit = mesh.sweep_sphere(step, radius)) add_sphere(hash, *hit);
    std::array<SphereHit<Scalar>, 4> contacts;
    const std::size_t touching = mesh.sphere_contacts(step.to, radius, contacts);
    hash.add(touching);
    for (std::size_t k = 0; k < std::min(touching, contacts.size()); ++k) add_sphere(hash, contacts[k]);
    const std::size_t hits = mesh.sphere_hits(step, radius, contacts);
    hash.add(hits);
    for (std::size_t k = 0; k < std::min(hits, contacts.size()); ++k) add_sphere(hash, contacts[k]);
}

template <class Scalar>
void add_answers(Hash& hash, const TriangleSoup<double>& unit, double scale, double offset, int count = 20'000) {
    // Made in double and rounded once; sines and the like are kept out of it, as they differ between C libraries.
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, scale, {offset, -offset, offset});
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(17);
    using Whole = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
    std::array<Hit<Scalar>, 4> hits;
    std::vector<Segment<Scalar>> segments;
    for (int i = 0; i < count; ++i) {
        const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
        const Vec3<double> w = random.chance(0.3) ? Vec3<double>(0.5, 0.5, 0) : random.weights();
        Vec3<double> target = Vec3<double>::Zero();
        for (int k = 0; k < 3; ++k)
            target += w[k] * soup.positions[t[static_cast<std::size_t>(k)]].template cast<double>();
        const double length = scale * (random.chance(0.5) ? 0.01 : 3);
        const Vec3<double> d = length * random.in_cube();
        const double beyond = random.unit();
        const Segment<Scalar> segment{(target - d).template cast<Scalar>(),
                                      (target + beyond * d).template cast<Scalar>()};
        segments.push_back(segment);
        const std::size_t total = mesh.all_hits(segment, hits, {.sides = Sides::both});
        hash.add(total);
        for (std::size_t k = 0; k < std::min(total, hits.size()); ++k) hash.add(hits[k]);
        if (const auto hit = mesh.first_hit(segment)) hash.add(*hit);
        hash.add(static_cast<std::uint64_t>(mesh.crossings(segment)));
        hash.add(mesh.contains(segment.from) ? 1 : 0);
        const Ray<Scalar> ray{segment.from, segment.to - segment.from};
        if (const auto hit = mesh.first_hit(ray, {.sides = Sides::both})) hash.add(*hit);
        hash.add(static_cast<std::uint64_t>(mesh.crossings(ray)));
        std::array<Passage<Scalar>, 4> passages;
        const std::size_t places = mesh.passages(segment, passages);
        hash.add(places);
        for (std::size_t k = 0; k < std::min(places, passages.size()); ++k) {
            hash.add(static_cast<std::uint64_t>(passages[k].crossings));
            hash.add(passages[k].face_count);
            hash.add(std::bit_cast<Whole>(passages[k].fraction));
        }
        if (i % 4 == 0) add_spheres(hash, mesh, segment, static_cast<Scalar>(scale * (beyond < 0.5 ? 0.01 : 0.3)));
        hash.add(static_cast<std::uint64_t>(mesh.locate(soup.positions[t[0]]).face_count));
    }
    std::vector<FaceRegions> labels;
    for (std::uint32_t face = 0; face < soup.triangles.size(); ++face) labels.push_back({face % 7, face % 5});
    const Regions<Scalar> regions(mesh, labels);
    std::array<Leg<Scalar>, 8> legs;
    for (std::size_t i = 0; i < segments.size(); i += 10) {
        const std::size_t legs_written = regions.walk(segments[i], legs);
        for (std::size_t k = 0; k < legs_written; ++k) {
            hash.add(legs[k].region);
            hash.add(std::bit_cast<Whole>(legs[k].exit));
        }
        hash.add(regions.region_at(segments[i].to));
    }
    std::vector<std::optional<Hit<Scalar>>> first(segments.size());
    std::vector<std::uint8_t> any(segments.size());
    hash.add(mesh.first_hits(segments, first, {.sides = Sides::back}));
    hash.add(mesh.any_hits(segments, any));
    for (const auto& hit : first)
        if (hit) hash.add(*hit);
    for (const std::uint8_t hit : any) hash.add(hit);
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
    // Both ends of the number range, where exact arithmetic decides nearly everything, and triangles of all shapes.
    for (const double scale : {1e-40, 1e-36, 1e36}) add_answers<float>(hash, splinters(300, 5), scale, 0, 2000);
    for (const double scale : {1e-310, 1e-290, 1e290}) add_answers<double>(hash, splinters(300, 6), scale, 0, 2000);
    for (const double offset : {0.0, 1e4}) {
        add_answers<float>(hash, splinters(2000, 7), 1, offset);
        add_answers<double>(hash, splinters(2000, 8), 1, offset);
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
}
