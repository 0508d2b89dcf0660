// See canvas.h.
#include "show/canvas.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace show {
namespace {

std::uint8_t to_srgb(float linear) {
    const float c = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(encoded * 255));
}

}  // namespace

Canvas::Canvas(const View& view)
    : samples_(view.samples), columns_(view.width * view.samples), rows_(view.height * view.samples) {
    const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    colours_.assign(count, Colour::Zero());
    depths_.assign(count, std::numeric_limits<float>::infinity());
}

void Canvas::set(int column, int row, const Colour& colour, float depth) {
    colours_[index(column, row)] = colour;
    depths_[index(column, row)] = depth;
}

void Canvas::put(int column, int row, const Colour& colour, float depth) {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
    if (depth < depths_[index(column, row)]) set(column, row, colour, depth);
}

void Canvas::draw(const Camera& camera, std::span<const Dot> dots) {
    for (const Dot& dot : dots) {
        const Point at = camera.project(dot.place);
        if (!(at.z() > dot.radius)) continue;  // behind the camera, or around it
        const double radius = std::max(0.5 * rows_ * dot.radius / at.z() / camera.tangent().y(), 0.5 * samples_);
        const double column = 0.5 * (at.x() + 1) * columns_ - 0.5, row = 0.5 * (1 - at.y()) * rows_ - 0.5;
        if (!(std::abs(at.x()) < 2 && std::abs(at.y()) < 2)) continue;  // also where it is so near that this overflows
        for (int j = static_cast<int>(std::ceil(row - radius)); j <= row + radius; ++j)
            for (int i = static_cast<int>(std::ceil(column - radius)); i <= column + radius; ++i) {
                const double u = (i - column) / radius, v = (j - row) / radius, inside = 1 - u * u - v * v;
                if (inside < 0) continue;
                const double height = std::sqrt(inside);
                const double light = 0.35 + 0.65 * std::max(0.0, 0.6 * height - 0.5 * u - 0.6 * v);
                put(i, j, dot.colour * static_cast<float>(light), static_cast<float>(at.z() - dot.radius * height));
            }
    }
}

void Canvas::draw(const Camera& camera, std::span<const Line> lines) {
    for (const Line& line : lines) {
        const Point a = camera.project(line.from), b = camera.project(line.to);
        if (!(a.z() > 0 && b.z() > 0)) continue;  // the demos keep their lines before the camera
        const Eigen::Array2d scale(0.5 * columns_, -0.5 * rows_);
        const Eigen::Array2d from = a.head<2>().array() * scale, to = b.head<2>().array() * scale;
        const double length = (to - from).matrix().norm();
        const int steps = static_cast<int>(std::min(2 * length, 1e5)) + 1;
        const int half = static_cast<int>(std::lround(0.5 * line.width * samples_));
        for (int k = 0; k <= steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            const Eigen::Array2d at = from + t * (to - from);
            const double depth = 1 / ((1 - t) / a.z() + t / b.z());  // what is linear in the picture is its inverse
            const int column = static_cast<int>(std::lround(at.x() + 0.5 * columns_ - 0.5));
            const int row = static_cast<int>(std::lround(at.y() + 0.5 * rows_ - 0.5));
            for (int j = -half; j <= half; ++j)
                for (int i = -half; i <= half; ++i)
                    put(column + i, row + j, line.colour, line.on_top ? 0.0f : static_cast<float>(0.999 * depth));
        }
    }
}

Image Canvas::image() const {
    Image image{columns_ / samples_, rows_ / samples_, {}};
    image.rgb.reserve(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (int row = 0; row < rows_; row += samples_)
        for (int column = 0; column < columns_; column += samples_) {
            Colour sum = Colour::Zero();
            for (int j = 0; j < samples_; ++j)
                for (int i = 0; i < samples_; ++i) sum += colours_[index(column + i, row + j)].min(1);
            for (const float channel : Colour(sum / static_cast<float>(samples_ * samples_)))
                image.rgb.push_back(to_srgb(channel));
        }
    return image;
}

}  // namespace show
