// Where do segments and particles get through a closed mesh that should not? pierce and its peers, side by side.
//   trust [--quick]
// Prints Markdown. Ends with status 1 if pierce breaks a promise anywhere, else 0.
#include <chrono>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>

#include "experiments.h"

namespace {

constexpr std::string_view k_what_is_called = R"(What is called, and what it promises:

- **pierce**: `first_hit`, `all_hits` and `crossings`, for fronts of faces. Promises that all decisions are exact, and
  that a particle which is moved to the returned point and stepped again never gets through a closed mesh.
- **Embree**: `rtcIntersect1` from 0 to 1 along `to - from`, with the point `from + t * (to - from)`, in float; for all
  hits a filter function that rejects them one by one. Both sides count, as Debian builds it, if nothing else is said.
  Robust is `RTC_SCENE_FLAG_ROBUST`, "typically used for avoiding artifacts caused by rays shooting through edges". The
  manual makes no guarantee for hits at the ends of a ray or close to them, and warns of two reports for one edge.
  Figures may differ on another processor, for which Embree has other code.
- **Bullet**, in float: `btCollisionWorld::rayTest` on a `btBvhTriangleMeshShape` with quantized boxes, which its header
  recommends; the closest-hit callback and its point, and the all-hits callback. Both sides count, or fronts only with
  `kF_FilterBackfaces`. We found no promise about seams or ends.
- **CGAL**: `AABB_tree` with exact predicates and inexact constructions, in double: the nearest of `all_intersections`,
  as there is no first one for segments, and `number_of_intersected_primitives`. Both sides count, and so do ends. The
  decisions are exact by contract, the points are rounded.
- **ODE**: `dCollide` of a ray with a trimesh, which keeps its vertices in float, for the closest hit, or for all with
  room for 64 contacts. Both sides count, or fronts only with `dGeomRaySetBackfaceCull`. We found no promise about seams
  or ends.
- **FCL**, in double: `fcl::collide` of a `BVHModel<OBBRSS>` with a capsule of radius 0, as FCL has no rays, with its
  default solver and room for 1,000 contacts. What is first is computed from the planes of the triangles reported, as
  its users have to. Both sides count. Contacts are found by an iterative method with a tolerance; where a capsule ends
  on a triangle it may go on for ever, so tables 4 and 5 do not ask. We found no promise about seams or ends.

)";

/// Versions of those that a build may do without.
std::string peers_by_choice() {
    std::string names;
#ifdef PIERCE_BENCH_ODE
    names += ", ODE " + pierce::bench::ode_version();
#else
    names += ", no ODE (libode-dev was not found)";
#endif
#ifdef PIERCE_BENCH_FCL
    names += ", FCL " + pierce::bench::fcl_version();
#else
    names += ", no FCL (libfcl-dev was not found)";
#endif
    return names;
}

int measure(bool quick) {
    using namespace pierce::bench;
    const auto start = std::chrono::steady_clock::now();
    std::cout << "Embree " << embree_version() << ", Bullet " << bullet_version() << ", CGAL " << cgal_version()
              << peers_by_choice() << ", as Debian builds them.\n\n"
              << k_what_is_called;
    Run run(quick);
    seams(run);
    repeated_steps(run);
    scales(run);
    ends_on_the_plane(run);
    collide_and_slide(run);
    lost_particles(run);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    std::cerr << "took " << static_cast<int>(taken.count()) << " s; promises broken by pierce: " << run.failures()
              << '\n';
    return run.failures() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const bool quick = argc == 2 && std::string_view(argv[1]) == "--quick";
    if (argc > 2 || (argc == 2 && !quick)) {
        std::cerr << "usage: trust [--quick]\n";
        return 2;
    }
    try {
        return measure(quick);
    } catch (const std::exception& error) {
        std::cerr << "trust: " << error.what() << '\n';
        return 2;
    }
}
