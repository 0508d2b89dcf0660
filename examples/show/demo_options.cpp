// The command line that all demos have. See demo.h.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "show/demo.h"

namespace show {

void add_demo_options(CLI::App& app, DemoOptions& options) {
    app.add_option("--steps", options.steps,
                   "How many steps to take without a window (" + std::to_string(options.steps) + ")")
        ->check(CLI::Range(0, 1'000'000'000))
        ->option_text("N");
    app.add_option("--picture", options.picture, "No window: draw the last step into this PNG file")
        ->option_text("FILE");
    app.add_option("--frames", options.frames, "No window: draw each step into a PNG file in this folder")
        ->option_text("FOLDER");
    app.add_flag("--no-window", options.no_window, "No window and no picture, figures only");
    app.add_option("--screenshot", options.screenshot, "Save the window as a PNG file after --steps frames, and end")
        ->option_text("FILE");
    add_view_options(app, options.view);
}

std::string finite(const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    return end != text.c_str() && *end == 0 && std::isfinite(number) ? "" : text + " is no finite number";
}

void add_view_options(CLI::App& app, View& view) {
    app.add_option(
           "--size",
           [&view](const CLI::results_t& values) {
               return std::sscanf(values.front().c_str(), "%dx%d", &view.width, &view.height) == 2 && view.width > 0 &&
                      view.height > 0 && view.width <= 10'000 && view.height <= 10'000;
           },
           "Pixels (800x600)")
        ->option_text("WxH");
    app.add_option("--samples", view.samples, "N times N samples a pixel, for smooth edges, N from 1 to 8 (1)")
        ->check(CLI::Range(1, 8))
        ->option_text("N");
    const auto degrees = [](double angle) { return " (" + std::to_string(std::lround(angle)) + ")"; };
    app.add_option("--azimuth", view.azimuth, "Where to look from, in degrees" + degrees(view.azimuth))
        ->check(finite)
        ->option_text("DEGREES");
    app.add_option("--elevation", view.elevation, "The same, above the horizon" + degrees(view.elevation))
        ->check(finite)
        ->option_text("DEGREES");
}

pierce::TriangleSoup<float> mesh_or(const std::filesystem::path& mesh, pierce::TriangleSoup<float> made) {
    return mesh.empty() ? std::move(made) : pierce::read_mesh<float>(mesh);
}

}  // namespace show
