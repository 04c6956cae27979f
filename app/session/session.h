// One session: brings data, search, devices and displays together, frame by frame.
//
//     app::Session session(config, file, *context);
//     while (!session.should_close()) {
//         const auto input = emulation.poll(clock.now());
//         session.frame(input, session.commands_from(input), app::Waiting::never);
//     }
#pragma once

#include "app/choice/cell_supply.h"
#include "app/choice/further_supply.h"
#include "app/choice/ghost_supply.h"
#include "app/choice/model_supply.h"
#include "app/choice/partial_pictures.h"
#include "app/choice/settled_samples.h"
#include "app/choice/slice_supply.h"
#include "app/cluster/frame_sharing.h"
#include "app/cluster/frames_alone.h"
#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "app/frame/history.h"
#include "app/frame/idle_wait.h"
#include "app/frame/late_latch.h"
#include "app/output/outputs.h"
#include "app/quality/capture_wait.h"
#include "app/quality/frame_plan.h"
#include "app/scene/scene.h"
#include "app/session/frame_planner.h"
#include "app/session/nothing_seen.h"
#include "app/session/picker.h"
#include "app/session/picture_maker.h"
#include "app/session/piece_lister.h"
#include "app/session/preparation.h"
#include "app/session/session_curves.h"
#include "app/session/session_panel.h"
#include "app/session/shown_arrays.h"
#include "app/session/window_contents.h"
#include "index/extraction/extractor.h"
#include "interaction/controls/controls.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

class Session {
  public:
    /// @param windows of the configured installation, or a context for its only window that
    /// outlives the session; the drawing context is current on this thread
    /// @param extract replaces the extraction from `file`, for tests; empty: the real one
    /// @param headset to draw for instead of the installation's windows; the first window mirrors
    /// it; null: none
    /// @throws render::Error as Outputs, or when a shader does not compile
    Session(Config config, std::shared_ptr<const index::IndexFile> file, stereo::Windows windows,
            index::Extract extract = {}, std::unique_ptr<stereo::Headset> headset = nullptr);

    /// Sets how all further frames are shared; a session starts alone. @param frames not null
    void share_frames(std::unique_ptr<FrameSharing> frames) { frames_ = std::move(frames); }
    FrameSharing& frames() { return *frames_; }
    /// Whether the user wants to close a window of this process or of another one.
    bool should_close() const;
    const ExplorerState& state() const { return state_; }
    /// @throws index::Error when the index lacks the array of the surfaces
    void set_state(const ExplorerState& state);
    /// Commands that show an array as it was left, or as at a first look.
    /// @param number as `index::IndexFile::array` takes it
    interaction::Commands way_to_array(std::size_t number) const {
        return arrays_.way_to(number, state_);
    }
    /// How arrays that are not shown were left, for `SavedSession`; `recall_arrays` sets it again.
    std::vector<interaction::Commands> left_arrays() const { return arrays_.left(state_); }
    void recall_arrays(const std::vector<interaction::Commands>& left) { arrays_.recall(left); }
    /// @param name of an array of the surfaces; empty: the first
    /// @throws index::Error when the index has no such array
    void expect_array(const std::string& name) const { arrays_.expect(name); }
    const ExplorerState& home() const { return home_; }
    void set_home(const ExplorerState& home); ///< before the first frame
    /// The data with all their arrays.
    const std::shared_ptr<const index::IndexFile>& file() const { return arrays_.file(); }
    /// Continues with the same data that have more steps. The command `steps` makes them visible.
    void grow(std::shared_ptr<const index::IndexFile> file);
    const History& history() const { return history_; }

    /// The commands that the devices lead to in this frame. Advances what turns devices into
    /// commands (the controls, the panel in the room and the picker) and changes nothing else.
    interaction::Commands commands_from(const interaction::InputState& input);

    /// The ray from the eye through the cursor, for a head that mouse and keyboard emulate; empty
    /// if the cursor is over the operator's panel.
    std::optional<interaction::Pose> ray_at(const interaction::MouseMoveEvent& cursor,
                                            const interaction::Pose& head) const;

    /// Size of the panel in the room, for the emulation of a wand.
    interaction::PanelSize room_panel_size() const { return panel_.in_room().size(); }

