// A car of Bullet's, btRaycastVehicle, with a world of its own: a ground and who answers its rays.
#pragma once

#include <functional>
#include <memory>

#include <btBulletDynamicsCommon.h>

namespace bullet_physics {

/// A Bullet world with one static body, the ground.
struct World {
    explicit World(btCollisionShape& shape);
    ~World() { dynamics.removeRigidBody(&ground); }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld dynamics{&dispatcher, &broadphase, &solver, &configuration};
    btRigidBody ground;
};

class Car {
  public:
    using MakeRaycaster = std::function<std::unique_ptr<btVehicleRaycaster>(World&)>;

    /// Stands at `start`, and looks along z.
    Car(btCollisionShape& ground, const btVector3& start, const MakeRaycaster& make_raycaster);
    ~Car();
    Car(const Car&) = delete;
    Car& operator=(const Car&) = delete;

    /// Goes on by a step, in a wide circle, at some 12 m/s.
    void step(float seconds);

    [[nodiscard]] btVector3 position() const { return body_->getWorldTransform().getOrigin(); }
    [[nodiscard]] btVector3 wheel(int i) const;
    /// In the last step.
    [[nodiscard]] int wheels_on_the_ground() const { return wheels_on_the_ground_; }

  private:
    World world_;
    btBoxShape box_{{1, 0.5f, 2}};
    btCompoundShape chassis_;
    std::unique_ptr<btRigidBody> body_;
    std::unique_ptr<btVehicleRaycaster> raycaster_;
    std::unique_ptr<btRaycastVehicle> vehicle_;
    int wheels_on_the_ground_ = 0;
};

}  // namespace bullet_physics
