// Where the parts of the panel lie.
#include "app/panel/parts/panel_layout.h"

#include <algorithm>

namespace isochron::app {
namespace {

constexpr float kTop = 36.0f, kTime = 52.0f, kTimeOfTwoRows = 84.0f;
constexpr float kColumn = 300.0f, kIcons = 40.0f;
constexpr float kFilmRow = 32.0f;
constexpr float kFoldedBelow = 800.0f; ///< width of the picture's window
constexpr float kLowForStory = 400.0f; ///< height of the picture and the drawer
constexpr float kOneRow = 560.0f;      ///< width of the bar of the time, at least
/// Bar at the top of the panel in the room, by which a hand carries it.
constexpr float kTitle = 24.0f;

/// Height of the drawer of curves. @param height between the bars
float drawer_height(float height) {
    constexpr float kShare = 0.32f, kLow = 150.0f, kHigh = 260.0f;
    return std::min(std::clamp(kShare * height, kLow, kHigh), height / 2);
}

} // namespace

PanelRows rows_of(const interaction::Settings& settings) {
    return {.film = !settings.keys.empty(),
            .curves = settings.curves.shown,
            .told = settings.story > 0};
}

bool has_room_for_picture(const PanelBox& free, glm::vec2 size) {
    return 2 * free.size().x >= size.x && 4 * free.size().y >= size.y;
}

PanelLayout layout_in(PanelPlace place, glm::vec2 size, const PanelRows& rows) {
    PanelLayout layout;
    layout.two_rows = size.x < kOneRow;
    const bool over = place == PanelPlace::over;
    layout.folded = over && size.x < kFoldedBelow;
    const float above = place == PanelPlace::in_room ? kTitle : 0.0f;
    const float below = std::max(above + kTop, size.y - (layout.two_rows ? kTimeOfTwoRows : kTime));
    const float right = !over ? size.x : std::min(layout.folded ? kIcons : kColumn, size.x);
    layout.top = {{0.0f, above}, {size.x, above + kTop}};
    layout.time = {{0.0f, below}, size};
    // Beside the column the rows take their height from the picture, else from the column.
    const float lane = rows.film ? below - kFilmRow : below;
    const float height = lane - above - kTop;
    const bool drawer = rows.curves && !(over && rows.told && height < kLowForStory);
    const float free = drawer ? lane - drawer_height(height) : lane;
    layout.film = {{over ? right : 0.0f, lane}, {size.x, below}};
    layout.column = {{0.0f, above + kTop}, {right, over ? below : free}};
    layout.curves = {{over ? right : 0.0f, free}, {size.x, lane}};
    layout.picture = {{right, above + kTop}, {size.x, over ? free : below}};
    return layout;
}

} // namespace isochron::app
