// What all demos have in common: a window to play with, or a picture, or a series of them, without a screen.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>

#include "show/canvas.h"
#include "show/picture.h"

namespace CLI {
class App;
}

namespace show {

/// What the command line of a demo says.
struct DemoOptions {
    int steps = 600;                   ///< without a window
    std::filesystem::path picture;     ///< of the last step
    std::filesystem::path frames;      ///< a folder for one picture a step
    bool no_window = false;            ///< figures only; pictures have no window either
    std::filesystem::path screenshot;  ///< of the window, after so many steps
    View view;
};

/// Adds the options above; their values are the defaults that `--help` names.
void add_demo_options(CLI::App& app, DemoOptions& options);
/// For the `check` of an option: what is wrong with a text that is no finite number, else nothing.
std::string finite(const std::string& text);
/// Those of a view alone: size, samples, azimuth and elevation.
void add_view_options(CLI::App& app, View& view);

/// A simulation that can be shown.
class Demo {
  public:
    virtual ~Demo() = default;

    /// Goes on by one step of time.
    virtual void step() = 0;
    /// The mesh as it is drawn, and the positions of its triangles. `changes`: from step to step.
    [[nodiscard]] virtual const pierce::CollisionMesh<float>& mesh() const = 0;
    [[nodiscard]] virtual const pierce::TriangleSoup<float>& soup() const = 0;
    [[nodiscard]] virtual bool mesh_changes() const { return false; }
    [[nodiscard]] virtual Paint paint() const { return {}; }

    [[nodiscard]] virtual std::vector<Dot> dots() const = 0;
    [[nodiscard]] virtual std::vector<Line> lines() const { return {}; }
    /// Sliders and figures of its own, by Dear ImGui. Called while a window is open only.
    virtual void panel() {}
    /// Lines for standard output at the end.
    [[nodiscard]] virtual std::string summary() const = 0;
    /// Whether what it shows is what is promised.
    [[nodiscard]] virtual bool holds() const { return true; }
};

/// Runs it as the options say, in a window or without; prints the summary and the time that a step took. Returns the
/// program's status: 1 if it does not hold. In a browser it returns at once, and the page goes on with the demo
/// (page.cpp). Throws std::runtime_error where no window can be opened or a file can't be written.
int run(std::unique_ptr<Demo> demo, const std::string& title, const DemoOptions& options);

/// Reads the mesh, or takes `made` where none is named.
[[nodiscard]] pierce::TriangleSoup<float> mesh_or(const std::filesystem::path& mesh, pierce::TriangleSoup<float> made);

}  // namespace show
