// Lines of text in the panel, and tips on its controls.
#pragma once

#include <imgui.h>

#include <string>

namespace isochron::app {

/// One line, as it is.
void text(const std::string& line);
/// Text that is wrapped to several lines.
void note(const std::string& line, const ImVec4& color);
/// The width, of the given one or somewhat less, at which a text takes as many lines but does not
/// end in a line of one word, if there is one. @param words without line breaks
float width_without_widow(const std::string& words, float width);
/// What a popup is about, at its top.
void popup_title(const char* words);
/// A tip under the mouse on the control that was laid out last: what it does, and its key.
void tip(const char* words);
/// A frame that points at a part of the panel. @param low, high its corners, panel pixels
void point_at(const ImVec2& low, const ImVec2& high);

} // namespace isochron::app
