// One session: brings data, search, devices and displays together, frame by frame.
//
//     app::Session session(config, file, *context);
//     while (!session.should_close()) {
//         const auto input = emulation.poll(clock.now());
//         session.frame(input, session.commands_from(input), app::Waiting::never);
//     }
#pragma once

#include "app/cluster/frame_sharing.h"
#include "app/cluster/frames_alone.h"
#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "app/frame/history.h"
#include "app/frame/late_latch.h"
#include "app/frame/stop_watch.h"
#include "app/output/outputs.h"
#include "app/panel/operator_panel.h"
#include "app/panel/panel_in_room.h"
#include "app/quality/capture_wait.h"
#include "app/quality/detail_choice.h"
#include "app/quality/frame_quality.h"
#include "app/quality/slice_pace.h"
#include "app/scene/scene.h"
#include "app/session/picker.h"
#include "index/extraction/extractor.h"
#include "interaction/controls/controls.h"

#include <functional>
#include <map>
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
    /// @param headset to draw for instead of the installation's windows, the first of which mirrors
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
    interaction::Commands way_to_array(std::size_t number) const;
    /// For `SavedSession`: how arrays that are not shown were left; `recall_arrays` sets it again.
    std::vector<interaction::Commands> left_arrays() const;
    void recall_arrays(const std::vector<interaction::Commands>& left);
    /// @param name of an array of the surfaces; empty: the first
    /// @throws index::Error when the index has no such array
    void expect_array(const std::string& name) const;
    const ExplorerState& home() const { return home_; }
    /// Continues with the same data that have more steps. The command `steps` makes them visible.
    void grow(std::shared_ptr<const index::IndexFile> file);
    const History& history() const { return history_; }

    /// The commands that the devices lead to in this frame. Advances the controls; changes nothing
    /// else.
    interaction::Commands commands_from(const interaction::InputState& input);

    /// The ray from the eye through the cursor, for a head that mouse and keyboard emulate; empty
    /// if the cursor is over the operator's panel.
    std::optional<interaction::Pose> ray_at(const interaction::MouseMoveEvent& cursor,
                                            const interaction::Pose& head) const;

    /// Size of the panel in the room, for the emulation of a wand.
    interaction::PanelSize room_panel_size() const { return room_panel_.size(); }

    /// Commands that a replay could not compute from the devices: those of the operator's panel
    /// during the last frame, and what picking found in the shown picture. Take them once, before
    /// the next frame.
    interaction::Commands take_panel_commands();

    OperatorPanel& panel() { return panel_; }

    /// Passes window events to the panel. @return the events that it does not use
    std::vector<interaction::WindowEvent>
    panel_events(std::span<const interaction::WindowEvent> events);

    /// Draws once what nobody sees, before the first frame: drivers compile what they draw with
    /// when it is first used, which takes longer than a frame may.
    void warm_up();
    /// Makes one frame, from commands to the presented picture.
    /// @param latch returns where the heads are when the views are made; empty: as in `input`
    const FrameReport& frame(const interaction::InputState& input,
                             const interaction::Commands& commands, Waiting waiting,
                             const Latch& latch = {});
    /// The heads from the last frame's latch, for its recording; may be none.
    const interaction::InputState& latched() const { return latched_; }
    /// Sets the function that returns session time, to measure the latency from input to picture.
    /// Without it a frame's input counts as polled when the frame begins.
    void set_clock(std::function<interaction::Seconds()> clock) { clock_ = std::move(clock); }

    /// Sets the time between two pictures of a headset that paces the frames; empty: none does.
    void set_headset_period(std::optional<interaction::Seconds> period);

    /// Shows the last of these messages on the panel until there is a newer one.
    void show_messages(std::vector<std::string> messages);
    /// Shows this on the picture as long as it is not empty.
    void set_standing(std::string note) { standing_ = std::move(note); }
    void say_refused(const index::ExtractionPtr& set, FrameReport& report);
    void set_recording(bool recording) { recording_ = recording; }
    /// Sets what the panel shows about movies from now on.
    void set_movies(const MovieState& movies) { movies_ = movies; }
    /// Times of the known steps.
    std::span<const double> times() const { return times_; }

    /// Sets the file name of the data, for the notes in pictures.
    /// @param recorded_on hash of the recording's data, if those are others
    void set_data_name(const std::string& name, const std::string& recorded_on = {}) {
        data_name_ = name;
        recorded_on_ = recorded_on;
    }
    /// Note about the last frame.
    PictureNote note() const;

    /// Why the newest query could not be answered; empty when all is well.
    std::string failure() const;
    /// The windows or headset that show the frames, and write pictures.
    Outputs& outputs() { return outputs_; }
    const Outputs& outputs() const { return outputs_; }
    const FrameLog& log() const { return log_; }
    /// The context, its driver, and the driver's features that do not work; one line for reports.
    std::string drawing() const;
    /// What has been read from the index since it was opened.
    index::ReadUse reading() const { return file_->reading(); }

  private:
    /// Share of a window's width for the panel in the room, if the head is emulated.
    static constexpr float kPanelShare = 0.4f;

    /// A picture that is drawn over several frames, and how far it has come.
    struct Slices {
        explicit Slices(const Picture& wanted) : picture(wanted) {}
        Picture picture;
        SlicePace pace;
        Outputs::SlicePlace place;
        std::size_t done = 0;     ///< units of work done at `place`
        Milliseconds prepared{0}; ///< of the time: spent on what serves other views, too
        bool whole = false;
    };

    void take_arrays();
    void turn_to_array(const ExplorerState& before);
    std::size_t array_number() const { return file_->array_called(state_.array).value_or(0); }
    /// The array whose surfaces are asked for.
    const index::IndexFile& array() const { return file_->array(array_number()); }
    index::SurfacesQuery surfaces() const;
    interaction::ControlContext control_context() const;
    void grow_with(const interaction::Commands& commands);
    std::size_t steps() const { return state_.known_steps(file_->info().steps()); }
    interaction::Commands way_to_start() const;
    void request_cells(Waiting waiting);
    void take_newest_cells(Waiting waiting, FrameReport& report);
    bool colored_as_asked() const;
    std::optional<ColorScale> scale() const;
    std::optional<ColorScale> shown_scale() const;
    Picture picture(const interaction::InputState& input, const FrameReport& report);
    Aids aids(const interaction::InputState& input) const;
    bool aids_lie_over() const;
    void draw_aids();
    interaction::InputState seen(const interaction::InputState& input, const Latch& latch,
                                 FrameReport& report);
    bool in_windows(const FrameReport& report);
    void learn_costs();
    void choose_quality(Picture& now, Waiting waiting, FrameReport& report);
    bool agree(bool measure, const index::DetailQuery& detail, FrameReport& report);
    bool is_finest(Waiting waiting) const;
    void choose_set(Picture& now, Waiting waiting, FrameReport& report);
    index::DetailQuery wanted_detail(Waiting waiting, const FrameReport& report);
    index::DetailQuery detail_for_live(Waiting waiting, const FrameReport& report);
    index::DetailQuery detail_at_rest(Waiting waiting, std::uint64_t moving,
                                      interaction::Seconds rested);
    bool waits_its_turn(const index::ExtractionPtr& set) const;
    bool comes_too_late(const index::ExtractionPtr& set, Waiting waiting) const;
    bool comes_late(const index::ExtractionPtr& set) const;
    bool is_half_sent() const;
    bool set_comes() const;
    bool give_way(const index::ExtractionPtr& set);
    void report_cells(FrameReport& report) const;
    FrameAnswer answer() const;
    bool captures(const FrameReport& report);
    void draw_eyes(const Picture& now, const interaction::InputState& input, FrameReport& report);
    PanelModel panel_model(PanelPlace place, const FrameReport& report) const;
    Choosing choosing(Waiting waiting) const;
    bool may_be_sliced(Waiting waiting) const;
    bool only_gets_finer(const Picture& now, Waiting waiting) const;
    void rest_in_slices(Picture& now, Waiting waiting, FrameReport& report);
    void draw_slices(const Picture& now, const Outputs::Overlay& overlay, FrameReport& report);
    void draw_pieces(Slices& slices);
    bool draw_slice(Slices& slices, const ScenePlace& place, std::span<const render::View> views,
                    std::size_t work, std::size_t& done);
    void measure_unseen(const Picture& now, const StopWatch& frame, const FrameReport& report);
    std::size_t draw_views(const ScenePlace& place, std::span<const render::View> views,
                           const Picture& picture, const ScenePart& slice = {});
    std::vector<interaction::DeviceKind> devices_at_hand() const;
    OperatorPanel::Model panel_models(const FrameReport& report) const;
    glm::ivec2 panel_places() const;
    bool on_desktop(const Audience& audience) const;
    Picture kept(const Picture& picture) const;
    /// Center of the data in the room while they are shown in parallel projection; else empty.
    std::optional<glm::dvec3> parallel_center() const;
    bool flat_panel() const; ///< the operator's panel is shown over the first window
    bool head_is_emulated() const;
    std::optional<interaction::Pose> panel_place() const;
    bool stands_beside(const interaction::Pose& head) const;
    void draw_panel_overlay(glm::ivec2 size, const FrameReport& report);

    Config config_;
    std::shared_ptr<const index::IndexFile> file_;
    std::shared_ptr<index::NewestIndex> newest_; ///< the same file, for the worker
    std::vector<double> times_;                  ///< of the known steps
    Outputs outputs_;
    ExplorerState state_;
    ExplorerState home_;
    interaction::Commands start_; ///< commands that lead back to home_
    std::vector<std::string> array_names_, color_names_;
    /// The surfaces at the first look at an array, for each array but the first.
    std::vector<std::vector<interaction::Isosurface>> first_surfaces_;
    /// How arrays that were shown before were left, by number.
    std::map<std::size_t, interaction::Commands> left_;
    std::optional<interaction::Commands> next_array_;
    interaction::Controls controls_;
    interaction::MotionGate gate_;
    interaction::Comfort comfort_;
    index::Extractor extractor_;
    Scene scene_;
    DetailChoice details_;
    std::vector<render::View> views_;     ///< of the last pictures in windows or a headset
    mutable PercentileRange percentiles_; ///< keeps what it has sorted
    std::optional<Picture> drawn_;        ///< last picture
    std::optional<Slices> slices_;        ///< the next one, if it is made in slices
    std::optional<Slices> unseen_;        ///< one that is made only to measure it
    Aids over_;                           ///< drawn over the last picture, if they are
    OperatorPanel panel_;
    PanelInRoom room_panel_;
    Picker picker_;
    History history_;
    const std::vector<interaction::ControlGroup> documentation_ =
        interaction::Controls::documentation();
    interaction::Commands panel_commands_;
    interaction::InputState input_; ///< of the last frame
    interaction::InputState latched_;
    std::string data_name_, recorded_on_;
    std::function<interaction::Seconds()> clock_;
    FrameLog log_;
    FrameQuality quality_;
    std::unique_ptr<FrameSharing> frames_ = std::make_unique<FramesAlone>();
    CaptureWait captures_;
    std::optional<interaction::Seconds> in_headset_; ///< when a headset last wanted a picture
    index::DetailQuery detail_;                      ///< of the sets that are asked for
    interaction::Seconds constant_since_{0};         ///< when the eyes last saw something change
    bool comes_in_slices_ = false;                   ///< the newest picture is drawn in slices only
    bool shows_slices_ = false;                      ///< slices that are whole may be shown
    bool slices_whole_ = false;                      ///< those of the last frame are, or are shown
    bool rests_ = false;                             ///< the set for pictures at rest may be drawn
    std::uint64_t cells_at_first_ = 0;               ///< of the first set for this picture at rest
    bool all_at_rest_ = false; ///< all cells are wanted for this picture at rest
    bool mesh_wanted_ = false; ///< by the last frame's choice of quality
    bool recording_ = false;
    MovieState movies_;
    std::string message_, standing_;
    index::ExtractionPtr refused_; ///< the newest set if it is not shown; else null
    std::size_t messages_ = 0;
};

} // namespace isochron::app
