// A picture while it is drawn: linear light and a distance for each sample, and dots and lines on top of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "show/camera.h"
#include "show/image.h"

namespace show {

using Colour = Eigen::Array3f;  ///< linear light, 1 is white

struct Dot {
    Point place;
    Colour colour;
    double radius;  ///< in the units of the mesh
};

struct Line {
    Point from, to;
    Colour colour;
    double width = 1.5;   ///< in pixels
    bool on_top = false;  ///< seen through the mesh
};

class Canvas {
  public:
    explicit Canvas(const View& view);

    [[nodiscard]] int columns() const { return columns_; }  ///< of samples
    [[nodiscard]] int rows() const { return rows_; }
    /// Of a sample's middle, as `Camera` has it.
    [[nodiscard]] double x(int column) const { return 2 * (column + 0.5) / columns_ - 1; }
    [[nodiscard]] double y(int row) const { return 1 - 2 * (row + 0.5) / rows_; }

    /// Sets a sample; `depth` as by `Camera::project`.
    void set(int column, int row, const Colour& colour, float depth);
    /// Sets it if nothing nearer is there.
    void put(int column, int row, const Colour& colour, float depth);

    /// Dots are shaded as balls.
    void draw(const Camera& camera, std::span<const Dot> dots);
    void draw(const Camera& camera, std::span<const Line> lines);

    [[nodiscard]] Image image() const;

  private:
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }

    int samples_, columns_, rows_;
    std::vector<Colour> colours_;
    std::vector<float> depths_;
};

}  // namespace show