    /// Commands that a replay could not compute from the devices: the commands that the operator's
    /// panel gave during the last frame, and what `commands_from` found in the shown picture. Take
    /// them once, before the next frame.
    interaction::Commands take_panel_commands();

    OperatorPanel& panel() { return panel_.over(); }
    const OperatorPanel& panel() const { return panel_.over(); }
    /// Passes window events to the panel. @return the events that it does not use
    std::vector<interaction::WindowEvent>
    panel_events(std::span<const interaction::WindowEvent> events) {
        return panel_.feed(events, state_);
    }

    /// Draws everything once off screen, and a cell in each way: drivers compile shaders when they are
    /// first used.
    /// @param goes_on asked before each way, with the share of the ways that is done: false ends it
    void warm_up(const std::function<bool(float)>& goes_on = [](float) { return true; });
    /// Instead of `warm_up`, for one window with one viewport: draws off screen what the first picture
    /// needs, and leaves all else to `prepare_some`.
    /// @param goes_on as of `warm_up` @param beside a context for a thread, see `Preparation`
    void prepare_first(const std::function<bool(float)>& goes_on,
                       std::unique_ptr<stereo::GlContext> beside);
    /// Draws some of the rest off screen, between two frames. @return whether it has
    bool prepare_some();
    bool prepares() const { return preparation_.has_value(); } ///< there is some left
    /// Makes one frame, from commands to the presented picture.
    /// @param latch returns where the heads are when the views are made; empty: as in `input`
    const FrameReport& frame(const interaction::InputState& input,
                             const interaction::Commands& commands, Waiting waiting,
                             const Latch& latch = {});
    /// The heads from the last frame's latch, for its recording; may be none.
    const interaction::InputState& latched() const { return note_.latched; }
    /// Sets the function that returns session time, to measure the latency from input to picture.
    /// Without it a frame's input counts as polled when the frame begins.
    void set_clock(std::function<interaction::Seconds()> clock) { clock_ = std::move(clock); }

    /// Sets the time between two pictures of a headset that paces the frames; empty: none does.
    void set_headset_period(std::optional<interaction::Seconds> period) {
        choice_.quality().set_headset_period(period);
    }

    /// Sets the function that is called, on any thread, when the next frame may have something new.
    void set_wake(const std::function<void()>& wake);
    /// What the last frame tells about the next one.
    FrameOutlook outlook() const;
    /// Tells that the loop has waited for something to do since the last frame, so that the time
    /// between the two frames says nothing about how long frames take.
    void has_waited() { waited_ = true; }

    /// Shows the last of these messages on the panel until there is a newer one.
    void show_messages(std::vector<std::string> messages) {
        panel_.show_messages(std::move(messages));
    }
    /// Shows this on the picture as long as it is not empty.
    void set_standing(std::string note) { panel_.set_standing(std::move(note)); }
    void set_recording(bool recording) { panel_.set_recording(recording); }
    /// Sets what the panel shows about movies from now on.
    void set_movies(const MovieState& movies) { panel_.set_movies(movies); }
    /// Sets the sessions that the user can go on with, the last one first.
    void set_sessions(std::vector<OfferedSession> sessions) {
        panel_.set_sessions(std::move(sessions));
    }
    /// Times of the known steps.
    const interaction::StepTimes& times() const { return times_; }

    /// Sets the file name of the data, for the notes in pictures.
    /// @param recorded_on hash of the recording's data, if those are others
    void set_data_name(const std::string& name, const std::string& recorded_on = {}) {
        note_.data = name;
        note_.recorded_on = recorded_on;
    }
    /// Sets the title of the frames that follow.
    void set_title(const Title& title) { pictures_.set_title(title); }
    /// What is under the pointer in the last frame, or marked, in words; empty: nothing.
    std::string pointed() const { return pictures_.words_under_pointer(note_.input, state_); }
    PictureNote note() const; ///< about the last frame
    /// What a capture needs of the last frame.
    CaptureView capture_view(const FrameReport& frame) const;
    /// Whether somebody else than the session waits for a capture: then it gets all its samples before
    /// more is prepared.
    void set_awaited(bool awaited) { awaited_ = awaited; }
    /// Scale of all colors.
    std::optional<ColorScale> scale() const { return pictures_.scale(state_); }
    /// What the legend of the last picture says of its ghosts, by time.
    std::vector<LegendLine> ghost_lines() const {
        return drawn_ ? lines_of_ghosts(*drawn_) : std::vector<LegendLine>();
    }

