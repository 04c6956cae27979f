// The lane of a film's key frames over the bar of the time: marks on the film's own time, which are
// dragged, visited and removed, and the film itself as a preview.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/panel_layout.h"
#include "interaction/commands.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace isochron::app {

struct FilmPreview;

/// What the lane remembers from frame to frame.
struct FilmLane {
    std::optional<std::size_t> chosen, dragged; ///< numbers of keys
    bool moves = false;                         ///< the hand has left the mark's place
    bool under_hand = false;                    ///< the cursor was over it in the last frame
    bool removes = false;                       ///< the chosen key goes in the next frame
    std::shared_ptr<FilmPreview> preview;       ///< while the film plays
    /// A key's text that is being written.
    std::optional<std::pair<std::size_t, std::string>> draft;
};

/// Draws it into its row of the layout, where there are keys.
void film_lane(const PanelModel& model, const PanelLayout& layout, FilmLane& lane,
               interaction::Commands& commands);

} // namespace isochron::app
