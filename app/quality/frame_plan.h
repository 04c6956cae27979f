// What is decided about a frame: how it is drawn, and which cells are asked for after it.
#pragma once

#include "app/frame/quality_reason.h"
#include "index/volume/query.h"
#include "render/cells/footprints.h"

#include <cstddef>
#include <optional>

namespace isochron::app {

/// Rank 0 of a cluster makes one for each frame, and all processes follow it. The last one is kept
/// for the next frame.
struct FramePlan {
    render::Footprint footprint = render::Footprint::quad;
    QualityReason reason = QualityReason::moving; ///< for the footprint
    bool final = false;          ///< the picture is as good as it gets for these cells
    bool measure = false;        ///< draw even if nothing has changed, so that the cost gets known
    bool mesh = false;           ///< the sets asked for from now on come with a mesh
    index::DetailQuery detail{}; ///< detail of the sets asked for from now on
    /// Footprint of the picture at rest while it is made in parts, or shown; empty: there is none.
    std::optional<render::Footprint> in_parts{};
    bool shows_parts = false; ///< parts are whole everywhere, and shown
    bool holds_finer = false; ///< finer cells of the same picture come in parts alone
    bool all_at_rest = false; ///< all cells are wanted for this picture at rest
    /// The set for pictures at rest is drawn while the picture moves, too: it fits.
    bool moves_finest = false;
    std::size_t resolution = 0; ///< number of the cells' resolution: see `kCellResolutions`
    /// While the head sways, the exact picture is drawn in the time that frames leave: it is shown,
    /// moved, and its cost gets known.
    bool ahead = false;
    /// Mesh level of the footprint `mesh` (index/extraction/simplified_meshes.h).
    std::size_t mesh_level = 0;
    bool moved = false; ///< the last exact picture is moved: see `Picture::moved`
    bool operator==(const FramePlan&) const = default;
};

} // namespace isochron::app
