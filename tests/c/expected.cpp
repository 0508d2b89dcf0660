// What the C++ interface answers on the two cubes.
#include "expected.h"

#include <cstring>

#include <pierce/pierce.h>

namespace {

template <class Scalar, class Outside>
void first_hits(const vertex* vertices, const std::uint16_t* indices, const Scalar* segments, std::size_t count,
                Outside* hits) {
    static_assert(sizeof(Outside) == sizeof(pierce::Hit<Scalar>));
    const pierce::PointsView<Scalar> positions(vertices[0].position, CUBE_CORNERS, sizeof(vertex));
    const pierce::CollisionMesh<Scalar> mesh({positions, pierce::TrianglesView(indices, CUBE_FACES)});
    for (std::size_t i = 0; i < count; ++i) {
        const Scalar* s = segments + 6 * i;
        const pierce::Vec3<Scalar> from(s[0], s[1], s[2]), to(s[3], s[4], s[5]);
        const auto hit = mesh.first_hit({from, to}, {.sides = pierce::Sides::both});
        const pierce::Hit<Scalar> value = hit.value_or(pierce::no_hit<Scalar>);
        std::memcpy(&hits[i], &value, sizeof value);
    }
}

}  // namespace

void expected_first_hits_f(const vertex* vertices, const std::uint16_t* indices, const float* segments,
                           std::size_t count, pierce_hit_f* hits) {
    first_hits(vertices, indices, segments, count, hits);
}
void expected_first_hits_d(const vertex* vertices, const std::uint16_t* indices, const double* segments,
                           std::size_t count, pierce_hit_d* hits) {
    first_hits(vertices, indices, segments, count, hits);
}
