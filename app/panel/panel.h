// The control panel: shows what the user asked for and what is shown; turns clicks into commands.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <optional>
#include <string>

namespace isochron::app {

/// The rectangle that the panel covers, in panel pixels from the top left.
struct PanelArea {
    float left = 0, top = 0, right = 0, bottom = 0;
    float title = 0;     ///< height of its title
    bool narrow = false; ///< the picture has no room for the data beside it
    bool contains(float x, float y) const {
        return x >= left && x < right && y >= top && y < bottom;
    }
};

/// The pages that the panel's buttons open beside it.
struct PanelPages {
    bool offers_files = false;        ///< the user can open other data
    bool files = false, help = false; ///< opened in this frame
    std::optional<MovieWish> movie{}; ///< likewise
};

/// Lays the panel out in the current Dear ImGui frame. @return commands of the user
interaction::Commands draw_panel(const PanelModel& model, PanelArea& area, PanelPages& pages);

/// How the picture is drawn, and why: `settled: surface, 7.2 of 11.1 ms`.
std::string quality_line(const FrameReport& frame);

} // namespace isochron::app
