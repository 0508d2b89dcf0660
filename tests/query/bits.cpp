// Prints one fingerprint of many answers, so that builds by different compilers and flags can be compared
// (tests/same_bits, tests/platforms/run).
//   bits [SHARE]      asks one in SHARE of the questions, for emulators, and has another fingerprint then
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <motion/moving.h>
#include <pierce/collision_mesh.h>
#include <pierce/deforming_mesh.h>
#include <pierce/motion.h>
#include <pierce/regions.h>
#include <pierce/response.h>
#include <pierce/world.h>
#include <support/hash.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

int share = 1;

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

// Three steps each: the first one runs into something, the others go on from there. `on`: a mesh or a step.
template <class On, class Scalar>
void add_moves(Hash& hash, const On& on, const std::vector<Segment<Scalar>>& segments, std::size_t every,
               Scalar radius = 0) {
    MoveOptions<Scalar> options{.query = {.sides = Sides::both},
                                .response = {.restitution = Scalar(0.5), .friction = Scalar(0.25)}};
    options.radius = radius;
    for (std::size_t i = 0; i < segments.size(); i += every) {
        Move<Scalar> move{};
        move.position = segments[i].from;
        move.velocity = segments[i].to - segments[i].from;
        const Vec3<Scalar> push = move.velocity / 4;
        for (int step = 0; step < 3; ++step) {
            const Vec3<Scalar> velocity = step == 0 ? move.velocity : Vec3<Scalar>(move.velocity + push);
            move = i % (2 * every) == 0 ? move_and_slide(on, move.position, velocity, Scalar(1), options)
                                        : move_and_bounce(on, move.position, velocity, Scalar(1), options);
            for (int k = 0; k < 3; ++k) {
                hash.add(bits(move.position[k]));
                hash.add(bits(move.velocity[k]));
                hash.add(bits(move.remainder[k]));
            }
            hash.add(move.contacts);
            hash.add(static_cast<std::uint64_t>(move.state));
        }
    }
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
    for (int i = 0; i < count / share; ++i) {
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
        if (i % 40 == 0) add_spheres(hash, mesh, segment, static_cast<Scalar>(scale * (beyond < 0.5 ? 0.01 : 0.3)));
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
    add_moves(hash, mesh, segments, 10);
    add_moves(hash, mesh, segments, 50, static_cast<Scalar>(scale * 0x1p-5));
    for (const auto& hit : first)
        if (hit) hash.add(*hit);
    for (const std::uint8_t hit : any) hash.add(hit);

    // A step in which vertices move, some of them much.
    std::vector<Vec3<Scalar>> after = soup.positions;
    for (std::size_t v = 0; v < after.size(); ++v) {
        const Vec3<double> by = scale * 0x1p-5 * random.in_cube();
        if (v % 7 != 0) after[v] += by.cast<Scalar>();
    }
    DeformingMesh<Scalar> moving(soup.view());
    moving.begin_step(after);
    const DeformationStep<Scalar> step = moving.step();
    add_moves(hash, step, segments, 50);
    for (std::size_t i = 0; i < segments.size(); i += 20) {
        if (const auto hit = step.after().first_hit(segments[i])) hash.add(*hit);
        const auto hit = step.sweep(segments[i], {.sides = Sides::both});
        if (!hit) continue;
        hash.add(hit->triangle);
        hash.add(std::bit_cast<Whole>(hit->time));
        for (const auto& x : {hit->place, hit->position, hit->normal, hit->barycentric, hit->surface_motion})
            for (int k = 0; k < 3; ++k) hash.add(std::bit_cast<Whole>(x[k]));
    }
}

// The mesh moved straight, and turned by a small quaternion, while points go by.
template <class Scalar>
void add_motions(Hash& hash, const TriangleSoup<double>& unit, double offset, int count = 1'000) {
    using Whole = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    const auto add = [&hash](const Coordinates<Scalar>& x) {
        for (int k = 0; k < 3; ++k) hash.add(std::bit_cast<Whole>(x[k]));
    };
    Random random(29);
    Pose<double> before;
    Pose<double> after;
    before.translation = after.translation = Vec3<double>(offset, -offset, offset);
    after.rotation << 12, -3, 4, 4, 12, -3, -3, 4, 12;  // a rotation but for its last bits, once it is divided
    after.rotation /= 13;
    const RigidMotion motion(before, after, 1e-3, Vec3<double>(0.5, 0.25, 0));
    for (int i = 0; i < count / share; ++i) {
        const Vec3<double> from = 3 * random.in_cube() + before.translation;
        const Vec3<double> to = 3 * random.in_cube() + before.translation;
        const Vec3<double> start = random.in_cube() + before.translation;
        const Vec3<double> end = random.in_cube() + before.translation;
        const Segment<Scalar> way{from.template cast<Scalar>(), to.template cast<Scalar>()};
        const Translation<Scalar> shift{start.template cast<Scalar>(), end.template cast<Scalar>()};
        if (const auto hit = mesh.sweep(way, shift, {.sides = Sides::both})) {
            hash.add(hit->triangle);
            hash.add(std::bit_cast<Whole>(hit->time));
            for (const auto& x : {hit->place, hit->position, hit->normal, hit->barycentric}) add(x);
        }
        if (const auto hit = mesh.sweep(way, motion, {.sides = Sides::both})) {
            hash.add(hit->triangle);
            hash.add(std::bit_cast<Whole>(hit->time));
            for (const auto& x : {hit->place, hit->local, hit->position, hit->normal, hit->surface_motion}) add(x);
        }
    }
}

// The mesh many times, turned by small quaternions (no sines) and as it is.
template <class Scalar>
void add_worlds(Hash& hash, const TriangleSoup<double>& unit, double offset, int count = 800) {
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, 1, {0, 0, 0});
    const auto mesh = std::make_shared<const CollisionMesh<Scalar>>(soup.view());
    Random random(23);
    World<Scalar> world;
    std::vector<MeshId> ids;
    for (int i = 0; i < 40; ++i) {
        InstanceOptions<Scalar> options;
        const double w = 1 + random.between_ints(0, 4);
        const double x = random.between_ints(-4, 4);
        const double y = random.between_ints(-4, 4);
        const double z = random.between_ints(-4, 4);
        const double n = w * w + x * x + y * y + z * z;
        Eigen::Matrix3d r;
        r << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
            2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
            2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
        if (i % 4 != 0) options.pose.rotation = (r / n).template cast<Scalar>();
        const Vec3<double> shift = 4 * random.in_cube() + Vec3<double>(offset, -offset, offset);
        if (i % 5 != 0) options.pose.translation = shift.template cast<Scalar>();
        ids.push_back(world.add(mesh, options));
    }
    std::array<WorldHit<Scalar>, 4> hits;
    const auto add = [&hash](const WorldHit<Scalar>& hit) {
        hash.add(hit.mesh.index);
        hash.add(hit.hit);
    };
    for (int i = 0; i < count / share; ++i) {
        if (i % 40 == 0) {
            InstanceOptions<Scalar> options;
            const Vec3<double> shift = 4 * random.in_cube() + Vec3<double>(offset, -offset, offset);
            options.pose.translation = shift.template cast<Scalar>();
            world.set_pose(ids[random.below(ids.size())], options.pose);
        }
        const Vec3<double> from = 5 * random.in_cube() + Vec3<double>(offset, -offset, offset);
        const Vec3<double> to = 5 * random.in_cube() + Vec3<double>(offset, -offset, offset);
        const Segment<Scalar> segment{from.template cast<Scalar>(), to.template cast<Scalar>()};
        const std::size_t total = world.all_hits(segment, hits, {.sides = Sides::both});
        hash.add(total);
        for (std::size_t k = 0; k < std::min(total, hits.size()); ++k) add(hits[k]);
        if (const auto hit = world.first_hit(segment)) add(*hit);
        const Ray<Scalar> ray{segment.from, segment.to - segment.from};
        if (const auto hit = world.first_hit(ray, {.sides = Sides::both})) add(*hit);
        hash.add(static_cast<std::uint64_t>(world.crossings(segment)));
        hash.add(static_cast<std::uint64_t>(world.crossings(ray)));
        hash.add(static_cast<std::uint64_t>(world.winding_number(segment.to)));
        if (i % 8 != 0) continue;
        const auto add_number = [&hash](Scalar x) {
            hash.add(std::bit_cast<std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>>(x));
        };
        std::array<WorldPassage<Scalar>, 6> passages;
        const std::size_t met = world.passages(segment, passages);
        hash.add(met);
        for (std::size_t k = 0; k < std::min(met, passages.size()); ++k) {
            hash.add(passages[k].mesh.index);
            hash.add(passages[k].passage.triangle);
            hash.add(passages[k].passage.first_face);
            add_number(passages[k].passage.fraction);
            for (int j = 0; j < 3; ++j) add_number(passages[k].passage.position[j]);
        }
        hash.add(world.locate(segment.from).face_count);
        hash.add(world.containing(segment.from, {}));
        const Segment<Scalar> step{segment.from, segment.from + ray.direction / 8};
        if (const auto hit = world.sweep_sphere(step, Scalar(0.1))) {
            hash.add(hit->mesh.index);
            hash.add(hit->hit.triangle);
            add_number(hit->hit.fraction);
            add_number(hit->hit.overlap);
            for (int j = 0; j < 3; ++j) add_number(hit->hit.center[j]);
            for (int j = 0; j < 3; ++j) add_number(hit->hit.normal[j]);
        }
        hash.add(world.sphere_contacts(segment.from, Scalar(0.5), {}));
    }
}

