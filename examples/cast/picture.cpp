// See picture.h. All geometry is in double; a segment is rounded to the mesh's scalar type only to be cast.
#include "cast/picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

#include <Eigen/Geometry>

#include "cast/numbers.h"

namespace {

using Point = pierce::Vec3<double>;
using Colour = Eigen::Array3d;  // linear light, 1 is white

constexpr double tangent_of_view = 0.27;  // of half the vertical angle: about 30 degrees in all

/// A camera that looks at the middle of the mesh from just so far that all of it is in view.
class Camera {
  public:
    template <class Scalar>
    Camera(const pierce::TriangleSoup<Scalar>& soup, const PictureOptions& options)
        : tangent_(tangent_of_view * options.width / options.height, tangent_of_view) {
        const double azimuth = options.azimuth * std::numbers::pi / 180;
        const double elevation = options.elevation * std::numbers::pi / 180;
        const Point side = Point::UnitX();
        const Point front = options.z_is_up ? Point(0, -1, 0) : Point(0, 0, 1);
        const Point up = options.z_is_up ? Point(0, 0, 1) : Point(0, 1, 0);
        axes_.col(0) = std::cos(azimuth) * side - std::sin(azimuth) * front;
        axes_.col(2) =
            std::cos(elevation) * (std::cos(azimuth) * front + std::sin(azimuth) * side) + std::sin(elevation) * up;
        axes_.col(1) = axes_.col(2).cross(axes_.col(0));
        frame(soup);
    }

    [[nodiscard]] const Point& eye() const { return eye_; }
    /// To the right, up, and towards the camera.
    [[nodiscard]] const Eigen::Matrix3d& axes() const { return axes_; }

    /// No two points of the mesh are further apart.
    [[nodiscard]] double depth() const { return depth_; }

    /// The end, behind the mesh, of the line of sight through a place in the picture: -1 is left and bottom.
    [[nodiscard]] Point end_of_sight(double x, double y) const {
        return eye_ + depth_ * (axes_ * Point(x * tangent_.x(), y * tangent_.y(), -1));
    }

  private:
    template <class Scalar>
    void frame(const pierce::TriangleSoup<Scalar>& soup) {
        const auto for_each_corner = [&](auto visit) {  // not the positions: some may belong to no triangle
            for (const auto& triangle : soup.triangles)
                for (const auto corner : triangle)
                    visit(Point(axes_.transpose() * soup.positions[corner].template cast<double>()));
        };
        Eigen::AlignedBox3d box;
        for_each_corner([&](const Point& point) { box.extend(point); });
        const Point middle = box.center();

        double distance = 0;
        const Eigen::Array2d inner = tangent_ * 0.92;  // leaves a margin
        for_each_corner([&](const Point& point) {
            const Eigen::Array3d offset = point - middle;
            distance = std::max(distance, offset.z() + (offset.head<2>().abs() / inner).maxCoeff());
        });
        eye_ = axes_ * (middle + Point(0, 0, distance));
        depth_ = 1.01 * (distance + middle.z() - box.min().z());
        // All that is cast stays within this distance of the origin. Not written with >, for it may be NaN.
        if (!(eye_.stableNorm() + 3 * depth_ < std::numeric_limits<Scalar>::max()))
            throw InputError("cast: the mesh is too large for a picture");
    }

