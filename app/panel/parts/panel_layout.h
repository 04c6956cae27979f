// The layout of the panel: bars above and below, the column of sections, the lane of a film, the
// drawer of curves, and the picture.
#pragma once

#include "app/panel/panel_model.h"

#include <glm/vec2.hpp>

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
    PanelBox film;       ///< lane of key frames above the bar of the time; of no height without any
    PanelBox curves;     ///< drawer above the lane; of no height where it is closed
    bool folded = false; ///< the column shows only icons, which open the sections over the picture
    bool two_rows = false; ///< in the bar of the time the buttons stand above the track

    /// Whether a part that is always there covers a place.
    bool covers(glm::vec2 at) const {
        return top.contains(at) || column.contains(at) || time.contains(at) || film.contains(at) ||
               curves.contains(at);
    }
    bool operator==(const PanelLayout&) const = default;
};

/// How far the chip reaches from the upper left corner of the picture, at most, and the cube from the
/// upper right one, panel pixels.
inline constexpr glm::vec2 kChipEnd{142.0f, 38.0f}, kCubeEnd{100.0f, 98.0f};

/// The rows between the picture and the bar of the time that are open.
struct PanelRows {
    bool film = false, curves = false;
    bool told = false; ///< the card of a story needs the picture, so that a low one has no drawer
};
/// Those of a session.
PanelRows rows_of(const interaction::Settings& settings);

/// Whether the part that is left free is worth fitting the picture into it: no less than half of the
/// width and a quarter of the height. Else the picture lies under the whole panel.
bool has_room_for_picture(const PanelBox& free, glm::vec2 size);

/// The layout of a panel. @param size of the window or the panel in the room, panel pixels
PanelLayout layout_in(PanelPlace place, glm::vec2 size, const PanelRows& rows = {});

} // namespace isochron::app
