// What certainty costs: how often the exact room is entered on real meshes, and the time of exact first hits over that
// of their inexact twin. Where the two find different triangles, it says how often. And what each part of an answer
// costs.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include <bench/exactness_twin.h>
#include <query/answer.h>
#include <support/meshes.h>
#include <support/real_meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using namespace detail;

/// The inexact twin: the same code with the sign of each double taken as final, and values, normals and places straight
/// from the doubles. A plain floating-point library, in effect. (Its narrow phase is in exactness_twin.h, compiled for
/// the same instruction sets as the library's.)
struct Trusting {
    template <class Scalar>
    static bool test(const Scene<Scalar>& scene, TriangleRef triangle, const Path& path, Sides sides, double limit,
                     QueryCounters&, Candidate& candidate) {
        candidate.triangle = triangle;
        twin_of<Scalar>(scene).filter(scene.row(triangle), path.from.data(), path.to.data(), path.ray, sides, candidate,
                                      candidate.measured);
        return candidate.verdict == Verdict::hit &&
               candidate.earliest < limit;  // so no two are ever left to the exact order
    }
    template <class Scalar>
    static void certify(const Scene<Scalar>& scene, const Candidate& candidate, const Path&, QueryCounters&,
                        Values& values, Rounded<Scalar>& rounded) {
        twin_of<Scalar>(scene).evaluate(candidate.measured, candidate.decision.side, scene.grain, values, rounded);
    }

  private:
    template <class Scalar>
    static const NarrowKernels<Scalar>& twin_of(const Scene<Scalar>& scene) {
        return (scene.backend->narrow == &k_narrow ? k_trusting : k_trusting_fused).template of<Scalar>();
    }
};

struct Set {
    const char* name;
    double length;  // in diagonals of the box
    bool cloud;     // anywhere in the box, else at the surface
};
constexpr Set k_sets[] = {{"short", 0.01, false}, {"medium", 0.1, false}, {"long", 1.5, false}, {"cloud", 0.005, true}};

template <class Scalar>
Path path_at(const TriangleSoup<Scalar>& soup, const Extent<Scalar>& extent, const Set& set, Random& random) {
    const Vec3<double> d = set.length * extent.diagonal() * random.direction();
    const std::size_t t = random.below(soup.triangles.size());
    const Vec3<double> w = random.weights();
    Vec3<double> at =
        w[0] * corner(soup.view(), t, 0) + w[1] * corner(soup.view(), t, 1) + w[2] * corner(soup.view(), t, 2);
    if (set.cloud) at = extent.low + (extent.high - extent.low).cwiseProduct(random.in_cube().cwiseAbs());
    const double before = random.unit();
    return {to_point(Vec3<Scalar>((at - before * d).template cast<Scalar>())),
            to_point(Vec3<Scalar>((at + (1 - before) * d).template cast<Scalar>()))};
}

// Of this thread alone: what others do on the machine meanwhile is not to be counted.
double nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * double(now.tv_sec) + double(now.tv_nsec);
}

template <class Kernel, class Scalar>
double pass(const Scene<Scalar>& scene, const std::vector<Path>& paths, QueryCounters& counters,
            std::vector<std::uint32_t>& found) {
    const double start = nanoseconds();
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const std::optional<Hit<Scalar>> hit = first_answer<Kernel, Scalar>(scene, paths[i], {}, counters);
        found[i] = hit ? hit->triangle : ~0U;
    }
    return (nanoseconds() - start) / static_cast<double>(paths.size());
}

