// What certainty costs: how often the exact room is entered on real meshes, and the time of exact first hits over the time of the
// same code with the filter's sign taken as final. Both find the same hits on these segments; where they do not, it says so.
// And what the verified point costs: the time with it over the time without.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include <query/answer.h>
#include <support/meshes.h>
#include <support/real_meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using namespace detail;

/// The filter without its bounds, and no exact arithmetic: what a plain floating-point library does.
struct Trusting {
    static bool test(const detail::Scene& scene, std::uint32_t triangle, const Path& path, Sides sides, double limit, QueryCounters&,
                     Candidate& candidate) {
        const Evaluated v(scene.prepared[triangle], path);
        const bool front = sides != Sides::back && v.f0 >= 0 && v.f1 < 0;
        const bool back = sides != Sides::front && v.f0 <= 0 && v.f1 > 0;
        if (!front && !back) return false;
        const double sign = front ? 1 : -1;
        const double d = sign * (v.f0 - v.f1);
        const double wc = sign * v.weight_c();
        if (wc < 0) return false;
        const double wa = sign * v.weight_a();
        if (wa < 0 || (d - wc) - wa < 0) return false;
        const double fraction = sign * v.f0 / d;
        if (fraction > limit) return false;
        candidate = {triangle, {.hit = true, .side = front ? Sides::front : Sides::back}, fraction, fraction};
        return true;
    }
    static int side(const detail::Scene& scene, std::uint32_t triangle, const Point& point) {
        const Evaluated v(scene.prepared[triangle], {point, point});
        return v.f0 >= 0 ? 1 : -1;
    }
};

struct Set {
    const char* name;
    double length;  // in diagonals of the box
    bool cloud;     // anywhere in the box, else at the surface
};
constexpr Set k_sets[] = {{"short", 0.01, false}, {"medium", 0.1, false}, {"long", 1.5, false}, {"cloud", 0.005, true}};

/// The hit and its values, without a verified point.
template <class Scalar>
std::optional<Hit<Scalar>> unverified(const detail::Scene& scene, const Path& path, QueryCounters& counters) {
    First first(scene, path, counters);
    traverse<Certified>(scene, path, {}, counters, first);
    if (!first.found()) return std::nullopt;
    return reported<Scalar>(scene, path, first.best());
}

template <class Kernel, class Scalar>
double pass(const detail::Scene& scene, const std::vector<Path>& paths, QueryCounters& counters, std::vector<std::uint32_t>& found) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::optional<Hit<Scalar>> hit;
        if constexpr (std::is_void_v<Kernel>) hit = unverified<Scalar>(scene, paths[i], counters);
        else hit = first_answer<Kernel, Scalar>(scene, paths[i], {}, counters);
        found[i] = hit ? hit->triangle : ~0U;
    }
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
           static_cast<double>(paths.size());
}

template <class Scalar>
void measure_mesh(const char* scalar, std::string_view name, std::vector<double>& ratios, QueryCounters& all) {
    const TriangleSoup<Scalar> soup = real_mesh<Scalar>(name);
    const detail::Scene scene = make_scene(soup.view(), {});
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
        std::printf("| %-12s | %-6s | %-6s | %3.0f %% | %7.0f | %5.2f | %5.2f | %9.2e | %zu |\n", std::string(name).c_str(), scalar, set.name,
                    100.0 * double(hits) / double(paths.size()), best, 1 / quotients[3], verified[3],
                    double(counters.exact_decisions) / double(counters.triangles), different);
        ratios.push_back(quotients[3]);
        all.exact_decisions += counters.exact_decisions;
        all.triangles += counters.triangles;
    }
}

template <class Scalar>
void measure_all(const char* scalar) {
    std::vector<double> ratios;
    QueryCounters all;
    for (const std::string_view name : {"elephant", "fandisk", "bull", "knot1", "blobby", "cheese"})
        measure_mesh<Scalar>(scalar, name, ratios, all);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    std::printf("exact decisions a kernel test, %s: %.2e\n", scalar, double(all.exact_decisions) / double(all.triangles));
    std::printf("ratio ours.exactness.%s %.3f\n", scalar, ratios[ratios.size() / 2]);
}

}  // namespace
}  // namespace pierce::test

int main() {
    std::puts("| mesh         | scalar | set    | hits | ns exact | cost | verified point | exact room | different |");
    std::puts("|---|---|---|---|---|---|---|---|---|");
    pierce::test::measure_all<float>("float");
    pierce::test::measure_all<double>("double");
}
