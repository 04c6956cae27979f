// Where the parts of the panel lie: bars above and below, the column of sections, the picture.
#include "app/panel/parts/places.h"

#include <algorithm>

namespace isochron::app {
namespace {

constexpr float kTop = 36.0f, kTime = 52.0f, kTimeOfTwoRows = 84.0f;
constexpr float kColumn = 300.0f, kIcons = 40.0f;
constexpr float kFoldedBelow = 800.0f; ///< width of the picture's window
constexpr float kOneRow = 560.0f;      ///< width of the bar of the time, at least
/// Bar at the top of the panel in the room, by which a hand carries it.
constexpr float kTitle = 24.0f;

} // namespace

PanelPlaces places_in(PanelPlace place, glm::vec2 size) {
    PanelPlaces places;
    places.two_rows = size.x < kOneRow;
    const bool over = place == PanelPlace::over;
    places.folded = over && size.x < kFoldedBelow;
    const float above = place == PanelPlace::in_room ? kTitle : 0.0f;
    const float below = std::max(above + kTop, size.y - (places.two_rows ? kTimeOfTwoRows : kTime));
    const float right = !over ? size.x : std::min(places.folded ? kIcons : kColumn, size.x);
    places.top = {{0.0f, above}, {size.x, above + kTop}};
    places.time = {{0.0f, below}, size};
    places.column = {{0.0f, above + kTop}, {right, below}};
    places.picture = {{right, above + kTop}, {size.x, below}};
    return places;
}

} // namespace isochron::app
