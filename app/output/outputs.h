// What pictures are shown in: windows, the emulated room around them, or a headset; they are drawn,
// presented and kept.
//
//     Outputs outputs(config, std::move(windows));
//     outputs.draw(audience, scene, panel);      // or draw_again, when only the panel has changed
//     outputs.draw_room(input, panel);
//     outputs.present();
//     outputs.take_screenshots(note);            // the same pictures, with more samples
#pragma once

#include "app/config/config.h"
#include "app/frame/background_work.h"
#include "app/frame/draw_cost.h"
#include "app/output/displays.h"
#include "app/output/kept_pictures.h"
#include "app/output/picture_note.h"
#include "app/output/room_view.h"
#include "render/gl/frames_in_flight.h"
#include "stereo/headset_display.h"
#include "stereo/windows.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// Who looks in one frame, how, and what of theirs stands in the room.
struct Audience {
    std::vector<stereo::ViewerPose> viewers; ///< by number
    std::vector<stereo::HeadsetEye> eyes;    ///< of a headset that wants a picture
    std::optional<interaction::Pose> wand;   ///< where it is shown
    std::optional<ShownPanel> panel;         ///< that stands in the room
    stereo::StereoMode stereo{};             ///< chosen live
    /// A wand's ray or what is under a cursor is shown, which pictures to keep leave out.
    bool aids = false;
    bool in_windows = true; ///< false: a headset shows them, and the first window mirrors it
    bool operator==(const Audience&) const = default;
};

/// Where the views lie that a scene is drawn for.
struct ScenePlace {
    const stereo::Window* window = nullptr; ///< of the installation; null: a headset
    std::size_t viewport = 0;               ///< of the window
    stereo::StereoMode mode{};              ///< of the window
    bool kept = false;                      ///< for a picture that is written
};

class Outputs {
  public:
    /// Draws the eyes of one viewport, or of a headset, into what is bound.
    using Scene = std::function<void(const ScenePlace&, std::span<const render::View>)>;
    using Overlay = stereo::Display::Overlay;

    /// @param config outlives the outputs
    /// @param windows those of the configured installation, or a context for its only one that
    /// outlives the outputs; the one that draws is current on this thread
    /// @param headset that is drawn for in place of the installation's windows, the first of which
    /// mirrors it; null: none
    /// @throws render::Error when this GL has fewer samples than configured, for displays or for
    /// pictures, or the headset cannot show from it
    Outputs(const Config& config, stereo::Windows windows,
            std::unique_ptr<stereo::Headset> headset = nullptr);
    ~Outputs();

    const render::Gl& gl() const { return gl_; }
    const stereo::Windows& windows() const { return windows_; }
    std::vector<glm::ivec2> window_sizes() const; ///< pixels, by window of this process
    /// Names of the modes that a key goes through.
    const std::vector<std::string>& stereo_modes() const { return stereo_modes_; }

    /// What a window of this process shows; `windows().number(i)` tells which it is. Beside a headset
    /// windows show it while the headset does not; there is none where it is the only display.
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
    /// Where a headset's eyes will be; empty where there is none, or when it wants no picture.
    std::vector<stereo::HeadsetEye> headset_eyes() const;
    /// False while a headset that is shown wants no picture.
    bool want(const Audience& audience) const {
        return !headset_ || !audience.eyes.empty() || shows_windows(audience);
    }
    /// Whether the windows show what somebody sees, and no headset's mirror.
    bool shows_windows(const Audience& audience) const {
        return !headset_ || (audience.in_windows && !displays_.empty());
    }
    bool shows_windows() const { return shows_windows(drawn_.audience); } ///< in the last frame

    /// The eye's ray under the cursor in a window as drawn last; nothing in a headset or an
    /// emulated room.
    /// @param viewers where they are now
    std::optional<interaction::Pose> ray_at(const interaction::MouseMoveEvent& cursor,
                                            std::span<const stereo::ViewerPose> viewers) const;

    /// Leaves the left of the first window to the panel that lies over it, where its screens take
    /// on the shape of what is left. @param pixels of each eye's part
    void leave_free(int pixels);
    /// Shows what is at the left of the first window's screens, in the same case.
    /// @param share of the width of each eye's part
    void show_aside(float share);

    /// Draws what each eye sees.
    /// @param scene the same until the next call, for pictures to keep
    /// @param overlay over one of them: the first window, or a headset's mirror; empty: none
    /// @return what one cell in every view comes to
    DrawLoad draw(const Audience& audience, Scene scene, const Overlay& overlay);
    /// Shows each eye what it saw last, with a new overlay.
    void draw_again(const Audience& audience, const Overlay& overlay);
    /// Then the emulated room with all of that, where there is one; there the overlay is over it.
    /// @param input holds the room's camera
    void draw_room(const interaction::InputState& input, const Overlay& overlay);
    void present();
    const Audience& audience() const { return drawn_.audience; } ///< of the last frame

    /// The last frame's pictures, drawn once more to be kept.
    KeptPictures kept_pictures();
    /// Where screenshots go. They are called `isochron_0001.png`, of several windows
    /// `isochron_0001_front.png`, and are counted on from those that are there now: all processes of
    /// a cluster must ask for the folder before the first screenshot.
    void set_screenshots(const std::filesystem::path& folder);
    /// Of the room, of the headset's mirror, or of every window of this process.
    /// @param frame what the last frame shows
    void take_screenshots(const PictureNote& frame);
    /// Writes a picture under its name, in the background. @param note goes into the file; empty: none
    void write_image(render::Image image, const std::filesystem::path& path,
                     const std::string& note = {});
    /// What a picture of a frame says of itself.
    PictureNote noted(PictureNote frame, const PicturePart& part) const;
    BackgroundWork& pictures() { return pictures_; } ///< that are written

  private:
    /// What the eyes saw last.
    struct Drawn {
        Audience audience;
        Scene scene;
    };

    stereo::StereoMode mode_in(const stereo::Window& window) const;
    bool adapts() const;
    Overlay overlay_of(std::size_t window, const Overlay& overlay) const;
    void draw_window(stereo::Display& display, const Scene& scene, const Overlay& overlay,
                     bool kept = false) const;
    void end_headset_frame(bool again);
    render::Image headset_picture();
    bool kept_differ() const; ///< from those that are shown

    const Config& config_;
    stereo::Windows windows_;
    render::Gl gl_;
    render::FramesInFlight in_flight_;
    std::deque<stereo::Display> displays_; ///< by window
    std::optional<RoomView> room_;
    std::unique_ptr<stereo::Headset> headset_;
    std::optional<stereo::HeadsetDisplay> headset_display_;
    const std::vector<std::string> stereo_modes_;
    Drawn drawn_;
    BackgroundWork pictures_;
    std::filesystem::path screenshot_folder_;
    int screenshots_taken_ = 0;
};

} // namespace isochron::app
