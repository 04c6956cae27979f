// The live loop: makes frames from the state of the devices, at the display's pace, until the user
// leaves.
//
//     LiveLoop live(config, std::move(trackers), {}, session.outputs().headset());
//     live.record("walk.jsonl", header);
//     live.run(session);
//     live.finish(session);
#pragma once

#include "app/config/config.h"
#include "app/frame/idle_wait.h"
#include "app/frame/late_latch.h"
#include "app/output/room_camera.h"
#include "app/output/surface_maker.h"
#include "app/session/data_opening.h"
#include "app/session/headset_loop.h"
#include "app/session/kept/live_recording.h"
#include "app/session/kept/session_keeper.h"
#include "app/session/movie_maker.h"
#include "app/session/pattern_show.h"
#include "app/session/session.h"
#include "app/session/session_control.h"
#include "index/file/index_watch.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/input/composite_input.h"

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
    /// Called in each frame: the picture shows the note that it returns. May be null.
    std::function<std::string()> standing = {};
    std::vector<interaction::WindowEvent> early = {}; ///< events that came before the first frame
    /// These events behind the early ones, which are taken.
    std::vector<interaction::WindowEvent>
    behind_early(const std::vector<interaction::WindowEvent>& events) {
        early.insert(early.end(), events.begin(), events.end());
        return std::exchange(early, {});
    }
    /// Returns the session time, for tests; null: the time since the loop was constructed.
    std::function<interaction::Seconds()> clock = {};
};

/// What the user wants to see next.
struct NextData {
    std::filesystem::path data;
    std::string array = {}; ///< another array of these files, instead of `data`; empty: other data
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
    /// A function that returns the session time.
    std::function<interaction::Seconds()> clock() const { return clock_; }

    /// Records all further frames in the background, so that a slow disk does not delay pictures.
    /// @throws interaction::Error when the file cannot be created
    void record(const std::filesystem::path& path, const interaction::RecordingHeader& header);

    /// Whether frames are recorded: no longer once one could not be written.
    bool records() const { return recording_.records(); }

    /// Shows new steps of the index when they come. @param path of the open index
    void watch(const std::filesystem::path& path, std::shared_ptr<const index::IndexFile> file);

    /// Lets clients steer the session from outside. @param control outlives the loop
    void steer(SessionControl& control);

    /// Lets the user have movies made.
    void offer_movies(MovieOrders orders) { movies_.emplace(std::move(orders)); }

    /// Lets the user export surfaces. @param file that is shown @param folder of what is exported
    void offer_surfaces(std::shared_ptr<const index::IndexFile> file,
                        const std::filesystem::path& folder) {
        surfaces_.emplace(std::move(file), folder, waker());
    }

    /// Saves the session to a file, from which it can be resumed. @param start the session as it
    /// begins @param resumed it was itself resumed from that file
    void keep_session(const std::filesystem::path& path, const SavedSession& start, bool resumed);
    /// The session is not kept. @param why what the user is told who wants to save it
    void keep_no_session(std::string why) { not_kept_ = std::move(why); }
    /// Where the emulated head stands.
    interaction::StandingPlace standing() const { return emulation_.standing(); }
    void stand(const interaction::StandingPlace& place) { emulation_.stand(place); }

    /// Other data that the user wants to see; empty: the user leaves.
    const std::optional<NextData>& next_data() const { return next_data_; }

    /// Runs until the user closes a window, leaves by a device or through the headset's runtime, or
    /// the time is over; then leaves the headset.
    void run(Session& session);
    void run(PatternShow& show);

    /// Completes the recording, if there is one, and saves the session.
    /// @throws index::Error, interaction::Error when it cannot be written
    void finish(const Session& session);
    /// Status of the trackers and the headset, a line each.
    std::vector<std::string> status() const;

  private:
    interaction::InputState poll(std::span<const interaction::WindowEvent> events);
    bool goes_on(const interaction::Commands& commands, const interaction::InputState& input) const;
    void take_next_data(Session& session);
    void keep(Session& session, const interaction::Commands& commands, interaction::Seconds now);
    std::string why_data_stay() const;
    void open(const std::filesystem::path& data, Session& session);
    void note_work(Session& session) const;
    void make_movies(Session& session);
    std::filesystem::path chosen_folder(const Session& session) const;
    void place_pictures(Session& session);
    std::optional<interaction::ExportWork> export_surfaces(Session& session);
    void begin_or_end_recording(Session& session);
    void take_new_steps(Session& session, interaction::Commands& asked);
    bool closes(const Session& session, interaction::Commands& asked) const;
    std::function<void()> waker() const;
    bool may_wait(const FrameSharing& frames, const stereo::Headset* headset) const;
    std::vector<interaction::WindowEvent> new_events(const stereo::Windows& windows);
    FrameOutlook outlook(const interaction::InputState& input) const;
    bool wait(const FrameOutlook& next, const stereo::Windows& windows);

    const Config& config_;
    LiveOptions options_;
    interaction::CompositeInput trackers_;
    interaction::DesktopEmulation emulation_;
    RoomCamera camera_;
    HeadsetLoop headset_;
    bool paced_ = false; ///< the headset paces this frame
    const std::shared_ptr<const stereo::Wake> wake_ = std::make_shared<stereo::Wake>();
    IdleWait idle_;
    bool waited_ = false; ///< before this frame
    bool acted_ = false;  ///< the user did something before this frame
    std::optional<SessionKeeper> keeper_;
    std::string not_kept_ = "this session is not saved"; ///< why, where it is not kept
    std::string picture_folder_; ///< folder that the user has chosen; empty: none
    std::optional<index::IndexWatch> watch_;
    std::optional<NextData> next_data_;
    DataOpening opening_; ///< opens data that the user has chosen
    LiveRecording recording_;
    std::optional<MovieMaker> movies_;
    std::optional<SurfaceMaker> surfaces_;
    SessionControl* control_ = nullptr;   ///< null: nobody steers from outside
    std::vector<std::string> last_words_; ///< what became of the last movie when the loop had ended
    const std::function<interaction::Seconds()> clock_; ///< last: its time starts when all is ready
};

} // namespace isochron::app
