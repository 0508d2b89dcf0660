#include "builds.h"

#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iostream>
#include <stdexcept>

#include "../embree_scene.h"
#include "threads.h"
#include "segment_sets.h"

namespace pierce::bench {
namespace {

bool embree_hits(const EmbreeScene& scene, const Segment<float>& segment) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray;
    set_ray(ray, segment.from, segment.to - segment.from);
    rtcIntersect1(scene.get(), &context, &ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

struct Milliseconds {
    double process;
    double wall;
};

template <class Work>
Milliseconds time_of(Work&& work) {
    const double wall = seconds_now(Clock::wall);
    const double process = seconds_now(Clock::process);
    work();
    return {1e3 * (seconds_now(Clock::process) - process), 1e3 * (seconds_now(Clock::wall) - wall)};
}

std::size_t g_hits = 0;

constexpr EmbreeOptions k_low = {.quality = RTC_BUILD_QUALITY_LOW};
constexpr EmbreeOptions k_high = {.quality = RTC_BUILD_QUALITY_HIGH};

}  // namespace

void measure_builds(const std::string& mesh, const MeshView<float>& view, int repetitions, Results& results) {
    const Segment<float> segment = make_segments(SegmentSet::medium, view, 1)[0];
    // The objects outlive the measurement: to take them down is not part of a build.
    std::optional<CollisionMesh<float>> ours;
    const Threads one(1);
    const auto build_ours = [&](const Threads& threads) {
        ours.reset();
        return time_of([&] {
            ours.emplace(build(view, threads));
            g_hits += ours->first_hit(segment) ? 1U : 0U;
        });
    };
    const auto add = [&](std::string_view set, std::string_view column, double ms) {
        results.add(mesh, set, column, ms);
    };
    const EmbreeDevice device("threads=1");
    // If Embree used more than the one thread that it may, the time of the process would say so.
    const auto build_embree = [&](std::optional<EmbreeScene>& scene, const EmbreeOptions& options) {
        return time_of([&] {
                   scene.emplace(device, view, options);
                   g_hits += embree_hits(*scene, segment) ? 1U : 0U;
               })
            .process;
    };
    for (int r = 0; r < repetitions; ++r) {
        const Milliseconds alone = build_ours(one);
        add(set_name::build, column::pierce, alone.process);
        add(set_name::thread_build, column::pierce, alone.wall);
        {
            const Threads two(2);  // gone before Embree's turn, as threads that look for work take time of the process
            add(set_name::thread_build, column::pierce_two_threads, build_ours(two).wall);
        }
        std::optional<EmbreeScene> low;
        add(set_name::build, column::embree_low, build_embree(low, k_low));
        add(set_name::build, column::embree_low_again, time_of([&] {
                                                           low->rebuild();
                                                           g_hits += embree_hits(*low, segment) ? 1U : 0U;
                                                       }).process);
        if (r > 0) continue;  // slow, and for the table only
        std::optional<EmbreeScene> high;
        add(set_name::build, column::embree, build_embree(high, k_high));
    }
}

void measure_memory(const std::string& mesh, const MeshView<float>& view, Results& results) {
    const auto faces = static_cast<double>(view.triangles.size());
    const auto add = [&](std::string_view column, std::size_t bytes) {
        results.add(mesh, set_name::memory, column, static_cast<double>(bytes) / faces);
    };
    add(column::pierce, CollisionMesh<float>(view).statistics().bytes);
    const auto embree_bytes = [&](const EmbreeOptions& options) {
        const EmbreeDevice device("threads=1");
        const EmbreeScene scene(device, view, options);
        return device.bytes();  // its monitor counts the buffers of vertices and indices, too
    };
    add(column::embree, embree_bytes(k_high));
    add(column::embree_low, embree_bytes(k_low));
}

void measure_threads(const std::string& mesh, const MeshView<float>& view, const Effort& effort, Results& results) {
    const auto built = std::make_shared<const CollisionMesh<float>>(view);
    Columns columns;
    columns.push_back(pierce_batch_column(column::pierce_batch, built, 1));
    columns.push_back(pierce_batch_column(column::pierce_two_threads, built, 2));
    const auto segments = make_segments(SegmentSet::short_1, view, effort.segments);
    for (const auto& c : columns) c->prepare(segments);
    const std::array both = {columns[0].get(), columns[1].get()};
    Effort longer = effort;
    longer.seconds *= 4;  // what starts threads takes its time, and other programs want the processors, too
    measure(both, longer, Clock::wall,
            [&](std::string_view column, double ns) { results.add(mesh, set_name::threads, column, ns); });
}

void measure_peak(const BenchMesh& mesh) {
    std::cout.flush();
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("can't fork");
    if (child > 0) {
        int status = 0;
        waitpid(child, &status, 0);
        if (status != 0) throw std::runtime_error(mesh.name + " could not be built in a process of its own");
        return;
    }
    int status = 1;
    try {
        const TriangleSoup<float> soup = mesh.load();
        const auto segments = make_segments(SegmentSet::short_1, soup.view(), 10'000);
        std::ofstream("/proc/self/clear_refs") << "5\n";  // from here on the peak is that of the build
        const CollisionMesh<float> ours(soup.view());
        std::size_t hits = 0;
        for (const Segment<float>& s : segments) hits += ours.first_hit(s) ? 1U : 0U;
        std::ifstream in("/proc/self/status");
        for (std::string line; std::getline(in, line);)
            if (line.starts_with("VmHWM:"))
                std::cout << mesh.name << ": " << soup.triangles.size() << " faces, " << hits
                          << " of 10,000 short segments hit; most memory held from the build on, with the mesh itself: "
                          << line.substr(6) << '\n';
        std::cout.flush();
        status = 0;
    } catch (const std::exception& error) {
        std::cerr << mesh.name << ": " << error.what() << '\n';
    }
    _exit(status);  // what the parent left to be done at the end is not the child's
}

}  // namespace pierce::bench
