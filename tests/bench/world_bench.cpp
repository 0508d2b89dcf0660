// What a query of a world costs by the number of its meshes, and a change; Embree's instances beside it.
//
// Each world is a cube full of the same mesh, turned at random, one in a unit of volume; segments are as long as the
// unit and lie in the cube: so what a query meets is the same in all of them, and what grows is the way to find it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <bench/embree_scene.h>
#include <pierce/world.h>
#include <support/meshes.h>

namespace pierce::bench {
namespace {

using test::Random;
using Vec = Vec3<float>;
/// Time of this thread alone, for both sides: what else runs on the machine should not matter.
struct Clock {
    static double now() {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
    }
};

double nanoseconds_since(double start) { return Clock::now() - start; }

Pose<float> random_pose(Random& random, double side) {
    Pose<float> pose;
    const Vec3<double> axis = random.direction();
    const double w = random.between(-1, 1);
    Eigen::Matrix3d cross;
    cross << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
    const double s = std::sqrt(1 - w * w);
    pose.rotation = (Eigen::Matrix3d::Identity() + s * cross + (1 - w) * cross * cross).cast<float>();
    pose.translation = (side / 2 * random.in_cube()).cast<float>();
    return pose;
}

struct EmbreeWorld {
    EmbreeWorld(const EmbreeDevice& device, const EmbreeScene& mesh, const std::vector<Pose<float>>& poses)
        : scene(rtcNewScene(device.get())) {
        for (const Pose<float>& pose : poses) {
            const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, mesh.get());
            float columns[12];
            for (int k = 0; k < 3; ++k) {
                for (int j = 0; j < 3; ++j) columns[3 * j + k] = pose.rotation(k, j);
                columns[9 + k] = pose.translation[k];
            }
            rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcCommitScene(scene);
    }
    ~EmbreeWorld() { rtcReleaseScene(scene); }
    EmbreeWorld(const EmbreeWorld&) = delete;
    EmbreeWorld& operator=(const EmbreeWorld&) = delete;

    RTCScene scene;
};

double median(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    return times[times.size() / 2];
}

struct Costs {
    double first = 0;
    double any = 0;
    double embree = 0;
    double nodes = 0;
    double add = 0;
    double remove = 0;
    double pose = 0;
};

Costs measure(std::size_t count, const EmbreeDevice& device, const TriangleSoup<float>& soup) {
    Random random(count);
    const auto mesh = std::make_shared<const CollisionMesh<float>>(soup.view());
    const EmbreeScene part(device, soup.view(), {});
    const double side = std::cbrt(static_cast<double>(count));
    std::vector<Pose<float>> poses;
    std::vector<MeshId> ids;
    World<float> world;
    for (std::size_t i = 0; i < count; ++i) {
        poses.push_back(random_pose(random, side));
        ids.push_back(world.add(mesh, {.pose = poses.back()}));
    }
    const EmbreeWorld embree(device, part, poses);
    std::vector<Segment<float>> segments;
    while (segments.size() < 20'000) {
        const Vec3<double> from = side / 2 * random.in_cube();
        const Vec3<double> to = from + random.direction();
        if (to.cwiseAbs().maxCoeff() > side / 2) continue;
        segments.push_back({from.cast<float>(), to.cast<float>()});
    }

    Costs costs;
    const WorldOptions both{.sides = Sides::both};
    std::size_t hits = 0;
    std::size_t differ = 0;
    QueryCounters counters;
    for (const Segment<float>& s : segments) {
        const auto hit = world.first_hit(s, {.sides = Sides::both, .counters = &counters});
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit ray;
        set_ray(ray, s.from, s.to - s.from);
        rtcIntersect1(embree.scene, &context, &ray);
        const unsigned other = ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? ~0U : ray.hit.instID[0];
        if (hit) ++hits;
        if ((hit ? hit->mesh.index : ~0U) != other) ++differ;
    }
    std::printf("%6zu meshes: %4.1f %% of segments hit, %zu of %zu answers differ from Embree's, depth %zu\n", count,
                100.0 * static_cast<double>(hits) / static_cast<double>(segments.size()), differ, segments.size(),
                world.statistics().depth);
    if (differ * 500 > segments.size()) std::exit(1);
    costs.nodes = static_cast<double>(counters.nodes) / static_cast<double>(segments.size());

    std::vector<double> first;
    std::vector<double> any;
    std::vector<double> theirs;
    std::size_t sum = 0;
    const auto each = static_cast<double>(segments.size());
    for (int repetition = 0; repetition < 9; ++repetition) {
        auto start = Clock::now();
        for (const Segment<float>& s : segments) sum += world.first_hit(s, both).has_value() ? 1U : 0U;
        first.push_back(nanoseconds_since(start) / each);
        start = Clock::now();
        for (const Segment<float>& s : segments) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRayHit ray;
            set_ray(ray, s.from, s.to - s.from);
            rtcIntersect1(embree.scene, &context, &ray);
            sum += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1U : 0U;
        }
        theirs.push_back(nanoseconds_since(start) / each);
        start = Clock::now();
        for (const Segment<float>& s : segments) sum += world.any_hit(s, both) ? 1U : 0U;
        any.push_back(nanoseconds_since(start) / each);
    }
    costs.first = median(first);
    costs.any = median(any);
    costs.embree = median(theirs);

