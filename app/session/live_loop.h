// The live loop: what devices state becomes frames, at the pace of what shows them, until the user
// leaves.
//
//     LiveLoop live(config, std::move(trackers), {}, session.outputs().headset());
//     live.record("walk.jsonl", header);
//     live.run(session);
//     live.finish(session.state());
#pragma once

#include "app/config/config.h"
#include "app/frame/background_work.h"
#include "app/frame/late_latch.h"
#include "app/output/room_camera.h"
#include "app/session/headset_loop.h"
#include "app/session/movie_maker.h"
#include "app/session/pattern_show.h"
#include "app/session/session.h"
#include "app/session/session_keeper.h"
#include "index/file/index_watch.h"
#include "interaction/composite_input.h"
#include "interaction/desktop_emulation.h"
#include "interaction/recording/recording.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

struct LiveOptions {
    bool emulated = false; ///< the room is shown from outside: mouse and keys move its camera, too
    std::optional<interaction::Seconds> length; ///< the loop ends after this long; empty: never
    std::function<bool()> ended = [] { return false; }; ///< asked in each frame: the loop ends
    /// What keeps other data from being opened in the place of these, in one line; empty: nothing
    /// does, and the loop ends for it. None where these are all there will be.
    std::function<std::string(const std::filesystem::path&)> why_not_open;
};

/// Session time starts with it, at 0.
class LiveLoop {
  public:
    /// @param config outlives the loop
    /// @param trackers go before what mouse and keyboard emulate
    /// @param headset attached, outlives the loop; or null
    LiveLoop(const Config& config, interaction::CompositeInput trackers, const LiveOptions& options,
             stereo::Headset* headset = nullptr);

    /// Session time as it goes on.
    std::function<interaction::Seconds()> clock() const;

    /// Records the frames to come, in the background: a slow disk delays the recording, not the
    /// picture. @throws interaction::Error when the file cannot be created
    void record(const std::filesystem::path& path, const interaction::RecordingHeader& header);

    /// Shows new steps of the index when they come. @param path of the index that is open
    void watch(const std::filesystem::path& path, std::shared_ptr<const index::IndexFile> file);

    /// Lets the user have movies made.
    void offer_movies(MovieOrders orders) { movies_.emplace(std::move(orders)); }

    /// Keeps what the user comes to, to go on from there. @param resumed what this session began as
    void keep_session(const std::filesystem::path& path, const SavedSession& start, bool resumed);
    /// Where the emulated head is.
    interaction::StandingPlace standing() const { return emulation_.standing(); }
    void stand(const interaction::StandingPlace& place) { emulation_.stand(place); }

    /// What the user wants to see instead; nothing: they leave.
    const std::optional<std::filesystem::path>& next_data() const { return next_data_; }

    /// Until the user closes a window, leaves by a device or ends the headset's program, or the
    /// time is over; a headset is left then.
    void run(Session& session);
    void run(PatternShow& show);

    /// Completes the recording, if there is one, and keeps the session.
    /// @throws index::Error, interaction::Error when it cannot be written
    void finish(const ExplorerState& state);
    /// What trackers and headset say of themselves: a line each.
    std::vector<std::string> status() const;

  private:
    interaction::InputState poll(std::span<const interaction::WindowEvent> events);
    bool goes_on(const interaction::Commands& commands, const interaction::InputState& input) const;
    void record(interaction::RecordedFrame frame);
    void take_next_data(Session& session);
    std::string why_not_open(const std::filesystem::path& data) const;
    void make_movies(Session& session);
    void take_new_steps(Session& session, interaction::Commands& asked);
    bool closes(const Session& session, interaction::Commands& asked) const;

    const Config& config_;
    const LiveOptions options_;
    interaction::CompositeInput trackers_;
    interaction::DesktopEmulation emulation_;
    RoomCamera camera_;
    HeadsetLoop headset_;
    bool paced_ = false; ///< by the headset, in this frame
    std::optional<SessionKeeper> keeper_;
    std::optional<index::IndexWatch> watch_;
    std::optional<std::filesystem::path> next_data_;
    BackgroundWork recording_;
    /// Lives on the thread that writes.
    std::shared_ptr<interaction::RecordingWriter> recorder_;
    std::optional<MovieMaker> movies_;
    std::vector<std::string> last_words_; ///< what became of the last movie when the loop had ended
    const std::function<interaction::Seconds()> clock_; ///< last: its time starts when all is ready
};

} // namespace isochron::app
