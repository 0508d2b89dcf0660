// See demo.h.
#include "show/demo.h"

#include <chrono>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "show/pictures.h"

#ifdef SHOW_WINDOW
#include <imgui.h>

#include "show/window.h"
#endif

namespace show {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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
                ImGui::TextUnformatted("Mouse: left turns, right moves, wheel goes nearer");
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

int run(std::unique_ptr<Demo> demo, const std::string& title, const DemoOptions& options) {
    if (options.picture.empty() && options.frames.empty() && !options.no_window)
        run_in_window(*demo, title, options);
    else
        run_without_window(*demo, options);
    return demo->holds() ? 0 : 1;
}

}  // namespace show
