// pierce inside Bullet: what a program takes over from this example. Rays of vehicles, and all rays that a
// btCollisionWorld casts, are answered by a pierce::CollisionMesh; contacts of bodies stay Bullet's.
#pragma once

#include <vector>

#include <btBulletDynamicsCommon.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <pierce/collision_mesh.h>

namespace bullet_physics {

static_assert(sizeof(btScalar) == sizeof(float), "a Bullet in double needs a CollisionMesh<double>");

inline pierce::Vec3<float> to_pierce(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline btVector3 to_bullet(const pierce::Vec3<float>& v) { return {v.x(), v.y(), v.z()}; }

/// Casts a vehicle's rays at a mesh in world coordinates, without a way through Bullet's world. A wheel is drawn where
/// it meets the ground, so it takes `position`; a particle that goes on from there would take `point`.
class PierceRaycaster : public btVehicleRaycaster {
  public:
    PierceRaycaster(const pierce::CollisionMesh<float>& mesh, btRigidBody& ground) : mesh_(mesh), ground_(ground) {}

    void* castRay(const btVector3& from, const btVector3& to, btVehicleRaycasterResult& result) override {
        const auto hit = mesh_.first_hit({to_pierce(from), to_pierce(to)}, {.sides = pierce::Sides::both});
        if (!hit) return nullptr;
        result.m_hitPointInWorld = to_bullet(hit->position.vec());
        result.m_hitNormalInWorld = to_bullet(hit->facing());
        result.m_distFraction = hit->exact_fraction;
        return &ground_;
    }

  private:
    const pierce::CollisionMesh<float>& mesh_;
    btRigidBody& ground_;
};

/// A static mesh whose ray tests are pierce's: `rayTest` with any callback, on a body that stands anywhere. All else,
/// contacts and convex sweeps, goes to the triangles that Bullet's own tree finds. Local scaling is not passed on.
class PierceShape : public btBvhTriangleMeshShape {
  public:
    PierceShape(const pierce::CollisionMesh<float>& mesh, btStridingMeshInterface* triangles)
        : btBvhTriangleMeshShape(triangles, true), mesh_(mesh) {
        // Bullet casts rays at its own kind of mesh by a function that is not virtual, but at others by the one below.
        // This number is for the meshes of other libraries; CUSTOM_CONCAVE_SHAPE_TYPE is that of signed distances now.
        m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
    }

    void processAllTriangles(btTriangleCallback* callback, const btVector3& low, const btVector3& high) const override {
        if (auto* ray = dynamic_cast<btTriangleRaycastCallback*>(callback))
            cast(*ray);
        else
            btBvhTriangleMeshShape::processAllTriangles(callback, low, high);
    }

  private:
    void cast(btTriangleRaycastCallback& ray) const {
        const pierce::Segment<float> way{to_pierce(ray.m_from), to_pierce(ray.m_to)};
        const bool fronts_only = (ray.m_flags & btTriangleRaycastCallback::kF_FilterBackfaces) != 0;
        const pierce::QueryOptions options = {.sides = fronts_only ? pierce::Sides::front : pierce::Sides::both,
                                              .max_fraction = double(ray.m_hitFraction)};
        const auto first = mesh_.first_hit(way, options);
        if (!first) return;
        report(ray, *first);
        if (ray.m_hitFraction <= first->exact_fraction) return;
        // The callback wants more than the first one: all hits, or the next where it has no use for this one.
        std::vector<pierce::Hit<float>> hits(mesh_.all_hits(way, {}, options));
        mesh_.all_hits(way, hits, options);
        for (std::size_t i = 1; i < hits.size() && hits[i].exact_fraction <= ray.m_hitFraction; ++i)
            report(ray, hits[i]);
    }

    static void report(btTriangleRaycastCallback& ray, const pierce::Hit<float>& hit) {
        const bool as_it_is = (ray.m_flags & btTriangleRaycastCallback::kF_KeepUnflippedNormal) != 0;
        const pierce::Vec3<float> normal = as_it_is ? hit.normal.vec() : hit.facing();
        ray.m_hitFraction = ray.reportHit(to_bullet(normal), hit.exact_fraction, 0, static_cast<int>(hit.triangle));
    }

    const pierce::CollisionMesh<float>& mesh_;
};

}  // namespace bullet_physics
