// One session: the data, the worker, the eyes, and the story of one frame.
//
//     app::Session session(config, file, *context);
//     while (!session.should_close()) {
//         const auto input = emulation.poll(clock.now());
//         session.frame(input, session.commands_from(input), app::Waiting::never);
//     }
#pragma once

#include "app/cluster/shared_frames.h"
#include "app/config/config.h"
#include "app/frame/capture_wait.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "app/frame/frame_quality.h"
#include "app/frame/late_latch.h"
#include "app/output/displays.h"
#include "app/output/kept_pictures.h"
#include "app/output/picture_names.h"
#include "app/output/room_view.h"
#include "app/panel/operator_window.h"
#include "app/panel/panel_in_room.h"
#include "app/panel/panel_layer.h"
#include "app/scene/scene.h"
#include "app/session/background_work.h"
#include "app/session/picker.h"
#include "index/extraction/extractor.h"
#include "interaction/controls.h"
#include "stereo/headset_display.h"
#include "stereo/windows.h"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace isochron::app {

class Session {
  public:
    /// @param windows those of the configured installation, or a context for its only one that
    /// outlives the session; the one that draws is current on this thread
    /// @param extract replaces the extraction from `file`, for tests; empty: the extraction itself
    /// @param headset that is drawn for in place of the installation's windows, the first of which
    /// mirrors it; null: none
    Session(Config config, std::shared_ptr<const index::IndexFile> file, stereo::Windows windows,
            index::Extract extract = {}, std::unique_ptr<stereo::Headset> headset = nullptr);
    ~Session();

    /// Shares every frame from now on with other processes. @param frames outlives the session
    void join(SharedFrames& frames) { shared_ = &frames; }
    /// This process or another one has a window that the user wants to close.
    bool should_close() const;

    const ExplorerState& state() const { return state_; }
    void set_state(const ExplorerState& state) { state_ = state; }
    const ExplorerState& home() const { return home_; }

    /// What the devices lead to in this frame; advances the controls, changes nothing else.
    interaction::Commands commands_from(const interaction::InputState& input);

    /// The panel in the room, for those who emulate a wand.
    interaction::PanelSize room_panel_size() const { return room_panel_.size(); }

    /// What no device alone explains: what the user did to the operator's panel while the last
    /// frame was drawn, and what picking found among what was shown. Handed out once, before the
    /// next frame.
    interaction::Commands take_panel_commands();

    /// Passes window events to the panel. @return those that it has no use for
    std::vector<interaction::WindowEvent>
    panel_events(std::span<const interaction::WindowEvent> events);

    /// One frame, from commands to presented picture.
    /// @param latch tells where the heads are when the views are made; empty: as in `input`
    const FrameReport& frame(const interaction::InputState& input,
                             const interaction::Commands& commands, Waiting waiting,
                             const Latch& latch = {});
    /// The heads that the last frame's latch stated, for its recording; may hold none.
    const interaction::InputState& latched() const { return latched_; }
    /// Session time as it goes on, for the latency from input to picture. Without it a frame's
    /// input counts as polled when the frame begins.
    void set_clock(std::function<interaction::Seconds()> clock) { clock_ = std::move(clock); }

    /// Where screenshots go and what they are called: `<folder>/<stem>_0001.png`.
    void set_screenshots(const std::filesystem::path& folder) { screenshot_folder_ = folder; }
    /// The panel shows the last of these until there is a newer one.
    void show_messages(std::vector<std::string> messages);
    void set_recording(bool recording) { recording_ = recording; }

    /// Why the newest query could not be answered; empty when all is well.
    std::string failure() const;
    const stereo::Windows& windows() const { return windows_; }
    /// What a window of this process shows; `windows().number(i)` tells which it is.
    const stereo::Display& display(std::size_t window = 0) const { return displays_[window]; }
    std::size_t displays() const { return displays_.size(); }
    /// The room of an emulated installation; null where its windows are real.
    const RoomView* room() const { return room_ ? &*room_ : nullptr; }
    /// Whose events and frames the caller sees to; null where there is none.
    stereo::Headset* headset() const { return headset_.get(); }
    /// The pictures of the headset's eyes; null where there is none.
    const stereo::HeadsetDisplay* headset_display() const {
        return headset_display_ ? &*headset_display_ : nullptr;
    }
    const FrameLog& log() const { return log_; }

