// A segment through a triangle hits it.
#include <vector>

#include <pierce/pierce.h>

int main() {
    const std::vector<pierce::Vec3<float>> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<pierce::IndexTriple> triangles = {{0, 1, 2}};
    const pierce::CollisionMesh<float> mesh({corners, triangles});
    const Eigen::Vector3f from(0.25f, 0.25f, 1), to(0.25f, 0.25f, -1);
    return mesh.first_hit({from, to}) ? 0 : 1;
}
