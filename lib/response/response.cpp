// The façade of responses: velocities by themselves, and where to draw what touches something; in standard arithmetic.
#include <pierce/response.h>

#include <environment.h>
#include <query/half_spaces.h>
#include <query/ways.h>
#include <response/velocity.h>

namespace pierce {

using namespace detail;

namespace {

// A power of two of about the largest component, so that squares stay in range; NaN and 0: 1.
double scale_of(const Point& p, const Point& q) {
    double most = 0;
    for (const double x : {p[0], p[1], p[2], q[0], q[1], q[2]}) most = std::max(most, std::abs(x));
    return most > 0 && std::isfinite(most) ? std::ldexp(1.0, std::clamp(std::ilogb(most), -1000, 1000)) : 1;
}

template <class Scalar>
Vec3<Scalar> to_vector(double scale, const Point& p) {
    return {static_cast<Scalar>(scale * p[0]), static_cast<Scalar>(scale * p[1]), static_cast<Scalar>(scale * p[2])};
}

// Not inlined: see environment.h.
template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> bounce_of(const Vec3<Scalar>& velocity, const Vec3<Scalar>& normal,
                                         const Vec3<Scalar>& surface_velocity, Scalar restitution, Scalar friction) {
    const Point before = to_point(velocity);
    const Point with = to_point(surface_velocity);
    const double scale = scale_of(before, with);
    const Wall wall{to_point(normal), times(1 / scale, with), static_cast<double>(friction)};
    const Point after = bounced(times(1 / scale, before), wall, static_cast<double>(restitution));
    return to_vector<Scalar>(scale, after);
}

template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> slide_of(const Vec3<Scalar>& velocity, std::span<const Vec3<Scalar>> normals) {
    const Point before = to_point(velocity);
    if (normals.empty() || !are_finite(before)) return velocity;
    std::array<Wall, k_most_planes> walls{};
    const std::size_t count = std::min(normals.size(), k_most_planes);
    for (std::size_t i = 0; i < count; ++i) walls[i].normal = to_point(normals[i]);
    const double scale = scale_of(before, {});
    const Point scaled = times(1 / scale, before);
    return to_vector<Scalar>(scale, Resolver({walls.data(), count}, scaled, k_alike<Scalar>).nearest().velocity);
}

template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> lifted_from(const Vec3<Scalar>& position, std::span<const MoveContact<Scalar>> contacts,
                                           Scalar skin) {
    if (!(skin > 0) || !std::isfinite(skin)) return position;
    HalfSpaces spaces;
    for (const MoveContact<Scalar>& contact : contacts)
        if (!spaces.full()) spaces.push({to_point(contact.normal.vec()), 1});
    Point lift{};
    constexpr double k_furthest = 8;
    if (!spaces.nearest(k_furthest, lift)) return position;
    return to_vector<Scalar>(1, plus(to_point(position), static_cast<double>(skin), lift));
}

}  // namespace

template <class Scalar>
Vec3<Scalar> slide(const Vec3<Scalar>& velocity, const std::type_identity_t<Vec3<Scalar>>& normal,
                   const std::type_identity_t<Vec3<Scalar>>& surface_velocity) noexcept {
    const StandardArithmetic standard;
    return bounce_of<Scalar>(velocity, normal, surface_velocity, 0, 0);
}

template <class Scalar>
Vec3<Scalar> slide(const Vec3<Scalar>& velocity, std::span<const std::type_identity_t<Vec3<Scalar>>> normals) noexcept {
    const StandardArithmetic standard;
    return slide_of<Scalar>(velocity, normals);
}

template <class Scalar>
Vec3<Scalar> bounce(const Vec3<Scalar>& velocity, const std::type_identity_t<Vec3<Scalar>>& normal,
                    std::type_identity_t<Scalar> restitution, std::type_identity_t<Scalar> friction,
                    const std::type_identity_t<Vec3<Scalar>>& surface_velocity) noexcept {
    const StandardArithmetic standard;
    return bounce_of<Scalar>(velocity, normal, surface_velocity, restitution, friction);
}

template <class Scalar>
Vec3<Scalar> lifted(const CollisionMesh<Scalar>& mesh, const std::type_identity_t<Vec3<Scalar>>& position,
                    std::type_identity_t<std::span<const MoveContact<Scalar>>> contacts,
                    std::type_identity_t<Scalar> skin, const QueryOptions& options) noexcept {
    const StandardArithmetic standard;
    const Vec3<Scalar> target = lifted_from<Scalar>(position, contacts, skin);
    if (!is_valid(Segment<Scalar>{position, target})) return position;
    const auto hit = mesh.first_hit({position, target}, options);
    return hit ? hit->point.vec() : target;
}

#define PIERCE_RESPONSES(Scalar)                                                                         \
    template Vec3<Scalar> slide(const Vec3<Scalar>&, const Vec3<Scalar>&, const Vec3<Scalar>&) noexcept; \
    template Vec3<Scalar> slide(const Vec3<Scalar>&, std::span<const Vec3<Scalar>>) noexcept;            \
    template Vec3<Scalar> bounce(const Vec3<Scalar>&, const Vec3<Scalar>&, Scalar, Scalar,               \
                                 const Vec3<Scalar>&) noexcept;                                          \
    template Vec3<Scalar> lifted(const CollisionMesh<Scalar>&, const Vec3<Scalar>&,                      \
                                 std::span<const MoveContact<Scalar>>, Scalar, const QueryOptions&) noexcept
PIERCE_RESPONSES(float);
PIERCE_RESPONSES(double);
#undef PIERCE_RESPONSES

}  // namespace pierce