template <class Scalar>
void measure_mesh(const char* scalar, std::string_view name, std::vector<double>& ratios, QueryCounters& all) {
    const TriangleSoup<Scalar> soup = real_mesh<Scalar>(name);
    const Scene<Scalar> scene = make_scene(soup.view(), {});
    const Extent<Scalar> extent(soup.view());
    for (const Set& set : k_sets) {
        Random random(5);
        std::vector<Path> paths;
        for (int i = 0; i < 20'000; ++i) paths.push_back(path_at(soup, extent, set, random));
        std::vector<std::uint32_t> exact(paths.size());
        std::vector<std::uint32_t> trusting(paths.size());
        QueryCounters counters;
        QueryCounters unused;
        std::vector<double> quotients;
        double best = 1e300;
        for (int repeat = 0; repeat < 7; ++repeat) {
            QueryCounters fresh;
            const double a = pass<Certified, Scalar>(scene, paths, fresh, exact);
            quotients.push_back(pass<Trusting, Scalar>(scene, paths, unused, trusting) / a);
            best = std::min(best, a);
            counters = fresh;
        }
        std::nth_element(quotients.begin(), quotients.begin() + 3, quotients.end());
        std::size_t hits = 0;
        std::size_t different = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            hits += exact[i] != ~0U ? 1U : 0U;
            different += exact[i] != trusting[i] ? 1U : 0U;
        }
        std::printf("| %-12s | %-6s | %-6s | %3.0f %% | %7.0f | %5.2f | %9.2e | %6.3f | %6.3f | %zu |\n",
                    std::string(name).c_str(), scalar, set.name, 100.0 * double(hits) / double(paths.size()), best,
                    1 / quotients[3], double(counters.exact_decisions) / double(counters.triangles),
                    double(counters.exact_values) / double(paths.size()),
                    double(counters.exact_sides) / double(paths.size()), different);
        ratios.push_back(quotients[3]);
        all.queries += paths.size();
        all.triangles += counters.triangles;
        all.exact_decisions += counters.exact_decisions;
        all.exact_orders += counters.exact_orders;
        all.exact_values += counters.exact_values;
        all.exact_sides += counters.exact_sides;
    }
}

/// Prints what a scalar costs, and returns the inexact time over the exact one.
template <class Scalar>
double measure_all(const char* scalar) {
    std::vector<double> ratios;
    QueryCounters all;
    for (const std::string_view name : {"elephant", "fandisk", "bull", "knot1", "blobby", "cheese"})
        measure_mesh<Scalar>(scalar, name, ratios, all);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    const double ratio = ratios[ratios.size() / 2];
    const auto tests = double(all.triangles);
    const auto queries = double(all.queries);
    std::printf("exact decisions a kernel test, %s: %.2e\n", scalar, double(all.exact_decisions) / tests);
    std::printf("all entries of the exact room a kernel test, %s: %.2e\n", scalar,
                double(all.exact_decisions + all.exact_orders + all.exact_values + all.exact_sides) / tests);
    std::printf("a query, %s: exact orders %.2e, values %.2e, sides %.2e\n", scalar, double(all.exact_orders) / queries,
                double(all.exact_values) / queries, double(all.exact_sides) / queries);
    return ratio;
}

}  // namespace
}  // namespace pierce::test

