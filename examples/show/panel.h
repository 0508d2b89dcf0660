// Sliders and text in a demo's panel: of Dear ImGui, in a browser of the page (page.cpp), and nothing where a demo is
// built without either.
#pragma once

#include <string>

#ifdef SHOW_WINDOW
#include <imgui.h>
#endif

namespace show {

#if defined(__EMSCRIPTEN__)

void slider(const char* name, float& value, float least, float most);
void check_box(const char* name, bool& value);
void text(const std::string& words);

#elif defined(SHOW_WINDOW)

inline void slider(const char* name, float& value, float least, float most) {
    ImGui::SliderFloat(name, &value, least, most);
}
inline void check_box(const char* name, bool& value) { ImGui::Checkbox(name, &value); }
inline void text(const std::string& words) { ImGui::TextUnformatted(words.c_str()); }

#else

inline void slider(const char*, float&, float, float) {}
inline void check_box(const char*, bool&) {}
inline void text(const std::string&) {}

#endif

}  // namespace show