    /// The files of triangles beside the surfaces, and which may be opened.
    ModelSupply& models() { return models_; }
    const ModelSupply& models() const { return models_; }
    /// Shows a file of triangles from the next frame on. @return why it cannot; empty: it will be read
    std::string show_model(const std::filesystem::path& file);
    /// Surfaces of other steps beside those that are shown.
    const GhostSupply& ghosts() const { return ghosts_; }
    /// Surfaces of other arrays beside those of the shown one.
    const FurtherSupply& further() const { return further_; }

    /// Why the newest query could not be answered; empty when all is well.
    std::string failure() const { return frames_->failure(supply_.extractor()); }
    /// The windows or headset that show the frames, and write pictures.
    Outputs& outputs() { return outputs_; }
    const Outputs& outputs() const { return outputs_; }
    const FrameLog& log() const { return log_; }
    FrameLog& log() { return log_; }
    /// The context, its driver, and the driver's features that do not work; one line for reports.
    std::string drawing() const;
    /// Sets where curves over all steps are kept and saved; before the first frame.
    void write_curves_to(CurveFolders folders) { curves_.write_to(std::move(folders)); }
    /// What has been read from the index since it was opened.
    index::ReadUse reading() const { return arrays_.file()->reading(); }

  private:
    std::size_t steps() const { return state_.known_steps(arrays_.file()->info().steps()); }
    interaction::ControlContext control_context(const interaction::Ways& ways) const;
    void obey(const interaction::Commands& commands, const interaction::InputState& input);
    void grow_with(const interaction::Commands& commands);
    interaction::InputState seen(const interaction::InputState& input, const Latch& latch,
                                 FrameReport& report);
    void draw_eyes(const Frame& frame, const Picture& now, const interaction::InputState& input,
                   const SessionPanel::Facts& facts);
    void draw_anew(const Frame& frame, const Picture& now, const Outputs::Overlay& overlay);
    void show_again(const Frame& frame, const Picture& now, const Outputs::Overlay& overlay,
                    const SessionPanel::Facts& facts);
    void draw_aids();
    interaction::Similarity home_place() const;
    interaction::Similarity all_in_view(const Audience& audience) const;
    bool is_settled(const Frame& frame) const;
    std::optional<glm::vec2> told_at() const;
    bool fades_to_steps() const;     ///< steps of a story come by a fade
    bool samples_come_later() const; ///< behind what is still to be prepared
    /// Whether what stands beside the cells is still to be made.
    bool more_comes() const {
        return slices_.come() || models_.come() || ghosts_.come() || further_.come();
    }
    PanelModel panel_model(const FrameReport& report);
    FrameAnswer answer() const;

    Config config_;
    Outputs outputs_;
    ExplorerState state_;
    ExplorerState home_;
    ShownArrays arrays_;
    interaction::StepTimes times_; ///< times of the known steps
    interaction::Controls controls_;
    interaction::MotionGate gate_;
    interaction::Comfort comfort_;
    Scene scene_;
    SessionPanel panel_;
    Picker picker_;
    History history_;
    FrameLog log_;
    CellSupply supply_;
    SliceSupply slices_;
    ModelSupply models_;
    GhostSupply ghosts_;
    FurtherSupply further_;
    PictureMaker pictures_;
    FramePlanner choice_;
    PartialPictures partial_;
    SettledSamples samples_;
    NothingSeen nothing_;
    SessionCurves curves_;
    PieceLister pieces_;
    std::unique_ptr<FrameSharing> frames_ = std::make_unique<FramesAlone>();
    FramePlan plan_;               ///< plan of the last frame
    std::optional<Picture> drawn_; ///< last picture
    WindowContents contents_;
    bool waited_ = false;          ///< see `has_waited`
    bool told_of_lifting_ = false; ///< the user knows that the background is lifted
    CaptureWait captures_;
    bool awaited_ = false;
    std::optional<Preparation> preparation_; ///< while it goes on
    std::function<interaction::Seconds()> clock_;
    PictureNote note_; ///< note on the last frame: the data's names and the devices
};

} // namespace isochron::app
