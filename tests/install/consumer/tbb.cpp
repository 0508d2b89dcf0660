// Many segments through one triangle, on the threads of oneTBB.
#include <array>
#include <cstdio>
#include <vector>

#include <pierce/pierce.h>
#include <pierce/tbb.h>

int main() {
    const std::array<pierce::Vec3<float>, 3> positions = {pierce::Vec3<float>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::array<pierce::IndexTriple, 1> triangles = {{{0, 1, 2}}};
    const pierce::CollisionMesh<float> mesh({positions, triangles}, {.executor = pierce::tbb_executor()});
    const pierce::Segment<float> down{pierce::Vec3<float>{0.25F, 0.25F, 1}, pierce::Vec3<float>{0.25F, 0.25F, -1}};
    const std::vector<pierce::Segment<float>> segments(10000, down);
    std::vector<std::uint8_t> hit(segments.size());
    if (mesh.any_hits(segments, hit, {}, pierce::tbb_executor()) != segments.size()) {
        std::puts("not all of them hit");
        return 1;
    }
    return 0;
}
