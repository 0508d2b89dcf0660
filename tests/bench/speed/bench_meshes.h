// What is asked: real meshes, of ../shared/meshes where there are any and of libcgal-demo, and bumpy spheres.
#pragma once

#include <string>
#include <vector>

#include <pierce/triangle_soup.h>

namespace pierce::bench {

enum class MeshKind {
    real,     ///< the medians are over these
    stadium,  ///< a teapot in a stadium, which has lines of its own
    sphere    ///< generated, for the scaling with the face count
};

struct BenchMesh {
    std::string name;
    MeshKind kind;
    std::string path;   ///< of a file, or empty
    int divisions = 0;  ///< of a sphere, of 8 * divisions^2 faces

    [[nodiscard]] TriangleSoup<float> load() const;
};

/// Those that there are, smallest files first within a kind. `large` adds the sphere of 10 M faces.
std::vector<BenchMesh> bench_meshes(bool large);

}  // namespace pierce::bench
