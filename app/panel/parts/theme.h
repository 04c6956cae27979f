// Colors and measures of the panel: one theme for dark rooms, one for light rooms.
#pragma once

#include "interaction/setting_values.h"

#include <imgui.h>

#include <cstdint>

namespace isochron::app {

enum class Theme : std::uint8_t { dark, light };

/// The panel is as light as the picture's background.
Theme theme_for(const interaction::Look& look);

/// What a color is for. Every text color has a contrast of at least 4.5 to 1 on every surface
/// that text stands on.
enum class Ink : std::uint8_t {
    text,
    dim,     ///< text that is read second: labels, units, notes
    accent,  ///< what is chosen or moves with the hand
    good,    ///< the picture is exact
    warning, ///< what the user should know
    error,   ///< what went wrong
    paper,   ///< the ground of sections
    bar,     ///< the ground of the bars at the top and at the bottom
    control, ///< the ground of fields and buttons
    chosen,  ///< a control that is switched on, and the filled part of a field
    line,    ///< between parts
    columns  ///< columns of the histogram, and of the steps at hand
};

ImVec4 color_of(Ink ink);
ImU32 packed(Ink ink);

/// Gives the current Dear ImGui context the colors of a theme.
void use_theme(Theme theme);
/// Gives it the measures that both themes share.
void use_measures();

} // namespace isochron::app
