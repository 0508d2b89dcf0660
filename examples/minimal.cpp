// The smallest program that uses pierce: a point moves through a triangle. Where must it stop?
#include <iostream>
#include <vector>

#include <pierce/pierce.h>

int main() {
    const std::vector<pierce::Vec3<double>> corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const std::vector<pierce::IndexTriple> triangles = {{0, 1, 2}};  // counter-clockwise seen from above, its front
    const pierce::CollisionMesh<double> floor({corners, triangles});

    Eigen::Vector3d particle(1, 1, 3);
    const Eigen::Vector3d target(1, 1, -1);
    // Fronts alone count unless `sides` says otherwise; with `both` the floor stops what comes from below as well.
    if (const auto hit = floor.sweep({particle, target}, {.sides = pierce::Sides::both})) {
        std::cout << "hits face " << hit->face << " at (" << hit->position << ") after " << hit->fraction
                  << " of the step\n";
        particle = hit->point;  // where to stop: in front of the face by a hair, with a clear way to it
    } else {
        particle = target;
    }
}
