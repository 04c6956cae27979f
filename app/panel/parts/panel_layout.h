// The layout of the panel: bars above and below, the column of sections, the drawer of curves, and
// the picture.
#pragma once

#include "app/panel/panel_model.h"

#include <glm/vec2.hpp>

#include <array>

namespace isochron::app {

/// A rectangle in panel pixels from the top left.
struct PanelBox {
    glm::vec2 low{0.0f}, high{0.0f};
    glm::vec2 size() const { return high - low; }
    bool contains(glm::vec2 at) const {
        return at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y;
    }
    bool operator==(const PanelBox&) const = default;
};

struct PanelLayout {
    PanelBox top, column, time, picture;
    PanelBox curves;     ///< drawer above the bar of the time; of no height where it is closed
    bool folded = false; ///< the column shows only icons, which open the sections over the picture
    bool two_rows = false; ///< in the bar of the time the buttons stand above the track

    /// Whether a part that is always there covers a place.
    bool covers(glm::vec2 at) const {
        return top.contains(at) || column.contains(at) || time.contains(at) || curves.contains(at);
    }
    bool operator==(const PanelLayout&) const = default;
};

/// The layout of a panel. @param size of the window or the panel in the room, panel pixels
/// @param curves their drawer is open
PanelLayout layout_in(PanelPlace place, glm::vec2 size, bool curves);

} // namespace isochron::app
