// ODE: a ray geom against a trimesh geom, asked by dCollide. Rays are in double, as Debian builds it; the mesh and what
// is computed from it are in float.
#include <array>
#include <cstdint>
#include <stdexcept>

#include <ode/ode.h>

#include "peers.h"

namespace pierce::bench {
namespace {

static_assert(sizeof(dReal) == sizeof(double) && sizeof(dTriIndex) == sizeof(std::uint32_t));

void start_ode() {
    static const bool has_started =
        dInitODE2(0) != 0 && dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
    if (!has_started) throw std::runtime_error("ODE does not start");
}

class Ode : public Peer {
  public:
    Ode(const TriangleSoup<float>& soup, Backs backs) : soup_(soup) {
        start_ode();
        data_ = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data_, soup_.positions.data(), sizeof(Vec3<float>),
                                    static_cast<int>(soup_.positions.size()), soup_.triangles.data(),
                                    static_cast<int>(3 * soup_.triangles.size()), sizeof(IndexTriple));
        mesh_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
        ray_ = dCreateRay(nullptr, 1);
        dGeomRaySetFirstContact(ray_, 0);
        dGeomRaySetBackfaceCull(ray_, backs == Backs::culled ? 1 : 0);
    }
    ~Ode() override {
        dGeomDestroy(ray_);
        dGeomDestroy(mesh_);
        dGeomTriMeshDataDestroy(data_);
    }

    [[nodiscard]] Point rounded(const Point& p) const override { return p; }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        Contacts contacts;
        if (collide(from, to, true, contacts) == 0) return std::nullopt;
        const auto vector = [](const dReal* v) { return Point(v[0], v[1], v[2]); };
        return Stop{vector(contacts[0].pos), vector(contacts[0].normal).normalized()};
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override {
        Contacts contacts;
        return collide(from, to, false, contacts);
    }

  private:
    using Contacts = std::array<dContactGeom, 64>;

    std::size_t collide(const Point& from, const Point& to, bool closest, Contacts& contacts) const {
        const Point way = to - from;
        if (way == Point::Zero()) return 0;  // a ray needs a direction
        dGeomRaySetClosestHit(ray_, closest ? 1 : 0);
        dGeomRaySet(ray_, from.x(), from.y(), from.z(), way.x(), way.y(), way.z());
        dGeomRaySetLength(ray_, way.norm());
        return static_cast<std::size_t>(dCollide(ray_, mesh_, static_cast<int>(contacts.size()), contacts.data(),
                                                 static_cast<int>(sizeof(dContactGeom))));
    }

    TriangleSoup<float> soup_;  // the mesh reads its arrays
    dTriMeshDataID data_;
    dGeomID mesh_, ray_;
};

}  // namespace

std::unique_ptr<Peer> make_ode(const TriangleSoup<float>& soup, Backs backs) {
    return std::make_unique<Ode>(soup, backs);
}
std::string ode_version() { return dODE_VERSION; }

}  // namespace pierce::bench