    // Changes: of each kind one after the other, so many that the clock does not matter.
    constexpr std::size_t k_changes = 2000;
    std::vector<Pose<float>> others;
    for (std::size_t i = 0; i < k_changes; ++i) others.push_back(random_pose(random, side));
    std::vector<MeshId> more;
    auto start = Clock::now();
    for (const Pose<float>& pose : others) more.push_back(world.add(mesh, {.pose = pose}));
    costs.add = nanoseconds_since(start) / k_changes;
    start = Clock::now();
    for (const MeshId id : more) sum += world.remove(id) ? 1U : 0U;
    costs.remove = nanoseconds_since(start) / k_changes;
    start = Clock::now();
    for (const Pose<float>& pose : others) world.set_pose(ids[random.below(ids.size())], pose);
    costs.pose = nanoseconds_since(start) / k_changes;
    if (sum == 0) std::exit(1);
    return costs;
}

int run() {
    const EmbreeDevice device("threads=1");
    const TriangleSoup<float> soup = test::moved<float>(test::bumpy_sphere(16), 0.4, {0, 0, 0});
    std::vector<std::pair<std::size_t, Costs>> rows;
    for (const std::size_t count : {10U, 100U, 1000U, 10'000U}) rows.emplace_back(count, measure(count, device, soup));
    std::printf("\n%8s %10s %10s %12s %8s %10s %10s %10s\n", "meshes", "first ns", "any ns", "Embree first", "nodes",
                "add us", "remove us", "pose us");
    for (const auto& [count, c] : rows)
        std::printf("%8zu %10.0f %10.0f %12.0f %8.1f %10.2f %10.2f %10.2f\n", count, c.first, c.any, c.embree, c.nodes,
                    c.add / 1000, c.remove / 1000, c.pose / 1000);
    std::printf("\n");
    // From 10 meshes to 10,000 the logarithm is four times as large.
    std::printf("ratio world.log %.2f\n", 4 * rows.front().second.first / rows.back().second.first);
    for (const auto& [count, c] : rows) std::printf("ratio world.embree.%zu %.2f\n", count, c.embree / c.first);
    const Costs& thousand = rows[2].second;
    std::printf("ratio world.add %.1f\n", 20'000 / thousand.add);
    std::printf("ratio world.remove %.1f\n", 20'000 / thousand.remove);
    return 0;
}

}  // namespace
}  // namespace pierce::bench

int main() { return pierce::bench::run(); }
