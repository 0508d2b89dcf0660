// Bullet: a world with one btBvhTriangleMeshShape, asked by btCollisionWorld::rayTest.
#include "bullet_shape.h"
#include "peers.h"

namespace pierce::bench {
namespace {

btVector3 to_bullet(const Point& p) {
    const Vec3<float> q = p.cast<float>();
    return {q[0], q[1], q[2]};
}
Point from_bullet(const btVector3& p) { return {double(p.x()), double(p.y()), double(p.z())}; }

class Bullet : public Peer {
  public:
    Bullet(const TriangleSoup<float>& soup, unsigned flags) : soup_(soup), flags_(flags) {
        object_.setCollisionShape(&shape_.get());
        world_.addCollisionObject(&object_);
    }
    ~Bullet() override { world_.removeCollisionObject(&object_); }

    [[nodiscard]] Point rounded(const Point& p) const override { return p.cast<float>().cast<double>(); }

    [[nodiscard]] std::optional<Stop> first(const Point& from, const Point& to) const override {
        btCollisionWorld::ClosestRayResultCallback closest(to_bullet(from), to_bullet(to));
        closest.m_flags |= flags_;
        world_.rayTest(closest.m_rayFromWorld, closest.m_rayToWorld, closest);
        if (!closest.hasHit()) return std::nullopt;
        return Stop{from_bullet(closest.m_hitPointWorld), from_bullet(closest.m_hitNormalWorld).normalized()};
    }
    [[nodiscard]] std::size_t count(const Point& from, const Point& to) const override {
        btCollisionWorld::AllHitsRayResultCallback all(to_bullet(from), to_bullet(to));
        all.m_flags |= flags_;
        world_.rayTest(all.m_rayFromWorld, all.m_rayToWorld, all);
        return static_cast<std::size_t>(all.m_hitFractions.size());
    }

  private:
    TriangleSoup<float> soup_;  // the shape reads its arrays
    unsigned flags_;
    BulletShape shape_{soup_.view()};
    btCollisionObject object_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
};

}  // namespace

std::unique_ptr<Peer> make_bullet_default(const TriangleSoup<float>& soup, Backs) {
    return std::make_unique<Bullet>(soup, btTriangleRaycastCallback::kF_None);
}
std::unique_ptr<Peer> make_bullet_front(const TriangleSoup<float>& soup, Backs) {
    return std::make_unique<Bullet>(soup, btTriangleRaycastCallback::kF_FilterBackfaces);
}
std::string bullet_version() {
    return std::to_string(btGetVersion() / 100) + '.' + std::to_string(btGetVersion() % 100);
}

}  // namespace pierce::bench
