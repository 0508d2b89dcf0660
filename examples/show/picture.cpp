// See picture.h. All geometry is in double; a segment is rounded to the mesh's scalar type only to be cast.
#include "show/picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include <Eigen/Geometry>

namespace show {
namespace {

/// Where the key light comes from, in the camera's axes: over the left shoulder.
const Point key_light = Point(-0.55, 0.65, 0.52).normalized();

/// The colour of light that comes back from a face with this normal, which points to the side that is seen. Both
/// directions in the camera's axes.
Colour shade(const Point& normal, const Point& to_eye, const Colour& paint, bool in_shadow) {
    const auto key = static_cast<float>(in_shadow ? 0.0 : std::max(0.0, normal.dot(key_light)));
    const auto fill = static_cast<float>(std::pow(0.5 + 0.5 * normal.dot(key_light), 2));  // no face is black
    const auto head = static_cast<float>(std::max(0.0, normal.dot(to_eye)));
    const auto sky = static_cast<float>(0.5 + 0.5 * normal.y());
    const double glance = std::max(0.0, normal.dot((key_light + to_eye).normalized()));
    const auto gloss = static_cast<float>(in_shadow ? 0.0 : std::pow(glance, 40));

    const Colour light = Colour(1.0f, 0.94f, 0.85f) * (0.65f * key + 0.35f * fill) + Colour::Constant(0.2f * head) +
                         Colour(0.65f, 0.8f, 1.0f) * (0.14f * sky);
    return paint * light + 0.06f * gloss;
}

/// Lighter in the middle and below, so that the mesh stands out against it.
Colour background(double x, double y) {
    const Colour bottom(0.50f, 0.50f, 0.49f), top(0.10f, 0.12f, 0.15f);
    const auto height = static_cast<float>(0.5 + 0.5 * y);
    return (bottom + (top - bottom) * height) * (1 - 0.09f * static_cast<float>(x * x + y * y));
}

template <class Scalar>
void draw_sample(const pierce::CollisionMesh<Scalar>& mesh, const Camera& camera, const Paint& paint, Canvas& canvas,
                 int column, int row) {
    const double x = canvas.x(column), y = canvas.y(row);
    const Point& from = camera.eye();
    const Point to = camera.end_of_sight(x, y);
    const auto hit = mesh.first_hit({from.cast<Scalar>(), to.cast<Scalar>()}, {.sides = paint.sides});
    if (!hit) {
        canvas.set(column, row, background(x, y), std::numeric_limits<float>::infinity());
        return;
    }
    const Point normal = camera.axes().transpose() * hit->facing().template cast<double>();
    const Point to_eye = (camera.axes().transpose() * (from - to)).stableNormalized();
    // The hit's point is never beyond the face, so the face can't shade itself: no offset is needed.
    const Point light = hit->point.template cast<double>() + camera.depth() * (camera.axes() * key_light);
    const bool in_shadow = paint.sides == pierce::Sides::both && normal.dot(key_light) > 0 &&
                           mesh.any_hit({hit->point, light.cast<Scalar>()}, {.sides = hit->side});
    const Colour& colour = hit->side == pierce::Sides::front ? paint.front : paint.back;
    canvas.set(column, row, shade(normal, to_eye, colour, in_shadow),
               static_cast<float>(static_cast<double>(hit->fraction) * camera.depth()));
}

}  // namespace

template <class Scalar>
void draw(const pierce::CollisionMesh<Scalar>& mesh, const Camera& camera, Canvas& canvas, unsigned threads,
          const Paint& paint, const std::function<void()>& row_is_drawn) {
    // All that is cast stays within this distance of the origin. Not written with >, for it may be NaN.
    if (!(camera.eye().stableNorm() + 3 * camera.depth() < std::numeric_limits<Scalar>::max()))
        throw std::runtime_error("the mesh is too large for a picture");

    std::atomic<int> next_row = 0;
    const auto draw_rows = [&] {
        for (int row = next_row++; row < canvas.rows(); row = next_row++) {
            for (int column = 0; column < canvas.columns(); ++column)
                draw_sample(mesh, camera, paint, canvas, column, row);
            if (row_is_drawn) row_is_drawn();
        }
    };
    std::vector<std::jthread> helpers;  // the answers do not depend on how many there are
    for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(draw_rows);
    draw_rows();
}

template void draw(const pierce::CollisionMesh<float>&, const Camera&, Canvas&, unsigned, const Paint&,
                   const std::function<void()>&);
template void draw(const pierce::CollisionMesh<double>&, const Camera&, Canvas&, unsigned, const Paint&,
                   const std::function<void()>&);

}  // namespace show
