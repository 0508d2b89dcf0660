// Sliders and text in a demo's panel: of Dear ImGui, and nothing where a demo is built without it.
#pragma once

#include <string>

#ifdef SHOW_WINDOW
#include <imgui.h>
#endif

namespace show {

inline void slider([[maybe_unused]] const char* name, [[maybe_unused]] float& value, [[maybe_unused]] float least,
                   [[maybe_unused]] float most) {
#ifdef SHOW_WINDOW
    ImGui::SliderFloat(name, &value, least, most);
#endif
}

inline void check_box([[maybe_unused]] const char* name, [[maybe_unused]] bool& value) {
#ifdef SHOW_WINDOW
    ImGui::Checkbox(name, &value);
#endif
}

inline void text([[maybe_unused]] const std::string& words) {
#ifdef SHOW_WINDOW
    ImGui::TextUnformatted(words.c_str());
#endif
}

}  // namespace show
