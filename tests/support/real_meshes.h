// Real meshes: some of those that Debian's libcgal-demo holds, unpacked by tests/CMakeLists.txt.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <pierce/triangle_soup.h>

namespace pierce::test {

/// Scans, CAD parts and characters, 300 to 12,000 triangles: closed and open, some with self-intersections, polygons or
/// several components.
inline constexpr std::array<std::string_view, 14> k_real_meshes = {
    "blobby",   "bones",   "boeing", "bull",  "cheese", "couplingdown", "cow",
    "elephant", "eight", "fandisk", "handle", "knot1", "pig",          "rotor"};

template <class Scalar>
TriangleSoup<Scalar> real_mesh(std::string_view name) {
    return read_mesh<Scalar>(std::string(PIERCE_CGAL_MESHES) + "/" + std::string(name) + ".off");
}

}  // namespace pierce::test
