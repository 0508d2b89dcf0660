// A demo in a browser, instead of demo.cpp: what the page (examples/web/index.html) calls for each frame.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "show/panel.h"
#include "show/pictures.h"

namespace show {
namespace {

struct Control {
    std::string name;
    float least, most, value;
    bool is_switch;
    bool is_set;  ///< by the user, since the demo last looked
};

/// What there is of a page. A program in a browser goes on after its main function.
struct Page {
    std::unique_ptr<Demo> demo;
    View view;
    std::optional<Pictures> pictures;
    std::vector<Control> controls;
    std::string words;
    std::string told;  ///< what was last given to the page, for which it must stay
    std::vector<std::uint8_t> rgba;
    double milliseconds = 0;
} page;

float control(const char* name, float value, float least, float most, bool is_switch) {
    auto found =
        std::find_if(page.controls.begin(), page.controls.end(), [&](const auto& c) { return c.name == name; });
    if (found == page.controls.end()) found = page.controls.insert(found, {name, least, most, value, is_switch, false});
    if (!found->is_set) found->value = value;
    found->is_set = false;
    return found->value;
}

}  // namespace

void slider(const char* name, float& value, float least, float most) {
    value = control(name, value, least, most, false);
}

void check_box(const char* name, bool& value) { value = control(name, value ? 1 : 0, 0, 1, true) != 0; }

void text(const std::string& words) { page.words += words; }

int run(std::unique_ptr<Demo> demo, const std::string&, const DemoOptions& options) {
    page.demo = std::move(demo);
    page.view = options.view;
    return 0;
}

}  // namespace show

extern "C" {

using show::page;

/// Not after `--help`.
int page_has_demo() { return page.demo ? 1 : 0; }

/// Some steps; then the words and controls are up to date.
void page_step(int steps) {
    for (int k = 0; k < steps; ++k) {
        const auto start = std::chrono::steady_clock::now();
        page.demo->step();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        page.milliseconds += 0.1 * (took.count() - page.milliseconds);
    }
    page.words.clear();
    page.demo->panel();
}

/// The picture, four bytes a pixel.
const std::uint8_t* page_draw() {
    if (!page.pictures) page.pictures.emplace(*page.demo, page.view);
    const show::Image image = page.pictures->next();
    const std::size_t pixels = image.rgb.size() / 3;
    page.rgba.assign(4 * pixels, 255);
    for (std::size_t i = 0; i < pixels; ++i) std::copy_n(&image.rgb[3 * i], 3, &page.rgba[4 * i]);
    return page.rgba.data();
}

/// Looks from elsewhere.
void page_turn(double azimuth, double elevation, double zoom) {
    page.view.azimuth += azimuth;
    page.view.elevation = std::clamp(page.view.elevation + elevation, -89.0, 89.0);
    page.view.zoom *= zoom;
    page.pictures.reset();
}

int page_width() { return page.view.width; }
int page_height() { return page.view.height; }
double page_milliseconds() { return page.milliseconds; }
const char* page_words() { return page.words.c_str(); }

/// A line for each control: slider or switch, least, most, value and name, with tabs between.
const char* page_controls() {
    std::ostringstream lines;
    for (const show::Control& c : page.controls)
        lines << (c.is_switch ? "switch" : "slider") << '\t' << c.least << '\t' << c.most << '\t' << c.value << '\t'
              << c.name << '\n';
    page.told = lines.str();
    return page.told.c_str();
}

void page_set(int number, float value) {
    show::Control& control = page.controls.at(static_cast<std::size_t>(number));
    control.value = value;
    control.is_set = true;
}
}
