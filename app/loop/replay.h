// Replays a recording: obeys its commands; can report frames whose devices would now give other
// commands.
#pragma once

#include "app/loop/pattern_show.h"
#include "app/loop/session_control.h"
#include "app/session/session.h"
#include "interaction/recording/recording.h"

#include <functional>
#include <string>
#include <vector>

namespace isochron::app {

struct ReplayOptions {
    bool from_devices = false; ///< recompute the commands from the devices and compare
    bool any_data = false;     ///< the data need not be the recorded ones
    std::optional<stereo::StereoMode> stereo;        ///< instead of every recorded one
    std::optional<interaction::QualityMode> quality; ///< instead of every recorded one
};

/// Called after each frame, with its number from 0.
using FrameDone = std::function<void(std::size_t number, const interaction::RecordedFrame& frame)>;

/// Whether nothing is drawn of a frame: what it asks for is obeyed in the next one that is drawn.
using Skips = std::function<bool(std::size_t number)>;

/// @throws index::Error when the cells of the last frame could not be found, so that its picture
/// would be wrong
void expect_cells(const Session& session);

/// Replays with fixed steps: each recorded frame once, at its recorded time; each waits for its
/// cells.
/// @param skips asked before each frame, in their order; empty: all are drawn
/// @return one line per frame whose recomputed commands differ (none without `from_devices`)
/// @throws index::Error as expect_cells, after each frame
std::vector<std::string> replay_fixed_step(Session& session,
                                           const interaction::Recording& recording,
                                           const ReplayOptions& options, const FrameDone& done,
                                           const Skips& skips = {});

/// Replays the recorded heads and hands in front of the test pattern, each frame once.
void replay_pattern(PatternShow& show, const interaction::Recording& recording,
                    const ReplayOptions& options, const FrameDone& done);

/// Replays in real time, as a session goes: obeys every command, and frames wait for nothing but
/// the display. Ends with the recording or when the window closes.
/// @param frame_rate_limit [1/s] where no display paces the frames
/// @param control shows its clients the frames; null: nobody watches from outside
void replay_live(Session& session, const interaction::Recording& recording,
                 const ReplayOptions& options, double frame_rate_limit,
                 SessionControl* control = nullptr);

/// The start state in a header. With `options.any_data` settings that are not valid for these data
/// keep what `fallback` has.
/// @throws interaction::Error naming those settings, with their values and what is expected
ExplorerState start_of(const interaction::RecordingHeader& header, const ExplorerState& fallback,
                       std::size_t steps, const ReplayOptions& options);

} // namespace isochron::app
