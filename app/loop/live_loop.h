// The live loop: makes frames from the state of the devices, at the display's pace, until the user
// leaves.
//
//     LiveLoop live(config, std::move(trackers), {}, session.outputs().headset());
//     live.join(CompanionPlace::recording, recording);
//     live.run(session);
//     live.finish(session);
#pragma once

#include "app/config/config.h"
#include "app/frame/idle_wait.h"
#include "app/frame/late_latch.h"
#include "app/loop/companion.h"
#include "app/loop/data_opening.h"
#include "app/loop/headset_loop.h"
#include "app/loop/pattern_show.h"
#include "app/output/room_camera.h"
#include "app/session/session.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/input/composite_input.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

struct LiveOptions {
    bool emulated = false; ///< the room is shown from outside: mouse and keys also move its camera
    std::optional<interaction::Seconds> length; ///< time after which the loop ends; empty: never
    std::function<bool()> ended = [] {
        return false;
    }; ///< called in each frame; true: ends the loop
    /// Returns in one line why the given data cannot be opened instead of these; empty: they can,
    /// and the loop ends. A null function: the user cannot open other data.
    /// Called on a thread of its own.
    std::function<std::string(const std::filesystem::path&)> why_not_open;
    std::string stays = {}; ///< why these data cannot give way to others; empty: they can
    /// What a user who wants to save is told where the session is not saved.
    std::string not_kept = "this session is not saved";
    /// Called in each frame: the picture shows the note that it returns.
    std::function<std::string()> standing = [] { return std::string(); };
    /// Returns the link to what is shown; null: the data were not opened by a link.
    std::function<std::string()> link = {};
    std::vector<interaction::WindowEvent> early = {}; ///< events before the first frame
    /// The early events, which are taken, and behind them these.
    std::vector<interaction::WindowEvent>
    behind_early(const std::vector<interaction::WindowEvent>& events) {
        early.insert(early.end(), events.begin(), events.end());
        return std::exchange(early, {});
    }
    /// Returns the session time, for tests; null: the time since the loop was constructed.
    std::function<interaction::Seconds()> clock = {};
};

/// Session time starts at 0 when the loop is constructed.
class LiveLoop {
  public:
    /// @param config outlives the loop
    /// @param trackers take precedence over devices that mouse and keyboard emulate
    /// @param headset attached, outlives the loop; or null
    LiveLoop(const Config& config, interaction::CompositeInput trackers, const LiveOptions& options,
             stereo::Headset* headset = nullptr);

    /// Ends the loop's wait for something to do. Outlives the loop where others keep it.
    std::shared_ptr<const stereo::Wake> wake() const { return wake_; }
    /// A function that ends the wait, from any thread.
    std::function<void()> waker() const {
        return [wake = wake_] { (*wake)(); };
    }
    /// A function that returns the session time.
    std::function<interaction::Seconds()> clock() const { return clock_; }

    /// Lets a companion work beside all further frames, instead of one that had its place.
    void join(CompanionPlace place, std::shared_ptr<Companion> companion);
    /// The session is not saved. @param why what a user who wants to save is told
    void keep_no_session(std::string why) { options_.not_kept = std::move(why); }
    /// Where the emulated head stands.
    interaction::StandingPlace standing() const { return emulation_.standing(); }
    void stand(const interaction::StandingPlace& place) { emulation_.stand(place); }

    /// Other data that the user wants to see; empty: the user leaves.
    const std::optional<NextData>& next_data() const { return opening_.next_data(); }

    /// Runs until the user closes a window, leaves by a device or through the headset's runtime, or
    /// the time is over; then leaves the headset.
    void run(Session& session);
    void run(PatternShow& show);

    /// Ends the work of all companions. @return what the user is told of it
    /// @throws index::Error, interaction::Error when something cannot be written
    std::vector<std::string> finish(const Session& session);
    /// Instead of `finish`, where the process ends now.
    void save(const Session& session) const;
    /// Status of the trackers and the headset, a line each.
    std::vector<std::string> status() const;

  private:
    interaction::InputState poll(std::span<const interaction::WindowEvent> events);
    bool goes_on(const interaction::Commands& commands, const interaction::InputState& input) const;
    std::string unfinished() const;
    bool closes(const Session& session, interaction::Commands& asked) const;
    bool may_wait(const FrameSharing& frames, const stereo::Headset* headset) const;
    std::vector<interaction::WindowEvent> new_events(const stereo::Windows& windows);
    FrameOutlook outlook(const interaction::InputState& input, bool acted) const;
    bool wait(const FrameOutlook& next, const stereo::Windows& windows);

    const Config& config_;
    LiveOptions options_;
    interaction::CompositeInput trackers_;
    interaction::DesktopEmulation emulation_;
    RoomCamera camera_;
    HeadsetLoop headset_;
    const std::shared_ptr<const stereo::Wake> wake_ = std::make_shared<stereo::Wake>();
    IdleWait idle_;
    bool waited_ = false; ///< before this frame
    std::map<CompanionPlace, std::shared_ptr<Companion>> companions_;
    DataOpening opening_;                               ///< opens data that the user has chosen
    const std::function<interaction::Seconds()> clock_; ///< last: its time starts when all is ready
};

} // namespace isochron::app
