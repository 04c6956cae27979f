// Says what took the time of a frame that came late.
#pragma once

#include "app/frame/frame_report.h"

#include <string>

namespace isochron::app {

/// A frame is late if it takes more than this many times what was promised, or its budget.
inline constexpr double kLate = 2;

/// The time that a frame should take: what was promised, or its budget if that is longer; 0: any.
Milliseconds due_time(const FrameReport& frame);

/// Whether a frame took more than `kLate` times its due time. Frames without one never are late.
bool is_late(const FrameReport& frame);

/// The stage that took most of a frame: `wait`, `upload`, `draw`, `barrier`, `present`, or `rest`:
/// what is not in any stage, such as panels.
const char* longest_stage(const FrameReport& frame);

/// One line, such as `draw took 240 of 260 ms (surface, trial; cells were being extracted; 1.2
/// processors worked)`.
/// @param first no frame before was drawn with this footprint, so shaders were compiled
std::string what_took(const FrameReport& frame, bool first);

} // namespace isochron::app