    /// The last frame's pictures, drawn once more to be kept.
    KeptPictures kept_pictures();
    /// Writes a picture under its name, in the background.
    void write_image(render::Image image, const std::filesystem::path& path);
    BackgroundWork& pictures() { return pictures_; }

  private:
    /// Everything that the eyes' pictures depend on.
    struct Picture {
        std::vector<stereo::Viewpoint> viewers;
        std::vector<stereo::HeadsetEye> eyes; ///< of a headset that wants a picture
        std::optional<interaction::Pose> wand;
        std::optional<ShownPanel> panel;
        interaction::Mark mark;
        Guides guides;
        render::Veil veil;
        interaction::Similarity room_from_physical;
        stereo::StereoMode stereo{};
        render::Footprint footprint{};
        index::ExtractionPtr cells;
        std::vector<interaction::Isosurface> isosurfaces;
        std::optional<ColorScale> scale;
        bool bounding_box = true;
        std::vector<glm::ivec2> windows;
        bool operator==(const Picture&) const = default;
    };

    interaction::ControlContext control_context() const;
    void request_cells(Waiting waiting);
    void take_newest_cells(Waiting waiting, FrameReport& report);
    std::optional<ColorScale> shown_scale() const;
    Picture picture(const interaction::InputState& input, const FrameReport& report) const;
    interaction::InputState seen(const interaction::InputState& input, const Latch& latch,
                                 FrameReport& report);
    void show_shared_cells();
    void learn_costs();
    void choose_quality(Picture& now, Waiting waiting, FrameReport& report);
    bool take_shared_choice(bool measure, FrameReport& report);
    void wait_for_others();
    bool has_no_answer() const;
    bool captures(const FrameReport& report);
    std::vector<glm::ivec2> window_sizes() const;
    void draw_eyes(const Picture& now, const interaction::InputState& input, FrameReport& report);
    stereo::StereoMode mode_in(const stereo::Window& window, const Picture& now) const;
    PanelModel panel_model(PanelPlace place, const FrameReport& report) const;
    void draw_headset(const Picture& now, bool redrawn, const stereo::Display::Overlay& overlay);
    void draw_for(std::span<const render::View> views, const Picture& now);
    void draw_panel_overlay(glm::ivec2 size, const FrameReport& report);
    render::Image headset_picture();
    void take_screenshots();

    Config config_;
    std::shared_ptr<const index::IndexFile> file_;
    stereo::Windows windows_;
    render::Gl gl_;
    ExplorerState state_;
    ExplorerState home_;
    interaction::Controls controls_;
    interaction::MotionGate gate_;
    interaction::Comfort comfort_;
    index::Extractor extractor_;
    Scene scene_;
    std::deque<stereo::Display> displays_; ///< by window
    std::optional<RoomView> room_;
    std::unique_ptr<stereo::Headset> headset_;
    std::optional<stereo::HeadsetDisplay> headset_display_;
    std::optional<Picture> drawn_; ///< what the eyes saw last
    PanelLayer panel_;
    PanelInRoom room_panel_;
    Picker picker_;
    std::optional<Console> console_;
    bool panel_drawn_ = false; ///< in this frame, over one buffer of its window
    const std::vector<std::string> stereo_modes_;
    const std::vector<std::string> documentation_ = interaction::Controls::documentation();
    interaction::Commands panel_commands_;
    interaction::InputState latched_;
    std::function<interaction::Seconds()> clock_;
    FrameLog log_;
    FrameQuality quality_;
    std::vector<DrawSample> samples_; ///< that the others have not been told of
    SharedFrames* shared_ = nullptr;  ///< null: one process alone
    BackgroundWork pictures_;
    std::filesystem::path screenshot_folder_;
    CaptureWait captures_;
    int screenshots_taken_ = 0;
    bool recording_ = false;
    std::string message_;
};

} // namespace isochron::app
