// The caller's floating-point environment changes nothing: flush to zero, denormals are zero, every rounding mode, and both at once.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/segments.h>
#include <support/setting.h>

namespace pierce::test {
namespace {

// Everything that a mesh answers to some segments, built and asked under a setting.
template <class Scalar>
std::vector<std::uint64_t> answers(const TriangleSoup<Scalar>& soup, const std::vector<Segment<Scalar>>& segments,
                                   int rounding, bool flush) {
    std::vector<std::uint64_t> out;
    std::array<Hit<Scalar>, 3> hits;
    const Setting setting(rounding, flush);
    const CollisionMesh<Scalar> mesh(soup.view());
    for (const Segment<Scalar>& s : segments) {
        const std::size_t total = mesh.all_hits(s, hits, {.sides = Sides::both});
        out.push_back(total);
        out.push_back(static_cast<std::uint64_t>(mesh.crossings(s)));
        out.push_back(mesh.contains(s.from) ? 1 : 0);
        for (std::size_t i = 0; i < std::min(total, hits.size()); ++i) {
            const Hit<Scalar>& hit = hits[i];
            out.insert(out.end(), {hit.triangle, std::uint64_t(hit.feature), hit.feature_index, bits(hit.fraction),
                                   bits(hit.exact_fraction)});
            for (int k = 0; k < 3; ++k)
                out.insert(out.end(), {bits(hit.point[k]), bits(hit.normal[k]), bits(hit.barycentric[k])});
        }
    }
    setting.expect_given_back();
    return out;
}

// Mesh and segments are made at size 1 and scaled together.
template <class Scalar>
void expect_same_everywhere(const char* what, const TriangleSoup<double>& unit, double scale) {
    SCOPED_TRACE(what);
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, scale, {0, 0, 0});
    const Extent<double> extent(unit.view());
    Random random(3);
    std::vector<Segment<Scalar>> segments;
    for (int i = 0; i < 600; ++i) {
        const Segment<double> s = mixed_segment(unit.view(), extent, random);
        segments.push_back({(scale * s.from).cast<Scalar>(), (scale * s.to).cast<Scalar>()});
    }
    const auto standard = answers(soup, segments, FE_TONEAREST, false);
    EXPECT_GT(standard.size(), 3 * segments.size() + 1000);  // there are hits
    for_each_setting([&](int rounding, bool flush) {
        EXPECT_EQ(answers(soup, segments, rounding, flush), standard) << "rounding " << rounding << " flush " << flush;
    });
}

TEST(Environment, changes_no_bit) {
    const TriangleSoup<double> sphere = bumpy_sphere(8);
    expect_same_everywhere<float>("float", sphere, 1);
    expect_same_everywhere<double>("double", sphere, 1);
    expect_same_everywhere<float>("lattice", polycube(3, 0.5, 2, 1), 1);
    expect_same_everywhere<float>("denormal floats", sphere, 1e-40);
    expect_same_everywhere<float>("nearly denormal floats", sphere, 1e-37);
    expect_same_everywhere<double>("denormal doubles", sphere, 1e-312);
    expect_same_everywhere<double>("tiny doubles", sphere, 1e-300);
    expect_same_everywhere<double>("huge doubles", sphere, 1e300);
}

}  // namespace
}  // namespace pierce::test
