// What certainty costs: how often the exact room is entered on real meshes, and the time of exact first hits over that of their inexact
// twin. Where the two find different triangles, it says how often. And what the verified point costs: the time with it over the time without.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include <query/answer.h>
#include <support/meshes.h>
#include <support/real_meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using namespace detail;

/// The inexact twin: the same code with the sign of each double taken as final, and values and normals straight from the doubles. A plain
/// floating-point library, in effect.
struct Trusting {
    static constexpr float unit = 0;

    static bool test(const Corners& corners, std::uint32_t triangle, const Path& path, Sides sides, double limit, QueryCounters&,
                     Candidate& candidate) {
        const Volumes64 x(corners, path);
        const double end = x.v - x.s;
        const bool front = sides != Sides::back && x.v <= 0 && end > 0;
        const bool back = sides != Sides::front && x.v >= 0 && end < 0;
        if (!front && !back) return false;
        const auto [lowest, highest] = std::minmax({x.weight[0], x.weight[1], x.weight[2]});
        if (front ? highest > 0 : lowest < 0) return false;
        const double fraction = x.v / x.s;
        if (!(fraction < limit)) return false;  // so no two hits are ever left to the exact order
        candidate = {triangle, {.hit = true, .side = front ? Sides::front : Sides::back}, fraction, fraction};
        return true;
    }
    template <class Scalar>
    struct Face {
        Face(const Corners& corners_, QueryCounters&) : corners(corners_), plane(corners) {}
        [[nodiscard]] Point normal() const { return {plane.normal.x, plane.normal.y, plane.normal.z}; }
        [[nodiscard]] Measures measures(const Path& path, const Decision&) const {
            return quotients(Meeting(plane, path));
        }
        [[nodiscard]] int side(const Point& point) const { return dot(difference<double>(point, plane.a), plane.n) >= 0 ? 1 : -1; }

        const Corners corners;
        const Plane<double> plane;
    };
};

struct Set {
    const char* name;
    double length;  // in diagonals of the box
    bool cloud;     // anywhere in the box, else at the surface
};
constexpr Set k_sets[] = {{"short", 0.01, false}, {"medium", 0.1, false}, {"long", 1.5, false}, {"cloud", 0.005, true}};

/// The hit and its values, without a verified point.
template <class Scalar>
std::optional<Hit<Scalar>> unverified(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters) {
    Search<Scalar> search(scene, path, Sides::front);
    First<Scalar> first(scene, path, counters);
    traverse<Certified>(search, {}, counters, first);
    if (!first.found()) return std::nullopt;
    const Candidate& best = first.best();
    const Corners corners = scene.corners(best.triangle);
    CertifiedFace<Scalar> face(corners, counters);
    const Point normal = face.normal();
    std::optional<Hit<Scalar>> hit;
    report(face.measures(path, best.decision), normal, best.decision, scene.face_of(best.triangle), scene.triangle_numbers[best.triangle],
           hit.emplace());
    return hit;
}

// Of this thread alone: what others do on the machine meanwhile is not to be counted.
double nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * double(now.tv_sec) + double(now.tv_nsec);
}

template <class Kernel, class Scalar>
double pass(const Scene<Scalar>& scene, const std::vector<Path>& paths, QueryCounters& counters, std::vector<std::uint32_t>& found) {
    const double start = nanoseconds();
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::optional<Hit<Scalar>> hit;
        if constexpr (std::is_void_v<Kernel>) hit = unverified<Scalar>(scene, paths[i], counters);
        else hit = first_answer<Kernel, Scalar>(scene, paths[i], {}, counters);
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
        const double length = set.length * extent.diagonal();
        for (int i = 0; i < 20'000; ++i) {
            const Vec3<double> d = length * random.direction();
            const std::size_t t = random.below(soup.triangles.size());
            const Vec3<double> w = random.weights();
            Vec3<double> at = w[0] * corner(soup.view(), t, 0) + w[1] * corner(soup.view(), t, 1) + w[2] * corner(soup.view(), t, 2);
            if (set.cloud) at = extent.low + (extent.high - extent.low).cwiseProduct(random.in_cube().cwiseAbs());
            const double before = random.unit();
            paths.push_back({to_point(Vec3<Scalar>((at - before * d).template cast<Scalar>())),
                             to_point(Vec3<Scalar>((at + (1 - before) * d).template cast<Scalar>()))});
        }
        std::vector<std::uint32_t> exact(paths.size());
        std::vector<std::uint32_t> trusting(paths.size());
        QueryCounters counters;
        QueryCounters unused;
        std::vector<double> quotients;
        std::vector<double> verified;
        double best = 1e300;
        for (int repeat = 0; repeat < 7; ++repeat) {
            QueryCounters fresh;
            const double a = pass<Certified, Scalar>(scene, paths, fresh, exact);
            verified.push_back(a / pass<void, Scalar>(scene, paths, unused, trusting));
            quotients.push_back(pass<Trusting, Scalar>(scene, paths, unused, trusting) / a);
            best = std::min(best, a);
            counters = fresh;
        }
        std::nth_element(quotients.begin(), quotients.begin() + 3, quotients.end());
        std::nth_element(verified.begin(), verified.begin() + 3, verified.end());
        std::size_t hits = 0;
        std::size_t different = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            hits += exact[i] != ~0U ? 1U : 0U;
            different += exact[i] != trusting[i] ? 1U : 0U;
        }
        std::printf("| %-12s | %-6s | %-6s | %3.0f %% | %7.0f | %5.2f | %5.2f | %9.2e | %6.3f | %6.3f | %zu |\n", std::string(name).c_str(), scalar, set.name,
                    100.0 * double(hits) / double(paths.size()), best, 1 / quotients[3], verified[3],
                    double(counters.exact_decisions) / double(counters.triangles), double(counters.exact_values) / double(paths.size()),
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
    std::printf("ratio ours.exactness.%s %.3f\n", scalar, ratio);
    return ratio;
}

}  // namespace
}  // namespace pierce::test

int main() {
    std::puts("| mesh         | scalar | set    | hits | ns exact | cost | verified point | exact decisions a test | exact values | "
              "exact sides | different |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|");
    const double of_float = pierce::test::measure_all<float>("float");
    const double of_double = pierce::test::measure_all<double>("double");
    std::printf("ratio ours.exactness %.3f\n", std::min(of_float, of_double));
}
