// What is decided about a frame: how it is drawn, and which cells are asked for after it.
#pragma once

#include "app/frame/quality_reason.h"
#include "app/quality/picture_state.h"
#include "index/volume/query.h"
#include "render/cells/footprints.h"

#include <cstddef>

namespace isochron::app {

/// Rank 0 of a cluster makes one for each frame, and all processes follow it. The last one is kept
/// for the next frame.
struct FramePlan {
    render::Footprint footprint = render::Footprint::quad;
    QualityReason reason = QualityReason::moving; ///< for the footprint
    PictureState state;
    bool mesh = false;           ///< the sets asked for from now on come with a mesh
    index::DetailQuery detail{}; ///< detail of the sets asked for from now on
    bool finer_in_parts = false; ///< finer cells of the same picture come in parts alone
    bool all_at_rest = false;    ///< all cells are wanted for this picture at rest
    /// The set for pictures at rest is drawn while the picture moves, too: it fits.
    bool moves_finest = false;
    std::size_t resolution = 0; ///< number of the resolution of the cells: see `kCellResolutions`
    std::size_t mesh_level = 0; ///< level of the footprint `mesh` (index/extraction/simplified_meshes.h)
    bool operator==(const FramePlan&) const = default;
};

} // namespace isochron::app
