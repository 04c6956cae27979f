// The panel's sections: data, objects, surfaces, color and view.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/icons.h"
#include "interaction/commands.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Names of the stereo modes that the user can choose.
std::vector<std::string> offered_stereo(const PanelModel& model);

/// One section of the panel.
struct Section {
    const char* name;
    Icon icon;
    void (*lay_out)(const PanelModel& model, PanelPages& pages, interaction::Commands& commands);
};
inline constexpr std::size_t kSections = 5;
const std::array<Section, kSections>& sections();

/// All of them in the current window, each under a line that folds it.
/// @param pointed section that is open, in view, and in a frame
void section_column(const PanelModel& model, PanelPages& pages, interaction::Commands& commands,
                    const std::optional<std::size_t>& pointed = {});
/// One of them, which the user chooses from a line of names: for panels without room for all.
/// It is scrolled where it has more lines than fit; the names stay.
/// @param pointed section that is chosen now @param below height that is left free below it
void section_pages(const PanelModel& model, PanelPages& pages, interaction::Commands& commands,
                   std::optional<std::size_t>& pointed, float below);

} // namespace isochron::app
