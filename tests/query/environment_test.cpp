// The caller's floating-point environment changes nothing: flush to zero, denormals are zero, every rounding mode, and
// both at once.
// And where every floating-point exception stops the program, none is raised, not even by what is not a number.
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

/// Segments of a mesh of size 1, scaled with it.
template <class Scalar>
std::vector<Segment<Scalar>> scaled_segments(const TriangleSoup<double>& unit, double scale, std::uint64_t seed,
                                             int count) {
    const Extent<double> extent(unit.view());
    Random random(seed);
    std::vector<Segment<Scalar>> segments;
    for (int i = 0; i < count; ++i) {
        const Segment<double> s = mixed_segment(unit.view(), extent, random);
        segments.push_back({(scale * s.from).cast<Scalar>(), (scale * s.to).cast<Scalar>()});
    }
    return segments;
}

template <class Scalar>
void expect_same_everywhere(const char* what, const TriangleSoup<double>& unit, double scale) {
    SCOPED_TRACE(what);
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, scale, {0, 0, 0});
    const auto segments = scaled_segments<Scalar>(unit, scale, 3, 600);
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

// Threads that a build is given may have settings of their own, as a game's pool has that was made to flush: a mesh of
// denormal numbers had no area then, and a raster that rounds otherwise than the query's lost triangles.
template <class Scalar>
void expect_same_builds(const char* what, double scale) {
    SCOPED_TRACE(what);
    const TriangleSoup<double> unit = bumpy_sphere(70);
    ASSERT_GT(unit.triangles.size(), 32'768U);  // several parts
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, scale, {0, 0, 0});
    const auto segments = scaled_segments<Scalar>(unit, scale, 4, 300);
    const auto hits = [&](const CollisionMesh<Scalar>& mesh) {
        std::vector<std::uint64_t> out = {mesh.statistics().degenerate, mesh.statistics().grid_references};
        for (const Segment<Scalar>& s : segments) {
            const auto hit = mesh.first_hit(s, {.sides = Sides::both});
            out.push_back(hit ? hit->triangle : ~0U);
            if (hit) out.push_back(bits(hit->exact_fraction));
        }
        return out;
    };
    const auto standard = hits(CollisionMesh<Scalar>(soup.view()));
    EXPECT_GT(standard.size(), segments.size() + 100);  // there are hits
    for (const bool flush : {true, false}) {
        const int rounding = flush ? FE_TONEAREST : FE_UPWARD;
        const auto in_setting = [&](std::size_t parts, Task task) {
            for (std::size_t part = 0; part < parts; ++part) {
                const Setting setting(rounding, flush);
                task(part);
                setting.expect_given_back();
            }
        };
        EXPECT_EQ(hits(CollisionMesh<Scalar>(soup.view(), {.executor = in_setting})), standard)
            << "rounding " << rounding << " flush " << flush;
    }
}

TEST(Environment, of_the_threads_of_a_build_changes_no_bit) {
    expect_same_builds<float>("float", 1);
    expect_same_builds<float>("denormal floats", 1e-40);
    expect_same_builds<double>("double", 1);
    expect_same_builds<double>("denormal doubles", 1e-312);
}

#if defined(__GLIBC__)

// A program that is stopped (SIGFPE) by any floating-point exception, for as long as it lives.
class Traps {
  public:
    Traps() { feenableexcept(FE_ALL_EXCEPT); }
    ~Traps() { std::fesetenv(FE_DFL_ENV); }
    Traps(const Traps&) = delete;
    Traps& operator=(const Traps&) = delete;
};

TEST(Environment, traps_where_the_processor_has_them) {
    Traps traps;
    if (fegetexcept() == 0) GTEST_SKIP() << "this processor has no traps";
    volatile double zero = 0;
    EXPECT_DEATH(zero = zero / zero, "");  // or the next test would show nothing
}

template <class Scalar>
void expect_no_trap() {
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(4), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    const Scalar nan = std::numeric_limits<Scalar>::signaling_NaN();
    const double limit = std::numeric_limits<double>::signaling_NaN();
    const Segment<Scalar> through{{3, Scalar(0.1), Scalar(0.2)}, {-3, Scalar(0.1), Scalar(0.3)}};
    Segment<Scalar> bad = through;
    bad.from[1] = nan;
    const std::array<Segment<Scalar>, 2> both = {through, bad};
    std::array<std::optional<Hit<Scalar>>, 2> first;
    std::array<std::uint8_t, 2> any{};
    std::array<Hit<Scalar>, 4> all;
    TriangleSoup<Scalar> bad_soup = soup;
    bad_soup.positions[2][0] = nan;
    const QueryOptions nothing{.max_fraction = limit};

    bool hit = false;
    bool refused = true;
    bool thrown = false;
    std::size_t hits = 0;
    std::size_t none = 0;
    {
        const Traps traps;
        for (const Segment<Scalar>& s : both) {
            const bool good = &s == &both[0];
            const bool found = mesh.first_hit(s).has_value();
            const bool some = mesh.any_hit(s);
            const std::size_t count = mesh.all_hits(s, all) + static_cast<std::size_t>(mesh.sweep(s).has_value());
            const bool inside = mesh.contains(s.from);
            const int crossed = mesh.crossings(s);
            const std::size_t faces = mesh.explain(s).size();
            if (good)
                hit = found && some && count == 2 && !inside && crossed == 0 && faces > 0;
            else
                refused = refused && !found && !some && count == 0 && !inside && crossed == 0 && faces == 0;
        }
        refused = refused && !mesh.first_hit(through, nothing) && !mesh.any_hit(through, nothing) &&
                  mesh.all_hits(through, all, nothing) == 0;
        hits = mesh.first_hits(both, first) + mesh.any_hits(both, any);
        none = mesh.first_hits(both, first, nothing) + mesh.any_hits(both, any, nothing);
        try {
            const CollisionMesh<Scalar> not_finite(bad_soup.view());
        } catch (const MeshError&) {
            thrown = true;
        }
    }
    EXPECT_TRUE(hit);
    EXPECT_TRUE(refused);
    EXPECT_EQ(hits, 2U);
    EXPECT_EQ(none, 0U);
    EXPECT_TRUE(thrown);
}

TEST(Environment, does_not_trap_on_what_is_not_a_number_in_float) { expect_no_trap<float>(); }
TEST(Environment, does_not_trap_on_what_is_not_a_number_in_double) { expect_no_trap<double>(); }

#endif

}  // namespace
}  // namespace pierce::test
