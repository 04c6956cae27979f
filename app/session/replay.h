// Replaying a recording: obeys its commands and says when they are no longer what its devices lead
// to.
#pragma once

#include "app/session/pattern_show.h"
#include "app/session/session.h"
#include "interaction/recording/recording.h"

#include <functional>
#include <string>
#include <vector>

namespace isochron::app {

struct ReplayOptions {
    bool from_devices = false; ///< recompute the commands from the devices and compare
    std::optional<stereo::StereoMode> stereo;        ///< instead of every recorded one
    std::optional<interaction::QualityMode> quality; ///< instead of every recorded one
};

/// Called after each frame, with its number from 0.
using FrameDone = std::function<void(std::size_t number, const interaction::RecordedFrame& frame)>;

/// Fixed-step: each recorded frame once, at its recorded time, each waiting for its cells.
/// @return one line per frame whose recomputed commands differ (empty unless `from_devices`)
std::vector<std::string> replay_fixed_step(Session& session,
                                           const interaction::Recording& recording,
                                           const ReplayOptions& options, const FrameDone& done);

/// The test pattern before the recorded heads and hands, each frame once.
void replay_pattern(PatternShow& show, const interaction::Recording& recording,
                    const ReplayOptions& options, const FrameDone& done);

/// On the wall clock, dropping no command; frames come as fast as the display takes them.
/// Ends with the recording or when the window closes.
void replay_live(Session& session, const interaction::Recording& recording,
                 const ReplayOptions& options);

/// The start state that a header holds. @throws interaction::Error when it cannot be held
ExplorerState start_of(const interaction::RecordingHeader& header, const ExplorerState& fallback,
                       std::size_t steps, const ReplayOptions& options);

} // namespace isochron::app