// Moving points and triangles, many of which touch.
void add_impacts(Hash& hash, double scale, int digits) {
    Random random(9);
    for (int i = 0; i < 2'000 / share; ++i) {
        detail::MovingPoint point;
        detail::MovingTriangle triangle;
        const double grain = std::ldexp(1.0, digits);
        const auto place = [&](detail::Point& p) {
            for (double& x : p) x = std::round((2 * random.unit() - 1) * grain) / grain * scale;
        };
        for (int k = 0; k < 2; ++k) {
            place(point.at[k]);
            for (detail::Point& corner : triangle.at[k]) place(corner);
        }
        const auto contact = static_cast<detail::ContactRule>(i % 4);
        const detail::Impact impact = detail::first_contact(point, triangle, contact);
        hash.add(impact.hit ? 1 : 0);
        if (!impact.hit) continue;
        hash.add(std::uint64_t(impact.side));
        hash.add(std::uint64_t(impact.feature) * 4 + impact.feature_index);
        hash.add(std::bit_cast<std::uint64_t>(impact.earliest));
        hash.add(std::bit_cast<std::uint64_t>(impact.latest));
    }
}

}  // namespace
}  // namespace pierce::test

int main(int count, char** arguments) {
    using namespace pierce::test;
    if (count > 1) share = std::max(1, std::atoi(arguments[1]));
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
    for (const double offset : {0.0, 1e3, 1e6}) {
        add_worlds<float>(hash, polycube(2, 0.6, 1, 3), offset);
        add_worlds<double>(hash, polycube(2, 0.6, 1, 3), offset);
        add_worlds<float>(hash, terrain(8, 0.3, 4), offset);
        add_worlds<double>(hash, terrain(8, 0.3, 4), offset);
        add_motions<float>(hash, polycube(3, 0.5, 1, 5), offset);
        add_motions<double>(hash, terrain(8, 0.3, 4), offset);
    }
    for (const double scale : {1e-100, 1.0, 1e80})
        for (const int digits : {1, 3, 30}) add_impacts(hash, scale, digits);
    std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
}
