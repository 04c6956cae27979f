// What works beside the frames of a live session: saves, records, exports, steers, watches.
//
// In each turn the live loop reads the devices and the panel, and calls `before_frame` of all
// companions, in the order of `CompanionPlace`. It makes the frame from all commands. It calls
// `after_frame` of each companion and shows its messages, in this order again; then `outlook`, and
// `rest` if nothing is to be done. At the end it calls `finish` in the reverse order. A companion
// waits in `finish` alone.
#pragma once

#include "app/session/session.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace isochron::app {

/// The turns of the companions.
enum class CompanionPlace : std::uint8_t {
    control, ///< its clients see a frame before anything is done with it
    keeper,
    recording, ///< has a frame before a movie is made of the recording
    surfaces,  ///< behind the control, whose clients may want another export
    watch,     ///< behind the control: new steps are followed whatever step its clients want
    advice,    ///< behind the watch, which shows the last steps
    movies     ///< finishes first: a movie that is being made needs the recording
};

/// A frame that the live loop has made.
struct LiveFrame {
    const interaction::InputState& input;
    const interaction::Commands& commands;
    const interaction::Commands& from_panel; ///< the commands that a replay could not compute
    const FrameReport& drawn;
    interaction::StandingPlace head; ///< where the emulated head stands
};

class Companion {
  public:
    /// Time between two looks for what a process or a thread says that wakes nobody.
    static constexpr interaction::Seconds kLookForWords{0.1};

    virtual ~Companion() = default;
    /// Called once, before all else. @param wake ends the loop's wait, from any thread
    virtual void set_wake(std::function<void()> /*wake*/) {}
    /// Adds commands for the next frame. @param by_user commands of the devices and the panel
    virtual void before_frame(Session& /*session*/, const interaction::Commands& /*by_user*/,
                              interaction::Commands& /*asked*/) {}
    virtual void after_frame(Session& /*session*/, const LiveFrame& /*frame*/) {}
    /// What the user is told; each line once.
    virtual std::vector<std::string> messages() { return {}; }
    /// When the next frame is due for it. @param now session time
    virtual FrameOutlook outlook(interaction::Seconds /*now*/) const { return {.final = true}; }
    /// The loop waits; it may be long until the next frame.
    virtual void rest() {}
    /// Why other data are not to be opened now, as work would be lost; empty: they can be.
    virtual std::string why_stay() const { return {}; }
    /// Ends the work. @return the last messages @throws index::Error, interaction::Error when
    /// something cannot be written
    virtual std::vector<std::string> finish(const Session& /*session*/) { return {}; }
    /// Saves what would be lost if the process ended now, as it does then. Called while nothing but
    /// drawing may go on, maybe on another thread. @throws as `finish`
    virtual void save(const Session& session) { finish(session); }
};

} // namespace isochron::app
