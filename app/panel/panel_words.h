// Lines of text in the panel, and what is said of its controls.
#pragma once

#include <imgui.h>

#include <string>

namespace isochron::app {

inline const ImVec4 kDim(0.62f, 0.65f, 0.70f, 1.0f);
inline const ImVec4 kWarning(1.0f, 0.55f, 0.40f, 1.0f);

/// A line as it is.
void text(const std::string& line);
/// As many lines as it takes.
void note(const std::string& line, const ImVec4& color);
/// On what changes by itself. It never takes another line, which would move the controls below it
/// away from the hand; in the room a replay must find them where the wand found them. All of it
/// is shown under the mouse.
void state_note(const std::string& line, const ImVec4& color);
/// Shown under the mouse: what the control before it does, and its key.
void tip(const char* words);

} // namespace isochron::app
