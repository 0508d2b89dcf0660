// Queries, one at a time and in batches, allocate nothing. An executable of its own: it counts every call of operator
// new.
#include <atomic>
#include <cstdio>

#include <pierce/deforming_mesh.h>
#include <pierce/regions.h>
#include <pierce/response.h>
#include <pierce/world.h>
#include <query/batch_world.h>
#include <support/executors.h>
#include <support/own_new.h>

namespace pierce::test {
namespace {

std::atomic<std::size_t> allocations = 0;

bool failed = false;

template <class Call>
void expect_none(const char* what, Call&& call) {
    call();  // what a first call keeps for later ones is no business of this test
    const std::size_t before = allocations;
    call();
    if (allocations == before) return;
    std::printf("%s: %zu allocations\n", what, allocations - before);
    failed = true;
}

template <class Scalar>
void check() {
    const TriangleSoup<Scalar> soup = lattice_and_shards<Scalar>();
    const CollisionMesh<Scalar> mesh(soup.view());
    const std::vector<Segment<Scalar>> segments = batch_segments(soup.view(), 5000, 1);
    const auto count = static_cast<Eigen::Index>(segments.size());
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> state(7, count);
    for (Eigen::Index i = 0; i < count; ++i)
        state.col(i) << segments[static_cast<std::size_t>(i)].from, segments[static_cast<std::size_t>(i)].to, 0;
    std::vector<std::optional<Hit<Scalar>>> hits(segments.size());
    std::vector<Hit<Scalar>> plain(segments.size());
    std::vector<Scalar> fractions(segments.size());
    const HitArrays<Scalar> arrays{.count = segments.size(), .fraction = fractions.data()};
    std::vector<std::uint8_t> any(segments.size());
    const Reversed reversed;
    QueryCounters counters;
    QueryOptions options;
    options.counters = &counters;
    options.sides = Sides::both;
    const auto accept = [](const Contact& contact) { return contact.face % 5 != 0; };
    options.accept = accept;

    expect_none("first_hits", [&] { mesh.first_hits(segments, hits); });
    expect_none("first_hits with options", [&] { mesh.first_hits(segments, hits, options, reversed); });
    expect_none("any_hits", [&] { mesh.any_hits(segments, any, options, reversed); });
    expect_none("first_hits of blocks", [&] {
        mesh.first_hits({state.topRows(3), state.middleRows(3, 3)}, hits, options, reversed);
    });
    std::vector<std::optional<SphereHit<Scalar>>> balls(segments.size());
    std::array<SphereHit<Scalar>, 4> contacts;
    expect_none("sweep_spheres", [&] { mesh.sweep_spheres(segments, Scalar(0.01), balls, {}, reversed); });
    expect_none("spheres", [&] {
        for (const Segment<Scalar>& segment : segments) {
            mesh.sphere_hits(segment, Scalar(0.01), contacts);
            mesh.sphere_contacts(segment.from, Scalar(0.01), contacts);
        }
    });
    expect_none("sweeps to plain hits", [&] { mesh.sweeps(segments, plain, options, reversed); });
    expect_none("first_hits to arrays", [&] { mesh.first_hits(segments, arrays, options, reversed); });
    DeformingMesh<Scalar> moving(soup.view());
    std::vector<Vec3<Scalar>> after = soup.positions;
    for (std::size_t v = 0; v < after.size(); v += 2) after[v] += Vec3<Scalar>::Constant(Scalar(0.125));
    moving.begin_step(after);
    std::vector<std::optional<SweepHit<Scalar>>> sweep_hits(segments.size());
    expect_none("sweeps over a step", [&] {
        moving.sweeps(segments, sweep_hits, options, reversed);
        for (std::size_t i = 0; i < segments.size(); i += 50) sweep_hits[i] = moving.sweep(segments[i]);
    });
    std::array<Hit<Scalar>, 8> all;
    expect_none("single calls", [&] {
        for (std::size_t i = 0; i < segments.size(); i += 5) {
            hits[i] = mesh.first_hit(segments[i], options);
            any[i] =
                mesh.any_hit(segments[i]) && mesh.all_hits(segments[i], all) > 0 && mesh.crossings(segments[i]) != 0
                    ? 1
                    : 0;
        }
    });
    World<Scalar> world;
    for (int i = 0; i < 20; ++i) {
        InstanceOptions<Scalar> where;
        where.pose.translation = Vec3<Scalar>::Constant(static_cast<Scalar>(i));
        if (i % 2 != 0) where.pose.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
        (void)world.add(std::make_shared<const CollisionMesh<Scalar>>(soup.view()), where);
    }
    std::vector<WorldHit<Scalar>> world_hits(segments.size());
    std::array<WorldHit<Scalar>, 8> world_all;
    const WorldOptions world_options{.sides = Sides::both};
    expect_none("queries of a world", [&] {
        world.first_hits(segments, world_hits, world_options, reversed);
        world.any_hits(segments, any, world_options, reversed);
        for (std::size_t i = 0; i < segments.size(); i += 25)
            any[i] =
                world.all_hits(segments[i], world_all, world_options) > 3 && world.contains(segments[i].to) ? 1 : 0;
        std::array<WorldPassage<Scalar>, 8> world_passages;
        std::array<WorldSphereHit<Scalar>, 8> world_contacts;
        std::array<WorldTouch, 8> world_touches;
        std::array<MeshId, 8> world_meshes;
        for (std::size_t i = 0; i < segments.size(); i += 25) {
            const std::size_t found = world.passages(segments[i], world_passages) +
                                      world.locate(segments[i].to, world_touches).face_count +
                                      world.containing(segments[i].to, world_meshes) +
                                      world.sphere_hits(segments[i], Scalar(0.1), world_contacts) +
                                      std::size_t{world.sweep_sphere(segments[i], Scalar(0.1)).has_value()};
            any[i] = found > 3 ? 1 : 0;
        }
        for (std::size_t i = 0; i < 20; ++i) world.set_pose({static_cast<std::uint32_t>(i), 1}, {});
    });
    std::vector<Vec3<Scalar>> points;
    for (const Segment<Scalar>& segment : segments) points.push_back(segment.to);
    std::vector<Location> places(points.size());
    std::vector<int> counts(points.size());
    std::vector<std::size_t> offsets(segments.size() + 1);
    std::vector<Hit<Scalar>> rows(mesh.all_hits(segments, offsets, {}));
    std::array<Passage<Scalar>, 8> passages;
    std::array<FaceTouch, 32> touches;
    expect_none("locate_points and crossings", [&] {
        mesh.locate_points(points, places, nullptr, reversed);
        mesh.crossings(segments, counts, nullptr, reversed);
    });
    expect_none("few points", [&] {
        mesh.contains_points(std::span(points).first(4000), std::span(any).first(4000), nullptr, reversed);
        mesh.winding_numbers(std::span(points).first(4000), std::span(counts).first(4000), nullptr, reversed);
    });
    expect_none("all_hits in rows", [&] { mesh.all_hits(segments, offsets, rows, options, reversed); });
    expect_none("locate and passages", [&] {
        for (std::size_t i = 0; i < segments.size(); i += 5) {
            places[i] = mesh.locate(points[i], touches);
            counts[i] = static_cast<int>(mesh.passages(segments[i], passages, {.accept = accept}, touches));
        }
    });
    const std::vector<FaceRegions> labels(mesh.statistics().faces, {1, 2});
    const Regions<Scalar> regions(mesh, labels);
    std::array<Leg<Scalar>, 8> legs;
    std::uint32_t sum = 0;
    expect_none("walks", [&] {
        for (std::size_t i = 0; i < segments.size(); i += 5) {
            sum += regions.region_at(segments[i].to);
            if (regions.walk(segments[i], legs) > 0)
                sum += regions.cross(segments[i], legs[0]).region + regions.stop(segments[i], legs[0]).region;
        }
    });
    std::vector<Move<Scalar>> moves(segments.size());
    std::vector<MoveContact<Scalar>> met(2 * segments.size());
    expect_none("moves", [&] {
        moves_and_slide(mesh, points, points, Scalar(1), moves, {}, reversed, met);
        moves_and_bounce(mesh, points, points, Scalar(1), moves, {.response = {.restitution = 1}}, reversed, met);
    });
    if (sum == 0 || counters.exact_decisions == 0) {
        std::puts("nothing was decided exactly");
        failed = true;
    }
}

}  // namespace

void before_new() { ++allocations; }

}  // namespace pierce::test

int main() {
    pierce::test::check<float>();
    pierce::test::check<double>();
    return pierce::test::failed ? 1 : 0;
}
