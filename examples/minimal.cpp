// The smallest program that uses pierce: a point moves through a triangle. Where must it stop?
#include <iostream>
#include <vector>

#include <pierce/pierce.h>

int main() {
    const std::vector<pierce::Vec3<double>> corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const std::vector<pierce::IndexTriple> triangles = {{0, 1, 2}};  // counter-clockwise seen from above, its front
    const pierce::CollisionMesh<double> floor({corners, triangles});

    const Eigen::Vector3d from(1, 1, 3), to(1, 1, -1);
    if (const auto hit = floor.sweep(from, to))
        std::cout << "hits face " << hit->face << " after " << hit->time_of_impact << " of the step: stop at height "
                  << hit->point.z() << '\n';
    else
        std::cout << "free to move\n";
}
