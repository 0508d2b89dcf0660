// A user's program that is compiled without exceptions and without type information: the headers' own code included, it
// does what it does elsewhere. (Not with OpenMesh, whose meshes need both.) Ends with status 1 and a line for each
// thing that is not so.
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <pierce/fans.h>
#include <pierce/kernels.h>
#include <pierce/pierce.h>

#include "no_exceptions.h"
#if defined(PIERCE_TEST_TBB)
#include <pierce/tbb.h>
#endif

#if defined(__cpp_exceptions) || defined(__cpp_rtti)
#error "this file is to be compiled with -fno-exceptions -fno-rtti"
#endif

namespace {

using pierce::Vec3;

int failures = 0;

void expect(bool truth, const char* what) {
    if (truth) return;
    std::printf("not so: %s\n", what);
    ++failures;
}

const std::vector<Vec3<double>> corners = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
const std::vector<pierce::IndexTriple> triangles = {{0, 1, 2}, {0, 2, 3}};
const pierce::MeshView<double> square{corners, triangles};
const Vec3<double> from{3, 1, 1};
const Vec3<double> to{3, 1, -1};

void queries() {
    pierce::BuildOptions options;
#if defined(PIERCE_TEST_TBB)
    options.executor = pierce::tbb_executor();
#endif
    const pierce::CollisionMesh<double> mesh(square, options);
    const auto hit = mesh.first_hit({from, to});
    expect(hit && hit->face == 0 && hit->exact_fraction == 0.5, "a segment hits a triangle half way");
    expect(mesh.mesh_report().border_edges == 4, "a square has four borders");
}

template <class Kernel>
void kernel(const Kernel& tested, const char* name) {
    const auto stored = tested.prepare(corners[0], corners[1], corners[2]);
    const auto hit = tested.test(stored, from, to);
    expect(hit && hit->fraction == 0.5, name);
}

void kernels() {
    using namespace pierce::kernels;
    kernel(bloom, "bloom");
    kernel(baldwin_weber_12, "baldwin_weber_12");
    kernel(baldwin_weber_9, "baldwin_weber_9");
    kernel(moller_trumbore, "moller_trumbore");
    kernel(cramer, "cramer");
    kernel(mcguire, "mcguire");
    kernel(watertight, "watertight");
    kernel(exact, "exact");
    kernel(triangle_fan, "triangle_fan");
}

void fans() {
    const auto found = pierce::fans_of(square);
    expect(found.size() == 1, "a square is one fan");
    const auto hit = pierce::kernels::triangle_fan.test(pierce::prepare(square, found.front()), from, to);
    expect(hit && hit->fraction == 0.5, "which a segment hits half way");
}

void meet_an_error() {
    const std::vector<pierce::IndexTriple> wrong = {{0, 1, 7}};
    static_cast<void>(pierce::fans_of(pierce::MeshView<double>{corners, wrong}));
    std::puts("not so: an index out of range is an error");
}

}  // namespace

int main() {
    queries();
    kernels();
    fans();
    if (caught(&meet_an_error) != "triangle 0: vertex index 7 is out of range (4 vertices)") {
        std::puts("not so: a caller with exceptions catches what a header's code without them meets");
        ++failures;
    }
    return failures == 0 ? 0 : 1;
}
