// A window with a mesh, dots and lines in it, a camera that the mouse turns, and a panel for sliders and buttons.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include <pierce/triangle_soup.h>

#include "show/canvas.h"
#include "show/picture.h"

namespace show {

/// One at a time in a program. Drag with the left button to turn, with the right one to move; the wheel goes nearer.
class Window {
  public:
    /// Throws std::runtime_error where there is no display, with what GLFW says.
    Window(const std::string& title, const View& view);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// False once the user has closed it.
    [[nodiscard]] bool is_open() const;
    /// What is drawn from now on. Sides that are not seen one looks through.
    /// Throws std::runtime_error for a mesh of more than 10^30 units.
    void set_mesh(const pierce::TriangleSoup<float>& soup, const Paint& paint);
    /// Draws a frame, and waits for the display. `panel` may call Dear ImGui: a window of its own is open. What is seen
    /// goes to `screenshot`, if given.
    void frame(std::span<const Dot> dots, std::span<const Line> lines, const std::function<void()>& panel,
               Image* screenshot = nullptr);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace show