    Eigen::Array2d tangent_;
    Eigen::Matrix3d axes_;
    Point eye_;
    double depth_ = 0;
};

/// Where the key light comes from, in the camera's axes: over the left shoulder.
const Point key_light = Point(-0.55, 0.65, 0.52).normalized();

/// The colour of light that comes back from a face with this normal, which points to the side that is seen. Both
/// directions in the camera's axes.
Colour shade(const Point& normal, const Point& to_eye, pierce::Sides side, bool in_shadow) {
    const double key = in_shadow ? 0.0 : std::max(0.0, normal.dot(key_light));
    const double fill = std::pow(0.5 + 0.5 * normal.dot(key_light), 2);  // wraps around: no face is black
    const double head = std::max(0.0, normal.dot(to_eye));
    const double sky = 0.5 + 0.5 * normal.y();
    const double gloss = in_shadow ? 0.0 : std::pow(std::max(0.0, normal.dot((key_light + to_eye).normalized())), 40);

    const Colour paint = side == pierce::Sides::front ? Colour(0.72, 0.52, 0.34) : Colour(0.22, 0.36, 0.52);
    const Colour light = Colour(1.0, 0.94, 0.85) * (0.65 * key + 0.35 * fill) + Colour::Constant(0.2 * head) +
                         Colour(0.65, 0.8, 1.0) * (0.14 * sky);
    return paint * light + 0.06 * gloss;
}

/// Lighter in the middle and below, so that the mesh stands out against it.
Colour background(double x, double y) {
    const Colour bottom(0.50, 0.50, 0.49), top(0.10, 0.12, 0.15);
    const double height = 0.5 + 0.5 * y;
    return (bottom + (top - bottom) * height) * (1 - 0.18 * (x * x + y * y) / 2);
}

std::uint8_t to_srgb(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(encoded * 255));
}

template <class Scalar>
Colour look(const pierce::CollisionMesh<Scalar>& mesh, const Camera& camera, double x, double y) {
    const Point& from = camera.eye();
    const Point to = camera.end_of_sight(x, y);
    const auto hit = mesh.first_hit({from.cast<Scalar>(), to.cast<Scalar>()}, {.sides = pierce::Sides::both});
    if (!hit) return background(x, y);
    const Point normal = camera.axes().transpose() * hit->facing().template cast<double>();
    const Point to_eye = (camera.axes().transpose() * (from - to)).stableNormalized();
    // The hit's point is never beyond the face, so the face can't shade itself: no offset is needed.
    const Point light = hit->point.template cast<double>() + camera.depth() * (camera.axes() * key_light);
    const bool in_shadow =
        normal.dot(key_light) > 0 && mesh.any_hit({hit->point, light.cast<Scalar>()}, {.sides = hit->side});
    return shade(normal, to_eye, hit->side, in_shadow);
}

}  // namespace

template <class Scalar>
Image draw(const pierce::CollisionMesh<Scalar>& mesh, const pierce::TriangleSoup<Scalar>& soup,
           const PictureOptions& options, Progress& progress) {
    const Camera camera(soup, options);
    Image image{options.width, options.height, {}};
    const auto row_bytes = std::size_t{3} * static_cast<std::size_t>(options.width);
    image.rgb.resize(row_bytes * static_cast<std::size_t>(options.height));

    std::atomic<int> next_row = 0;
    const auto draw_rows = [&] {
        for (int row = next_row++; row < options.height; row = next_row++) {
            std::uint8_t* out = image.rgb.data() + row_bytes * static_cast<std::size_t>(row);
            for (int column = 0; column < options.width; ++column) {
                Colour sum = Colour::Zero();
                for (int j = 0; j < options.samples; ++j)
                    for (int i = 0; i < options.samples; ++i) {
                        const double x = (column + (i + 0.5) / options.samples) / options.width;
                        const double y = (row + (j + 0.5) / options.samples) / options.height;
                        sum += look(mesh, camera, 2 * x - 1, 1 - 2 * y);
                    }
                for (const double channel : Colour(sum / (options.samples * options.samples)))
                    *out++ = to_srgb(channel);
            }
            progress.add(1);
        }
    };
    std::vector<std::jthread> threads;  // the answers do not depend on how many there are
    for (unsigned i = 1; i < options.threads; ++i) threads.emplace_back(draw_rows);
    draw_rows();
    threads.clear();
    return image;
}

template Image draw(const pierce::CollisionMesh<float>&, const pierce::TriangleSoup<float>&, const PictureOptions&,
                    Progress&);
template Image draw(const pierce::CollisionMesh<double>&, const pierce::TriangleSoup<double>&, const PictureOptions&,
                    Progress&);
