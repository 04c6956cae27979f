// The control panel: shows what the user asked for and what is shown; turns clicks into commands.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/film_lane.h"
#include "app/panel/parts/panel_layout.h"
#include "app/panel/parts/top_bar.h"
#include "interaction/commands.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace isochron::app {

/// What a panel remembers of itself from frame to frame.
struct PanelView {
    PanelLayout layout{};               ///< the last layout; empty while the panel is hidden
    std::optional<std::size_t> section; ///< opened over the picture, where the column is folded
    bool statistics = false;            ///< open below the chip
    /// Section that the search points at until the next click; kSections: the bar of the time.
    std::optional<std::size_t> pointed;
    float lowest = 0; ///< where chip, tools, statistics and cube end
    FilmLane film{};
    PanelBox free; ///< what chip, tools, statistics, section and cube leave of the picture

    /// Closes the section or the statistics over the picture. @return whether one was open
    bool close_part() {
        const bool shown = layout != PanelLayout{};
        return shown && (layout.folded && section ? std::exchange(section, {}).has_value()
                                                  : std::exchange(statistics, false));
    }
};

/// Lays the panel out in the current Dear ImGui frame. @return commands of the user
interaction::Commands draw_panel(const PanelModel& model, PanelView& view, PanelPages& pages);

} // namespace isochron::app