namespace pierce::test {
namespace {

/// Up to which part an answer goes.
enum class Until { filter, values, place, all };

/// Nothing is in any way.
struct FreeWays {
    struct Nearby {
        explicit Nearby(const FreeWays&) {}
    };
    [[nodiscard]] bool hides(const Point&) const { return false; }
    [[nodiscard]] bool clear(const Point&, bool) const { return true; }
    [[nodiscard]] bool stops(const Point&, Corners&, Decision&) const { return false; }
};

template <Until until, class Scalar>
void answer_until(const Scene<Scalar>& scene, const Path& path, const std::vector<TriangleRef>& triangles,
                  const QueryOptions& options, QueryCounters& counters, Hit<Scalar>& hit) {
    First<Scalar> first(scene, path, counters);
    for (const TriangleRef triangle : triangles) {
        test_triangle<Certified>(scene, path, triangle, options, counters, first);
        first.seen(triangle);
    }
    const Candidate& best = first.best();
    hit.fraction = static_cast<Scalar>(best.earliest);
    if constexpr (until == Until::all) {
        answer<Certified>(scene, path, best, none_passed, options, counters, &first.list(), hit);
    } else if constexpr (until != Until::filter) {
        Values values;
        Rounded<Scalar> rounded;
        Certified::certify(scene, best, path, counters, values, rounded);
        const std::uint32_t number = scene.number_of(best.triangle);
        report(rounded, best.decision, scene.face_of_number(number), number, hit);
        if constexpr (until == Until::values) return;
        place(path, best.measured, best.decision, scene.grain, values, rounded, counters, FreeWays{}, hit);
    }
}

/// Prints what each part of an answer costs, from the triangles that the wide kernels left: medians over chunks of
/// hits, of each the least of many times.
template <class Scalar>
void measure_parts(const char* scalar, std::string_view name) {
    const TriangleSoup<Scalar> soup = real_mesh<Scalar>(name);
    const Scene<Scalar> scene = make_scene(soup.view(), {});
    const Extent<Scalar> extent(soup.view());
    Random random(5);
    const QueryOptions options;
    QueryCounters counters;
    std::vector<Path> paths;
    std::vector<std::vector<TriangleRef>> lists;
    while (paths.size() < 1000) {
        const Path path = path_at(soup, extent, k_sets[1], random);
        First<Scalar> first(scene, path, counters);
        traverse<Certified>(scene, path, {}, counters, first);
        if (!first.found() || !first.list().complete) continue;
        paths.push_back(path);
        lists.emplace_back(first.list().triangles.begin(), first.list().triangles.begin() + first.list().count);
    }
    constexpr std::size_t k_chunk = 20;
    std::array<std::vector<double>, 4> least;
    std::vector<Hit<Scalar>> hits(paths.size());
    for (std::size_t begin = 0; begin < paths.size(); begin += k_chunk) {
        const auto time = [&]<Until until>(std::integral_constant<Until, until>) {
            double& best = least[static_cast<std::size_t>(until)].back();
            const double start = nanoseconds();
            for (int again = 0; again < 5; ++again)
                for (std::size_t i = begin; i < begin + k_chunk; ++i)
                    answer_until<until>(scene, paths[i], lists[i], options, counters, hits[i]);
            best = std::min(best, (nanoseconds() - start) / (5 * k_chunk));
        };
        for (std::vector<double>& of_part : least) of_part.push_back(1e300);
        for (int repeat = 0; repeat < 20; ++repeat) {
            time(std::integral_constant<Until, Until::filter>());
            time(std::integral_constant<Until, Until::values>());
            time(std::integral_constant<Until, Until::place>());
            time(std::integral_constant<Until, Until::all>());
        }
    }
    std::array<double, 4> median{};
    for (std::size_t i = 0; i < 4; ++i) {
        std::nth_element(least[i].begin(), least[i].begin() + static_cast<std::ptrdiff_t>(least[i].size() / 2),
                         least[i].end());
        median[i] = least[i][least[i].size() / 2];
    }
    std::printf("| %-12s | %-6s | %6.1f | %6.1f | %6.1f | %6.1f | %6.1f |\n", std::string(name).c_str(), scalar,
                median[0], median[1] - median[0], median[2] - median[1], median[3] - median[2], median[3]);
}

}  // namespace
}  // namespace pierce::test

int main() {
    std::puts("| mesh         | scalar | ns filter | values | place | others | all |");
    std::puts("|---|---|---|---|---|---|---|");
    for (const std::string_view name : {"elephant", "fandisk", "bull"}) {
        pierce::test::measure_parts<float>("float", name);
        pierce::test::measure_parts<double>("double", name);
    }
    std::puts(
        "| mesh         | scalar | set    | hits | ns exact | cost | exact decisions a test | exact values | "
        "exact sides | different |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|");
    const double of_float = pierce::test::measure_all<float>("float");
    const double of_double = pierce::test::measure_all<double>("double");
    std::printf("ratio ours.exactness.float %.3f\nratio ours.exactness.double %.3f\n", of_float, of_double);
}
