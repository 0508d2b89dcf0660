// What an endless ray costs beside the segment that a caller clips to the mesh's box by hand: `ours.ray` is the
// segment's time over the ray's, single calls, medians of interleaved repetitions. Arguments: mesh files; without any,
// a bumpy sphere, then also seen from far away.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <vector>

#include <pierce/pierce.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::bench {
namespace {

constexpr std::size_t k_count = 100'000;
constexpr int k_repetitions = 15;

template <class Scalar>
struct Pair {
    Ray<Scalar> ray;
    Segment<Scalar> segment;
};

/// Half of the rays start in the box, half outside; half are aimed at a triangle.
template <class Scalar>
std::vector<Pair<Scalar>> pairs(const MeshView<Scalar>& mesh) {
    const test::Extent<Scalar> extent(mesh);
    test::Random random(5);
    std::vector<Pair<Scalar>> out;
    const auto in_box = [&] {
        return Vec3<double>(extent.low + (extent.high - extent.low).cwiseProduct(random.in_cube().cwiseAbs()));
    };
    for (std::size_t i = 0; i < k_count; ++i) {
        Vec3<double> from = in_box();
        if (i % 2 != 0) from += 1.5 * extent.diagonal() * random.direction();
        Vec3<double> d = in_box() - from;
        if (i % 4 < 2) d = test::corner(mesh, random.below(mesh.triangles.size()), 0) - from;
        const Vec3<Scalar> origin = from.template cast<Scalar>();
        const Vec3<Scalar> direction = d.normalized().template cast<Scalar>();
        double exit = HUGE_VAL;
        for (int k = 0; k < 3; ++k) {
            const double side = direction[k] > 0 ? extent.high[k] : extent.low[k];
            if (direction[k] != 0) exit = std::min(exit, (side - double{origin[k]}) / double{direction[k]});
        }
        const Vec3<double> to =
            origin.template cast<double>() + 1.0001 * std::max(exit, 0.0) * direction.template cast<double>();
        out.push_back({{origin, direction}, {origin, to.template cast<Scalar>()}});
    }
    return out;
}

template <class Query>
double nanoseconds(std::size_t& hits, Query&& query) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < k_count; ++i) hits += query(i) ? std::size_t{1} : std::size_t{0};
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    return time.count() / k_count;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + k_repetitions / 2, values.end());
    return values[k_repetitions / 2];
}

template <class Scalar>
double compare(const TriangleSoup<Scalar>& soup, const std::string& name) {
    const CollisionMesh<Scalar> mesh(soup.view());
    const std::vector<Pair<Scalar>> all = pairs(soup.view());
    std::vector<double> of_segments;
    std::vector<double> of_rays;
    std::vector<double> ratios;
    std::size_t segment_hits = 0;
    std::size_t ray_hits = 0;
    for (int i = 0; i < k_repetitions; ++i) {
        of_segments.push_back(nanoseconds(segment_hits, [&](std::size_t n) {
            return mesh.first_hit(all[n].segment, {.sides = Sides::both}).has_value();
        }));
        of_rays.push_back(nanoseconds(
            ray_hits, [&](std::size_t n) { return mesh.first_hit(all[n].ray, {.sides = Sides::both}).has_value(); }));
        ratios.push_back(of_segments.back() / of_rays.back());
    }
    // The segment's end is rounded: a few differ.
    std::cout << name << ' ' << (sizeof(Scalar) == 4 ? "float" : "double") << ": segment " << median(of_segments)
              << " ns, ray " << median(of_rays) << " ns, hits of segments over those of rays "
              << double(segment_hits) / double(ray_hits) << '\n';
    if (segment_hits * 100 < ray_hits * 99 || ray_hits * 100 < segment_hits * 99) {
        std::cerr << "segments and rays have other hits\n";
        std::exit(1);
    }
    return median(ratios);
}

template <class Scalar>
void compare_both(const TriangleSoup<double>& soup, const std::string& name, std::vector<double>& ratios) {
    ratios.push_back(compare(test::moved<Scalar>(soup, 1, {0, 0, 0}), name));
}

/// Times of segments and rays that come from further and further away, aimed at the mesh.
template <class Scalar>
void look_from_afar(const TriangleSoup<double>& soup) {
    constexpr std::size_t k_aimed = 2'000;
    const CollisionMesh<Scalar> mesh(test::moved<Scalar>(soup, 1, {0, 0, 0}).view());
    const double size = test::Extent<double>(soup.view()).diagonal();
    std::cout << (sizeof(Scalar) == 4 ? "float" : "double") << ", ns from so many mesh sizes (segment, ray):";
    for (const double sizes : {1e3, 1e6, 1e9, 1e12, 1e15, 1e18}) {
        test::Random random(6);
        std::vector<Segment<Scalar>> segments;
        for (std::size_t i = 0; i < k_aimed; ++i) {
            const Vec3<double> from = sizes * size * random.direction();
            segments.push_back({from.cast<Scalar>(), (0.2 * size * random.in_cube() - from).cast<Scalar>()});
        }
        std::size_t hits = 0;
        std::vector<double> times[2];
        for (int i = 0; i < k_repetitions; ++i)
            for (const bool ray : {false, true}) {
                const auto start = std::chrono::steady_clock::now();
                for (const Segment<Scalar>& one : segments)
                    hits += (ray ? mesh.first_hit(Ray<Scalar>{one.from, one.to}) : mesh.first_hit(one)) ? 1U : 0U;
                const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
                times[ray ? 1 : 0].push_back(time.count() / k_aimed);
            }
        if (hits < k_aimed * k_repetitions) std::exit(1);  // of twice as many
        std::cout << ' ' << sizes << ": " << median(times[0]) << ", " << median(times[1]) << ';';
    }
    std::cout << '\n';
}

}  // namespace
}  // namespace pierce::bench

int main(int argc, char** argv) {
    using namespace pierce;
    std::vector<double> ratios;
    const auto add = [&](const TriangleSoup<double>& soup, const std::string& name) {
        bench::compare_both<float>(soup, name, ratios);
        bench::compare_both<double>(soup, name, ratios);
    };
    if (argc < 2) {
        add(test::bumpy_sphere(100), "bumpy sphere");
        bench::look_from_afar<float>(test::bumpy_sphere(100));
        bench::look_from_afar<double>(test::bumpy_sphere(100));
    }
    for (int i = 1; i < argc; ++i) add(read_mesh<double>(argv[i]), argv[i]);
    std::sort(ratios.begin(), ratios.end());
    std::cout << "ratio ours.ray " << ratios[(ratios.size() - 1) / 2] << '\n';
}
