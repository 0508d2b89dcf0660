#include "memory.h"

#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iostream>
#include <stdexcept>

#include "../embree_scene.h"
#include "broadphase.h"
#include "column.h"
#include "segment_sets.h"

namespace pierce::bench {

void measure_memory(const std::string& mesh, const MeshView<float>& view, Results& results) {
    const auto faces = static_cast<double>(view.triangles.size());
    const auto add = [&](std::string_view column, std::size_t bytes) {
        results.add(mesh, set_name::memory, column, static_cast<double>(bytes) / faces);
    };
    add(column::pierce, CollisionMesh<float>(view).statistics().bytes);
    add(column::grid, CollisionMesh<float>(view, grid_options()).statistics().bytes);
    const auto embree_bytes = [&](const EmbreeOptions& options) {
        const EmbreeDevice device("threads=1");
        const EmbreeScene scene(device, view, options);
        return device.bytes();  // its monitor counts the buffers of vertices and indices, too
    };
    add(column::embree, embree_bytes({.quality = RTC_BUILD_QUALITY_HIGH}));
    add(column::embree_low, embree_bytes({.quality = RTC_BUILD_QUALITY_LOW}));
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
                          << std::stod(line.substr(6)) * 1024 / 1e9 << " GB (the goal: 1.2)\n";  // it counts in KiB
        std::cout.flush();
        status = 0;
    } catch (const std::exception& error) {
        std::cerr << mesh.name << ": " << error.what() << '\n';
    }
    _exit(status);  // what the parent left to be done at the end is not the child's
}

}  // namespace pierce::bench
