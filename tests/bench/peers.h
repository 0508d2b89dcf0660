// What is measured: pierce and the libraries that people use in its place, a thin class for each, behind one interface.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pierce/triangle_soup.h>
#include <pierce/types.h>

namespace pierce::bench {

using Point = Vec3<double>;

/// Where a library says that a moving point runs into the mesh, as its users compute it, and the normal there.
struct Stop {
    Point point;
    Point normal;
};

class Peer {
  public:
    Peer() = default;
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;
    virtual ~Peer() = default;

    /// The place nearest to `p` that the library can be asked about: it takes float or double.
    [[nodiscard]] virtual Point rounded(const Point& p) const = 0;
    /// The first hit of the segment; its ends are `rounded`, and so is the point of the answer.
    [[nodiscard]] virtual std::optional<Stop> first(const Point& from, const Point& to) const = 0;
    /// How many triangles the library reports when it is asked for all.
    [[nodiscard]] virtual std::size_t count(const Point& from, const Point& to) const = 0;
    /// How often the surface is crossed from front to back less how often from back to front, if the library can tell.
    [[nodiscard]] virtual std::optional<int> crossings(const Point& /*from*/, const Point& /*to*/) const { return {}; }
};

/// What counts where a library leaves it to its user. Backs are culled the way its users do it: by the sign of normal
/// times direction, for each candidate. Libraries with a choice of their own ignore this.
enum class Backs { count, culled };

struct Library {
    std::string name;
    std::unique_ptr<Peer> (*make)(const TriangleSoup<float>& soup, Backs backs);
    bool is_pierce = false;
    bool hangs_at_ends = false;  ///< its calls may not return where a segment ends on a triangle
};

std::unique_ptr<Peer> make_pierce_float(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_pierce_double(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_embree_default(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_embree_robust(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_bullet_default(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_bullet_front(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_cgal(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_ode(const TriangleSoup<float>& soup, Backs backs);
std::unique_ptr<Peer> make_fcl(const TriangleSoup<float>& soup, Backs backs);

std::string embree_version();
std::string bullet_version();
std::string cgal_version();
std::string ode_version();
std::string fcl_version();

/// pierce, which looks at the fronts of faces, and the others. ODE and FCL where the build found them.
inline std::vector<Library> libraries() {
    std::vector<Library> all = {{.name = "**pierce**, float", .make = make_pierce_float, .is_pierce = true},
                                {.name = "**pierce**, double", .make = make_pierce_double, .is_pierce = true},
                                {.name = "Embree", .make = make_embree_default},
                                {.name = "Embree, robust", .make = make_embree_robust},
                                {.name = "Bullet", .make = make_bullet_default},
                                {.name = "Bullet, backs filtered", .make = make_bullet_front},
                                {.name = "CGAL", .make = make_cgal}};
#ifdef PIERCE_BENCH_ODE
    all.push_back({.name = "ODE", .make = make_ode});
#endif
#ifdef PIERCE_BENCH_FCL
    all.push_back({.name = "FCL", .make = make_fcl, .hangs_at_ends = true});
#endif
    return all;
}

}  // namespace pierce::bench
