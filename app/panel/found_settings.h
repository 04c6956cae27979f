// Finds settings by words: a line for each value that a setting of the panel can have.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// A value that a setting can be given.
struct FoundSetting {
    std::string words;              ///< `background: light`
    interaction::Commands commands; ///< commands that set it
};

/// Values that differ from what is asked for: backgrounds, materials, the usual light, occlusion,
/// what colors stand for, color maps, ways to show both eyes' pictures, arrays and viewpoints.
/// @param words that each line has; without any, none is found
std::vector<FoundSetting> found_settings(std::string_view words, const PanelModel& model);

} // namespace isochron::app
