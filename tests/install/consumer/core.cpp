// A segment through one triangle, at exactly half its length.
#include <array>
#include <cstdio>

#include <pierce/pierce.h>

int main() {
    const std::array<pierce::Vec3<double>, 3> positions = {
        pierce::Vec3<double>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::array<pierce::IndexTriple, 1> triangles = {{{0, 1, 2}}};
    const pierce::CollisionMesh<double> mesh({positions, triangles});
    const auto hit = mesh.first_hit({pierce::Vec3<double>{0.25, 0.25, 1}, pierce::Vec3<double>{0.25, 0.25, -1}});
    if (!hit || hit->exact_fraction != 0.5 || hit->face != 0) {
        std::puts("no hit, or a wrong one");
        return 1;
    }
    return 0;
}
