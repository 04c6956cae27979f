// The panel's section on color: what colors the surfaces, and the color map.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <cstdint>
#include <string>
#include <vector>

namespace isochron::app {

/// A color map that the user can choose.
struct OfferedMap {
    std::string name, words;
    std::vector<std::uint32_t> colors; ///< colors of a map of the configuration
};
std::vector<OfferedMap> offered_maps(const PanelModel& model);

void color_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
