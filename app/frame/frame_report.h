// What is known of a frame: what it showed, and how long each of its stages took.
#pragma once

#include "app/frame/device_tracking.h"
#include "app/frame/milliseconds.h"
#include "app/frame/quality_reason.h"
#include "index/volume/query.h"
#include "interaction/controls/motion_gate.h"
#include "interaction/navigation/comfort.h"
#include "render/cells/footprints.h"
#include "render/cells/upload_count.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// How the frame was drawn, and why so.
struct FrameDrawing {
    interaction::Pace pace = interaction::Pace::moving;
    render::Footprint footprint = render::Footprint::quad;
    QualityReason reason = QualityReason::moving; ///< for the footprint
    bool final = false;       ///< the picture is as good as it gets for these cells
    bool retries = false;     ///< a better footprint that did not fit is tried again soon
    bool after_wait = false;  ///< nothing was to be done since the frame before
    Milliseconds budget{0};   ///< for drawing
    Milliseconds promised{0}; ///< from one moving picture to the next
    bool slower = false;      ///< the time is longer than wanted, so that the picture is recognized
    std::optional<Milliseconds> expected; ///< draw cost of the footprint, from earlier frames
    std::optional<Milliseconds> better;   ///< draw cost of a better footprint that does not fit
    std::size_t resolution = 0; ///< number of the cells' resolution: see `kCellResolutions`
    std::size_t mesh_level = 0; ///< level of a mesh: see index/extraction/simplified_meshes.h
    std::size_t triangles = 0;  ///< triangles that are drawn of the mesh, if it is known
    /// The last exact picture was moved, in the place of what the footprint says.
    bool moved = false;
    /// Footprint of the picture at rest in parts, if any.
    std::optional<render::Footprint> in_parts;
    bool draws_parts = false; ///< draws parts of that picture, which is not whole yet
    bool redrawn = true;      ///< false: nothing that the eyes see had changed
};

/// The cells of the frame.
struct FrameCells {
    index::SurfacesQuery asked{{}, {0.0}}; ///< at least one isovalue
    std::optional<index::SurfacesQuery>
        shown;                         ///< query of the cells drawn; empty before the first set
    std::uint64_t cells = 0;           ///< drawn
    unsigned finest = 0, coarsest = 0; ///< levels of detail that they are of
    std::optional<std::uint64_t> volume_cells; ///< active cells of level 0, if counted
    std::uint64_t candidates = 0; ///< cells that the search returned before the exact test
    std::uint64_t reused = 0; ///< cells that were taken over from an earlier set: index::FoundCells
    std::string refused;      ///< why the newest cells are not shown; empty: they are
    bool extracting = false;  ///< the worker was busy when the frame began or ended
    render::UploadCount uploaded; ///< in this frame
};

/// How long the stages of the frame took, in their order.
struct FrameTimes {
    Milliseconds search{0}, gather{0}; ///< times of the shown set, on the worker
    Milliseconds wait{0};              ///< for the worker; fixed-step replay only
    Milliseconds upload{0}, draw{0}, present{0}, total{0};
    Milliseconds barrier{0};   ///< between draw and present: until all processes drew
    Milliseconds processor{0}; ///< time that all threads of the program computed meanwhile
    Milliseconds latency{0};   ///< from polling the devices until all was submitted
    std::optional<Milliseconds> pose_age; ///< age of the oldest head pose, when the views were made
    /// Time that the GPU took for this frame; known some frames later.
    std::optional<Milliseconds> gpu;
    unsigned missed = 0; ///< refreshes of the display missed before this frame
};

struct FrameReport : FrameDrawing, FrameCells, FrameTimes {
    interaction::Seconds time{0}; ///< session time of the frame
    interaction::ComfortState comfort;
    std::vector<DeviceTracking> tracking; ///< empty if no device is tracked
};

} // namespace isochron::app
