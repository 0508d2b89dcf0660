// See demo.h.
#include "show/demo.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <CLI/CLI.hpp>

#ifdef SHOW_WINDOW
#include <imgui.h>

#include "show/window.h"
#endif

namespace show {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Pictures of one state after the other, from where the first one was seen. What stays as it is, is drawn once.
class Pictures {
  public:
    Pictures(const Demo& demo, const View& view)
        : demo_(demo), view_(view), camera_(corners_of(demo.soup()), view), still_(view) {
        draw_mesh();
    }

    Image next() {
        if (demo_.mesh_changes()) draw_mesh();
        Canvas canvas = still_;
        canvas.draw(camera_, demo_.dots());
        canvas.draw(camera_, demo_.lines());
        return canvas.image();
    }

  private:
    void draw_mesh() {
        draw(demo_.mesh(), camera_, still_, std::max(1u, std::thread::hardware_concurrency()), demo_.paint());
    }

    const Demo& demo_;
    View view_;
    Camera camera_;
    Canvas still_;
};

void run_without_window(Demo& demo, const DemoOptions& options) {
    std::optional<Pictures> pictures;
    if (!options.frames.empty()) std::filesystem::create_directories(options.frames);
    double seconds = 0;
    for (int k = 0; k < options.steps; ++k) {
        const auto start = Clock::now();
        demo.step();
        seconds += seconds_since(start);
        if (!options.frames.empty()) {
            if (!pictures) pictures.emplace(demo, options.view);
            std::ostringstream name;
            name << "frame" << std::setw(5) << std::setfill('0') << k << ".png";
            write_png(options.frames / name.str(), pictures->next());
        }
    }
    if (!options.picture.empty()) {
        if (!pictures) pictures.emplace(demo, options.view);
        write_png(options.picture, pictures->next());
    }
    std::cout << demo.summary() << options.steps << " steps of " << std::setprecision(3)
              << 1000 * seconds / std::max(options.steps, 1) << " ms each\n";
}

#ifdef SHOW_WINDOW
void run_in_window(Demo& demo, const std::string& title, const DemoOptions& options) {
    Window window(title, options.view);
    window.set_mesh(demo.soup(), demo.paint());
    bool is_paused = false;
    double milliseconds = 0;
    for (int k = 0; window.is_open(); ++k) {
        bool steps_once = false;
        const bool is_last = !options.screenshot.empty() && k == options.steps;
        Image screenshot;
        window.frame(
            demo.dots(), demo.lines(),
            [&] {
                ImGui::Text("%.2f ms a step", milliseconds);
                if (ImGui::Button(is_paused ? "Go on" : "Pause")) is_paused = !is_paused;
                ImGui::SameLine();
                steps_once = ImGui::Button("Step");
                demo.panel();
            },
            is_last ? &screenshot : nullptr);
        if (is_last) {
            write_png(options.screenshot, screenshot);
            break;
        }
        if (!is_paused || steps_once) {
            const auto start = Clock::now();
            demo.step();
            milliseconds += 0.1 * (1000 * seconds_since(start) - milliseconds);
            if (demo.mesh_changes()) window.set_mesh(demo.soup(), demo.paint());
        }
    }
    std::cout << demo.summary();
}
#else
void run_in_window(Demo&, const std::string&, const DemoOptions&) {
    throw std::runtime_error("built without GLFW and Dear ImGui, so there is no window: see --picture and --frames");
}
#endif

}  // namespace

void add_demo_options(CLI::App& app, DemoOptions& options) {
    app.add_option("MESH", options.mesh, "A mesh: OBJ, OFF, PLY or STL; else one is made");
    app.add_option("--steps", options.steps, "How many steps without a window (600)")
        ->check(CLI::Range(0, 1'000'000'000));
    app.add_option("--picture", options.picture, "No window: draw the last step into this PNG file");
    app.add_option("--frames", options.frames, "No window: draw each step into a PNG file in this folder");
    app.add_flag("--no-window", options.no_window, "No window and no picture, figures only");
    app.add_option("--screenshot", options.screenshot, "Of the window, after --steps frames; then end");
    app.add_option(
           "--size",
           [&options](const CLI::results_t& values) {
               return std::sscanf(values.front().c_str(), "%dx%d", &options.view.width, &options.view.height) == 2 &&
                      options.view.width > 0 && options.view.height > 0 && options.view.width <= 10'000 &&
                      options.view.height <= 10'000;
           },
           "Pixels (800x600)")
        ->type_name("WxH");
    app.add_option("--samples", options.view.samples, "N times N samples a pixel, for smooth edges (1)")
        ->check(CLI::Range(1, 8));
    app.add_option("--azimuth", options.view.azimuth, "Where to look from, in degrees");
    app.add_option("--elevation", options.view.elevation, "The same, above the horizon");
}

pierce::TriangleSoup<float> mesh_or(const DemoOptions& options, pierce::TriangleSoup<float> made) {
    return options.mesh.empty() ? std::move(made) : pierce::read_mesh<float>(options.mesh);
}

void run(Demo& demo, const std::string& title, const DemoOptions& options) {
    if (options.picture.empty() && options.frames.empty() && !options.no_window)
        run_in_window(demo, title, options);
    else
        run_without_window(demo, options);
}

}  // namespace show
