// What it takes to follow a mesh whose vertices move: all ways on one thread, in turn on the same frames, by the time
// of the process. Embree's buffers get their positions outside of the time; pierce reads the caller's. Prints a table
// in milliseconds, and ratios of medians for the sphere of 100,000 triangles:
//   ratio embree.rebuild     Embree's low-quality rebuild / our rebuild
//   ratio embree.refit       Embree's refit / our refit
//   ratio ours.refit.part    our rebuild / our refit of the vertices of 1 % of the faces, all in one place
//   ratio ours.refit.spread  the same, of vertices that are spread over the mesh
//   deform_bench [FILE...]   meshes to add to the table
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <malloc.h>

#include <pierce/deforming_mesh.h>
#include <pierce/triangle_soup.h>
#include <support/meshes.h>
#include <support/random.h>

#include "embree_scene.h"

namespace pierce::bench {
namespace {

using Positions = std::vector<Vec3<float>>;

double milliseconds(const std::function<void()>& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

double median(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    return times[times.size() / 2];
}

Positions waving(const Positions& rest, float time) {
    Positions out;
    for (const Vec3<float>& p : rest) {
        const float wave = 0.05F * std::sin(7 * p[0] + time) * std::cos(5 * p[1] - time);
        out.push_back(p * (1 + wave) + Vec3<float>(0.01F * time, 0, wave));
    }
    return out;
}

/// The vertices of 1 % of the triangles: those nearest to a vertex, or any.
std::vector<std::uint32_t> some_vertices(const TriangleSoup<float>& soup, bool in_one_place) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < soup.positions.size(); ++v) order.push_back(v);
    test::Random random(3);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    const Vec3<float> center = soup.positions[order[0]];
    const auto far = [&](std::uint32_t v) { return (soup.positions[v] - center).squaredNorm(); };
    if (in_one_place) std::sort(order.begin(), order.end(), [&](auto x, auto y) { return far(x) < far(y); });
    std::vector<std::vector<std::uint32_t>> around(soup.positions.size());
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i)
        for (const std::uint32_t v : soup.triangles[i]) around[v].push_back(i);
    std::vector<bool> seen(soup.triangles.size());
    std::size_t faces = 0;
    std::vector<std::uint32_t> some;
    for (std::size_t i = 0; i < order.size() && faces < soup.triangles.size() / 100; ++i) {
        some.push_back(order[i]);
        for (const std::uint32_t t : around[order[i]])
            if (!seen[t]) seen[t] = true, ++faces;
    }
    return some;
}

bool embree_hits(const EmbreeScene& scene, const Segment<float>& way) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray;
    set_ray(ray, way.from, way.to - way.from);
    rtcOccluded1(scene.get(), &context, &ray);
    return ray.tfar < 0;
}

/// Stops where answers differ by more than what Embree's rounding may do.
void check(const CollisionMesh<float>& ours, const CollisionMesh<float>& other, const EmbreeScene& scene,
           const char* what) {
    test::Random random(9);
    int differ = 0;
    for (int i = 0; i < 2000; ++i) {
        const Segment<float> way{(2 * random.in_cube()).cast<float>(), (0.5 * random.in_cube()).cast<float>()};
        const bool hit = ours.any_hit(way, {.sides = Sides::both});
        differ += hit != embree_hits(scene, way) ? 1 : 0;
        if (hit != other.any_hit(way, {.sides = Sides::both})) differ += 1000;
    }
    if (differ <= 2) return;
    std::cerr << what << ": answers differ, " << differ << '\n';
    std::exit(1);
}

void measure(const TriangleSoup<float>& soup, const std::string& name, bool ratios) {
    const EmbreeDevice device("threads=1");
    const EmbreeScene low(device, soup.view(), {.flags = RTC_SCENE_FLAG_DYNAMIC, .quality = RTC_BUILD_QUALITY_LOW});
    const EmbreeScene refitted(device, soup.view(),
                               {.flags = RTC_SCENE_FLAG_DYNAMIC, .quality = RTC_BUILD_QUALITY_LOW, .refits = true});
    CollisionMesh<float> rebuilt(soup.view());
    CollisionMesh<float> refit(soup.view());
    CollisionMesh<float> part(soup.view());
    CollisionMesh<float> spread(soup.view());
    DeformingMesh<float> moving(soup.view());
    const std::vector<std::uint32_t> near = some_vertices(soup, true);
    const std::vector<std::uint32_t> far = some_vertices(soup, false);
    constexpr int k_ways = 8;
    std::vector<double> times[k_ways];
    constexpr int k_frames = 31;
    for (int frame = -3; frame < k_frames; ++frame) {
        const Positions at = waving(soup.positions, 0.1F * static_cast<float>(frame));
        low.place(at);
        refitted.place(at);
        const std::function<void()> ways[k_ways] = {[&] { low.rebuild(); },         [&] { rebuilt.rebuild(at); },
                                                    [&] { refitted.rebuild(); },    [&] { refit.refit(at); },
                                                    [&] { part.refit(at, near); },  [&] { spread.refit(at, far); },
                                                    [&] { moving.begin_step(at); }, [&] { (void)refit.refit_cost(); }};
        for (int way = 0; way < k_ways; ++way) {
            const double ms = milliseconds(ways[(way + frame + 8) % k_ways]);
            if (frame >= 0) times[(way + frame + 8) % k_ways].push_back(ms);  // the first ones only fetch the memory
        }
        if (frame % 10 == 0) {
            check(refit, rebuilt, low, "rebuild");
            check(refit, moving.step().after(), refitted, "refit");
        }
    }
    double ms[k_ways];
    for (int way = 0; way < k_ways; ++way) ms[way] = median(times[way]);
    std::cout << "| " << name << " | " << soup.triangles.size();
    for (const double x : ms) std::cout << " | " << x;
    std::cout << " | " << refit.refit_cost() << " |\n";
    if (!ratios) return;
    std::cout << "\nratio embree.rebuild " << ms[0] / ms[1] << "\nratio embree.refit " << ms[2] / ms[3]
              << "\nratio ours.refit.part " << ms[1] / ms[4] << "\nratio ours.refit.spread " << ms[1] / ms[5] << '\n';
}

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    using namespace pierce;
    // A game's memory: what was freed is there for the next frame, for all of them.
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
    std::cout.precision(3);
    std::cout
        << "| mesh | faces | Embree rebuild, ms | rebuild | Embree refit | refit | 1 % in one place | 1 % spread | "
           "begin_step | refit_cost | its value |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (int i = 1; i < argc; ++i) bench::measure(read_mesh<float>(argv[i]), argv[i], false);
    bench::measure(test::moved<float>(test::bumpy_sphere(112), 1, {0, 0, 0}), "sphere", true);
}
