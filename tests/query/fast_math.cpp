// A user's program that is compiled and linked with -ffast-math, which also makes the processor flush denormal numbers:
// the library's answers are the same. Ends with status 1 and a line for each that is not.
#include <bit>
#include <cstdint>
#include <cstdio>

#include <pierce/pierce.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

int failures = 0;

void expect(bool truth, const char* what) {
    if (truth) return;
    std::printf("not so: %s\n", what);
    ++failures;
}

// Multiples of the smallest float there is; made of bits, as arithmetic on them is flushed here.
pierce::Vec3<float> denormal(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return {std::bit_cast<float>(x), std::bit_cast<float>(y), std::bit_cast<float>(z)};
}

}  // namespace

int main() {
#if defined(__SSE2__)
    expect((_mm_getcsr() & 0x8040) == 0x8040,
           "-ffast-math flushes denormals in this program (else this test shows nothing)");
#endif
    const std::vector<pierce::Vec3<float>> corners = {denormal(0, 0, 4), denormal(400, 0, 4), denormal(0, 400, 4)};
    const std::vector<pierce::IndexTriple> triangles = {{0, 1, 2}};
    const pierce::CollisionMesh<float> mesh({corners, triangles});
    expect(mesh.statistics().degenerate == 0, "a denormal triangle has an area");
    const auto hit = mesh.first_hit({denormal(100, 100, 8), denormal(100, 100, 0)});
    expect(hit.has_value(), "a denormal segment hits it");
    expect(hit && hit->exact_fraction == 0.5F, "half way");
    expect(!mesh.any_hit({denormal(300, 300, 8), denormal(300, 300, 0)}), "one beside it does not");
    expect(!mesh.any_hit({denormal(100, 100, 8), denormal(100, 100, 4)}), "one that ends on it does not");
    const float nan = std::bit_cast<float>(0x7fc00000U);
    const float infinity = std::bit_cast<float>(0x7f800000U);
    expect(!mesh.any_hit({{nan, 0, 1}, {0, 0, -1}}), "NaN hits nothing");
    expect(!mesh.any_hit({{0, 0, infinity}, {0, 0, -1}}), "infinity hits nothing");
    expect(mesh.statistics().invalid_queries == 2, "both are counted");
    try {
        const std::vector<pierce::Vec3<float>> bad = {corners[0], corners[1], {0, nan, 0}};
        const pierce::CollisionMesh<float> refused({bad, triangles});
        expect(false, "a vertex that is not a number is refused");
    } catch (const pierce::MeshError&) {
    }
    return failures == 0 ? 0 : 1;
}
