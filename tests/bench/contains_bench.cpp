// What a batch of `contains` gains over single calls on one thread, on meshes that do not fit a core's own caches: 64^3
// points of a grid through the mesh's box. Prints a table, and the least ratios: `ratio ours.contains VALUE` where the
// points are in random order, so that single calls wait for memory, `ratio ours.contains.grid VALUE` in the grid's
// order.
//   contains_bench [FILE...]      meshes to add to the sphere of 8 million triangles, in the table only
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>
#include <support/meshes.h>

namespace pierce::bench {
namespace {

double seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);  // other programs do not count
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The least of several times: what other programs do to the caches only adds to it.
double least_time(const std::function<void()>& work) {
    double least = 1e300;
    for (int i = 0; i < 5; ++i) {
        const double start = seconds();
        work();
        least = std::min(least, seconds() - start);
    }
    return least;
}

template <class Scalar>
std::vector<Vec3<Scalar>> grid_points(const TriangleSoup<Scalar>& soup) {
    Vec3<Scalar> low = soup.positions[0];
    Vec3<Scalar> high = low;
    for (const Vec3<Scalar>& p : soup.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    constexpr int n = 64;
    std::vector<Vec3<Scalar>> points;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3<Scalar> part = Vec3<Scalar>(Scalar(x), Scalar(y), Scalar(z)).array() + Scalar(0.5);
                points.push_back(low + (high - low).cwiseProduct(part / Scalar(n)));
            }
    return points;
}

template <class Scalar>
double gain(const CollisionMesh<Scalar>& mesh, const std::vector<Vec3<Scalar>>& points, const std::string& name) {
    std::vector<std::uint8_t> single(points.size());
    std::vector<std::uint8_t> batch(points.size());
    const double one_by_one = least_time([&] {
        for (std::size_t i = 0; i < points.size(); ++i) single[i] = mesh.contains(points[i]) ? 1 : 0;
    });
    const double together = least_time([&] { mesh.contains_points(points, batch); });
    if (single != batch) {
        std::cerr << name << ": the batch's answers differ\n";
        std::exit(1);
    }
    const auto each = [&](double time) { return 1e9 * time / static_cast<double>(points.size()); };
    std::cout << "| " << name << " | " << mesh.statistics().bytes / 1'000'000 << " | "
              << std::count(single.begin(), single.end(), 1) << " | " << each(one_by_one) << " | " << each(together)
              << " | " << one_by_one / together << " |\n";
    return one_by_one / together;
}

struct Gains {
    double shuffled;
    double in_order;
};

template <class Scalar>
Gains gains(const TriangleSoup<Scalar>& soup, const std::string& name) {
    const CollisionMesh<Scalar> mesh(soup.view());
    std::vector<Vec3<Scalar>> points = grid_points(soup);
    const double in_order = gain(mesh, points, name + ", in order");
    test::Random random(1);
    for (std::size_t i = points.size(); i-- > 1;) std::swap(points[i], points[random.below(i + 1)]);
    return {gain(mesh, points, name + ", shuffled"), in_order};
}

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    using namespace pierce;
    std::cout
        << "| mesh, order of points | MB | inside | single, ns | batch, ns | ratio |\n|---|---|---|---|---|---|\n";
    const TriangleSoup<double> sphere = test::bumpy_sphere(1000);
    const bench::Gains one = bench::gains(test::moved<float>(sphere, 1, {0, 0, 0}), "sphere, float");
    const bench::Gains two = bench::gains(sphere, "sphere, double");
    for (int i = 1; i < argc; ++i) bench::gains(read_mesh<float>(argv[i]), argv[i]);
    std::cout << "ratio ours.contains " << std::min(one.shuffled, two.shuffled) << "\nratio ours.contains.grid "
              << std::min(one.in_order, two.in_order) << '\n';
}
