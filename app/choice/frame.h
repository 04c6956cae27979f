// A frame that is being made, as a session's parts share it.
#pragma once

#include "app/cluster/frame_sharing.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_report.h"
#include "app/quality/frame_plan.h"
#include "app/quality/frame_quality.h"
#include "app/scene/picture.h"

#include <cstddef>
#include <optional>

namespace isochron::app {

/// In a live session a step that is shown for long may settle; a replay goes by what was recorded.
constexpr interaction::Playing playing_in(Waiting waiting) {
    return waiting == Waiting::never ? interaction::Playing::moves_by_steps
                                     : interaction::Playing::moves;
}

struct Frame {
    const ExplorerState& state; ///< after this frame's commands
    const index::IndexFile& file;
    std::size_t steps; ///< number of steps that can be shown
    Waiting waiting;
    bool is_kept;                        ///< a capture waits for this picture
    const std::optional<Picture>& drawn; ///< last picture; empty: none yet
    FrameSharing& sharing;
    FramePlan& plan;     ///< plan of the last frame until this one's is agreed
    FrameReport& report; ///< `asked`, `time` and `pace` are known from the start

    bool is_live() const { return waiting == Waiting::never; }
    /// How footprints are chosen. The frames of a replay are each drawn at once.
    Choosing choosing() const { return is_live() ? Choosing::with_parts : Choosing::by_pace; }
};

} // namespace isochron::app
