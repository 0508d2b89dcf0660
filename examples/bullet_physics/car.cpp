// See car.h.
#include "bullet_physics/car.h"

namespace bullet_physics {

World::World(btCollisionShape& shape) : ground(0, nullptr, &shape) {
    dynamics.setGravity({0, -9.81f, 0});
    dynamics.addRigidBody(&ground);
    dynamics.updateAabbs();  // as each step does
}

Car::Car(btCollisionShape& ground, const btVector3& start, const MakeRaycaster& make_raycaster) : world_(ground) {
    btTransform place;
    place.setIdentity();
    place.setOrigin({0, 1, 0});  // above the center of mass: a car that does not turn over
    chassis_.addChildShape(place, &box_);
    constexpr float k_mass = 800;
    btVector3 inertia;
    chassis_.calculateLocalInertia(k_mass, inertia);
    body_ = std::make_unique<btRigidBody>(k_mass, nullptr, &chassis_, inertia);
    place.setOrigin(start);
    body_->setWorldTransform(place);
    body_->setActivationState(DISABLE_DEACTIVATION);
    world_.dynamics.addRigidBody(body_.get());

    btRaycastVehicle::btVehicleTuning tuning;
    tuning.m_suspensionStiffness = 20;
    tuning.m_suspensionDamping = 2.3f;
    tuning.m_suspensionCompression = 4.4f;
    tuning.m_frictionSlip = 2;
    raycaster_ = make_raycaster(world_);
    vehicle_ = std::make_unique<btRaycastVehicle>(tuning, body_.get(), raycaster_.get());
    vehicle_->setCoordinateSystem(0, 1, 2);
    for (const float z : {1.5f, -1.5f})
        for (const float x : {1.0f, -1.0f})
            vehicle_->addWheel({x, 0.6f, z}, {0, -1, 0}, {-1, 0, 0}, 0.6f, 0.5f, tuning, z > 0);
    world_.dynamics.addAction(vehicle_.get());
}

Car::~Car() {
    world_.dynamics.removeAction(vehicle_.get());
    world_.dynamics.removeRigidBody(body_.get());
}

void Car::step(float seconds) {
    const bool is_fast = vehicle_->getCurrentSpeedKmHour() > 43;
    for (const int rear : {2, 3}) vehicle_->applyEngineForce(is_fast ? 0 : 1000, rear);
    for (const int front : {0, 1}) vehicle_->setSteeringValue(0.05f, front);
    world_.dynamics.stepSimulation(seconds, 0);  // just this step
    wheels_on_the_ground_ = 0;
    for (int i = 0; i < vehicle_->getNumWheels(); ++i)
        wheels_on_the_ground_ += vehicle_->getWheelInfo(i).m_raycastInfo.m_isInContact;
}

btVector3 Car::wheel(int i) const {
    vehicle_->updateWheelTransform(i, false);
    return vehicle_->getWheelTransformWS(i).getOrigin();
}

}  // namespace bullet_physics
