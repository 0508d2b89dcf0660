#include "builds.h"

#include <functional>

#include <malloc.h>

#include "../embree_scene.h"
#include "broadphase.h"
#include "segment_sets.h"
#include "threads.h"

namespace pierce::bench {
namespace {

/// Large blocks come from the system and go back to it: glibc's values for a new program, which it would otherwise
/// adapt.
void use_fresh_memory() {
    constexpr int k_large = 128 * 1024;
    mallopt(M_MMAP_MAX, 65536);
    mallopt(M_MMAP_THRESHOLD, k_large);
    mallopt(M_TRIM_THRESHOLD, k_large);
    malloc_trim(0);
}

/// As long as it lives, malloc returns nothing to the system, large blocks included: the next build finds its pages.
class KeptMemory {
  public:
    KeptMemory() {
        mallopt(M_MMAP_MAX, 0);
        mallopt(M_TRIM_THRESHOLD, -1);
    }
    ~KeptMemory() { use_fresh_memory(); }
    KeptMemory(const KeptMemory&) = delete;
    KeptMemory& operator=(const KeptMemory&) = delete;
};

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

/// Each build is timed to its first answer. What was built before is taken down outside of the time, or outlives it.
class Builder {
  public:
    explicit Builder(const MeshView<float>& view)
        : view_(view), segment_(make_segments(SegmentSet::medium, view, 1)[0]) {}

    Milliseconds ours(const BuildOptions& options) {
        built_.reset();
        return time_of([&] {
            built_.emplace(view_, options);
            hits_ += built_->first_hit(segment_) ? 1U : 0U;
        });
    }

    // If Embree used more than the one thread that it may, the time of the process would say so.
    double embree(std::optional<EmbreeScene>& scene, RTCBuildQuality quality) {
        return time_of([&] {
                   scene.emplace(device_, view_, EmbreeOptions{.quality = quality});
                   ask(*scene);
               })
            .process;
    }

    double embree_again(const EmbreeScene& scene) {
        return time_of([&] {
                   scene.rebuild();
                   ask(scene);
               })
            .process;
    }

  private:
    void ask(const EmbreeScene& scene) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit ray;
        set_ray(ray, segment_.from, segment_.to - segment_.from);
        rtcIntersect1(scene.get(), &context, &ray);
        hits_ += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1U : 0U;
    }

    MeshView<float> view_;
    Segment<float> segment_;
    EmbreeDevice device_{"threads=1"};
    std::optional<CollisionMesh<float>> built_;
    std::size_t hits_ = 0;
};

}  // namespace

void measure_builds(const std::string& mesh, const MeshView<float>& view, int repetitions, Results& results) {
    const auto add = [&](std::string_view set, std::string_view column, double ms) {
        results.add(mesh, set, column, ms);
    };
    Builder builder(view);
    use_fresh_memory();
    for (int r = 0; r < repetitions; ++r) {
        add(set_name::build_fresh, column::pierce, builder.ours({}).process);
        std::optional<EmbreeScene> low;
        add(set_name::build_fresh, column::embree_low, builder.embree(low, RTC_BUILD_QUALITY_LOW));
    }

    const KeptMemory kept;
    std::optional<EmbreeScene> low;
    std::optional<EmbreeScene> high;
    builder.embree(low, RTC_BUILD_QUALITY_LOW);
    builder.embree(high, RTC_BUILD_QUALITY_HIGH);
    for (int r = -1; r < repetitions; ++r) {  // the first round only fetches the memory
        const Milliseconds alone = builder.ours({});
        double on_two = 0;
        {
            const Threads two(2);  // gone before Embree's turn, as threads that look for work take time of the process
            on_two = builder.ours({.executor = std::ref(two)}).wall;
        }
        const double in_grid = builder.ours(grid_options()).process;
        const double embree_low = builder.embree_again(*low);
        if (r < 0) continue;
        add(set_name::build, column::pierce, alone.process);
        add(set_name::thread_build, column::pierce, alone.wall);
        add(set_name::thread_build, column::pierce_two_threads, on_two);
        add(set_name::build, column::grid, in_grid);
        add(set_name::build, column::embree_low, embree_low);
        if (r == 0) add(set_name::build, column::embree, builder.embree_again(*high));  // slow: once is enough
    }
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

}  // namespace pierce::bench
