// Draws, presents and keeps pictures in windows, in the emulated room around them, or in a headset.
//
//     Outputs outputs(config, std::move(windows));
//     outputs.draw(audience, scene, panel);      // or draw_again, when only the panel has changed
//     outputs.draw_room(input, panel);
//     outputs.present();
//     outputs.take_screenshots(note);            // the same pictures, with more samples
#pragma once

#include "app/config/config.h"
#include "app/frame/background_work.h"
#include "app/output/displays.h"
#include "app/output/kept_pictures.h"
#include "app/output/picture_note.h"
#include "app/output/room_view.h"
#include "app/quality/draw_cost.h"
#include "app/scene/audience.h"
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

/// Which window and viewport a scene is drawn for.
struct ScenePlace {
    const stereo::Window* window = nullptr; ///< window of the installation; null: a headset
    std::size_t viewport = 0;               ///< number of the window's viewport
    stereo::StereoMode mode{};              ///< mode of the window
    bool kept = false;                      ///< for a picture to keep
};

class Outputs {
  public:
    /// Draws the eyes of one viewport, or of a headset, into the bound framebuffer.
    using Scene = std::function<void(const ScenePlace&, std::span<const render::View>)>;
    using Overlay = stereo::Display::Overlay;

    /// @param config outlives the outputs
    /// @param windows of the configured installation, or a context for its only window that
    /// outlives the outputs; the drawing context is current on this thread
    /// @param headset to draw for instead of the installation's windows; the first window mirrors
    /// it; null: none
    /// @throws render::Error when this GL has fewer samples than configured for displays or for
    /// pictures, or the headset cannot use it
    Outputs(const Config& config, stereo::Windows windows,
            std::unique_ptr<stereo::Headset> headset = nullptr);
    ~Outputs();

    const render::Gl& gl() const { return gl_; }
    const stereo::Windows& windows() const { return windows_; }
    std::vector<glm::ivec2> window_sizes() const; ///< pixels, by window of this process
    /// Names of the stereo modes that a key switches through.
    const std::vector<std::string>& stereo_modes() const { return stereo_modes_; }

    /// The display of a window of this process; `windows().number(i)` is its number in the
    /// installation. Beside a headset, windows show it only while the headset shows nothing. There
    /// is none if the headset is the only display.
    const stereo::Display& display(std::size_t window = 0) const { return displays_[window]; }
    std::size_t displays() const { return displays_.size(); }
    /// The room of an emulated installation; null if its windows are real.
    const RoomView* room() const { return room_ ? &*room_ : nullptr; }
    /// The headset, whose events and frames the caller handles; null: none.
    stereo::Headset* headset() const { return headset_.get(); }
    /// The pictures of the headset's eyes; null: no headset.
    const stereo::HeadsetDisplay* headset_display() const {
        return headset_display_ ? &*headset_display_ : nullptr;
    }
    /// Where the headset's eyes will be; empty without a headset, or if it wants no picture.
    std::vector<stereo::HeadsetEye> headset_eyes() const;
    /// Whether anything has to be drawn: false if only a headset is shown, and it wants no picture.
    bool want(const Audience& audience) const {
        return !headset_ || !audience.eyes.empty() || shows_windows(audience);
    }
    /// Whether the windows show their own views, rather than a headset's mirror.
    bool shows_windows(const Audience& audience) const {
        return !headset_ || (audience.in_windows && !displays_.empty());
    }
    /// Viewports that show a picture: those of the windows, and of a headset.
    std::size_t viewports(const Audience& audience) const;
    bool shows_windows() const { return shows_windows(drawn_.audience); } ///< in the last frame

    /// The ray from the eye through the cursor, in a window as it was drawn last; empty in a
    /// headset or an emulated room.
    /// @param viewers where the viewers are now
    std::optional<interaction::Pose> ray_at(const interaction::MouseMoveEvent& cursor,
                                            std::span<const stereo::ViewerPose> viewers) const;

    /// Keeps the edges of the window under the panel free for it: of an emulated room's, or of the
    /// first if all of its screens adapt to the shape of the rest. @param margins in each eye's part
    void leave_free(const stereo::Margins& margins);
    /// Widens the views of the first window to the left, for a panel there, where all of its
    /// screens adapt to the shape of the rest.
    /// @param share of each eye's width that shows what lies to the left of the screen
    void show_aside(float share);

    /// Draws each eye's picture.
    /// @param scene draws the same until the next call: pictures to keep call it again
    /// @param overlay drawn over the first window, or over a headset's mirror; empty: none
    /// @return load of one cell in every view: the number of views, and their pixels
    /// @throws render::OutOfMemory when the GL had no memory for something that was drawn
    DrawLoad draw(const Audience& audience, Scene scene, const Overlay& overlay);
    /// Where the next part of a picture belongs: to the windows that show their own views, then
    /// to the headset.
    struct PartPlace {
        std::size_t window = 0, viewport = 0; ///< the number of windows: the headset
        bool begins = true;                   ///< nothing has been drawn for this viewport
    };
    /// Draws a part of what a viewport still lacks. @return whether it is complete now
    using PartScene = std::function<bool(const ScenePlace&, std::span<const render::View>)>;
    /// Draws the next part of a new picture, while the old one stays on show, for windows as large as
    /// in the last frame.
    /// @param audience the same for all parts; it wants a picture
    /// @param place where this part belongs; becomes the place of the next one
    /// @return whether the pictures of all windows, or of the headset, are complete
    /// @throws render::OutOfMemory as `draw`
    bool draw_part(const Audience& audience, PartPlace& place, const PartScene& scene);
    /// Shows the picture that was drawn in parts.
    void show_parts(const Overlay& overlay);
    /// Pictures in the mean that a settled window shows, where nobody has chosen the number of samples;
    /// else 1: it shows one picture.
    int passes() const { return passes_; }
    /// As `stereo::Display` has them, for all windows.
    void begin_mean();
    void end_mean();
    /// Uses once all that a mean needs, where settled windows show one.
    void prepare_mean();
    int in_mean() const { return displays_.empty() ? 0 : displays_.front().in_mean(); }
    void add_to_mean();
    void complete_mean();
    /// Whether the windows hold what they showed last, with the overlay. Pictures to keep have none.
    bool can_stay() const { return !headset_ && !room_ && !lacks_overlay_; }
    /// Keeps the windows as they are, instead of the other calls, where `can_stay` and nothing has
    /// changed. The frame need not be presented.
    void stay(const Audience& audience) { drawn_.audience = audience; }
    /// Keeps each eye's last picture, and draws a new overlay.
    void draw_again(const Audience& audience, const Overlay& overlay);
    /// Draws the emulated room around these pictures, if there is one, and the overlay over it.
    /// @param input holds the pose of the room's camera
    void draw_room(const interaction::InputState& input, const Overlay& overlay);
    void present();
    const Audience& audience() const { return drawn_.audience; } ///< who saw the last frame

    /// The last frame's pictures, drawn once more to be kept.
    /// @param frame says which parts the pictures have
    KeptPictures kept_pictures(const PictureNote& frame = {});
    /// Where screenshots go. They are called `isochron_0001.png`, or with several windows
    /// `isochron_0001_front.png`. Their numbers follow the highest number that is in the folder
    /// now: all processes of a cluster must ask for the folder before the first screenshot.
    void set_screenshots(const std::filesystem::path& folder);
    /// Writes a picture of the room, of the headset's mirror, or of every window of this process.
    /// @param frame note about the last frame; each picture's own note is made from it
    void take_screenshots(const PictureNote& frame);
    /// Gets what a file name adds for a picture, and the picture's own note.
    using TakeNotedPicture = std::function<void(const std::string& suffix, render::Image image,
                                                const std::string& note)>;
    /// Draws these pictures. @param frame as of `take_screenshots`
    void each_picture(const PictureNote& frame, const TakeNotedPicture& take);
    /// A picture that was read, as it is written. @param frame as of `take_screenshots`
    render::Image finished(render::Image image, const PictureNote& frame) const;
    /// Writes a picture in the background. @param note stored in the file; empty: none
    void write_image(render::Image image, const std::filesystem::path& path,
                     const std::string& note = {});
    /// The note of one picture of a frame: `frame` with the part and how it is drawn.
    PictureNote noted(PictureNote frame, const PicturePart& part) const;
    BackgroundWork& pictures() { return pictures_; } ///< writes pictures

  private:
    /// The last frame.
    struct Drawn {
        Audience audience;
        Scene scene;
    };

    stereo::StereoMode mode_in(const stereo::Window& window) const;
    bool adapts() const;
    Overlay overlay_of(std::size_t window, const Overlay& overlay) const;
    void draw_window(stereo::Display& display, const Scene& scene, const Overlay& overlay,
                     bool kept = false) const;
    bool draw_part_at(const Audience& audience, PartPlace& place, const PartScene& scene);
    void end_headset_frame(bool again);
    render::Image headset_picture(const PictureNote& frame);
    std::optional<glm::ivec2> asked_size(const PictureNote& frame) const;

    bool have_opacity(const PictureNote& frame) const;
    /// Whether the windows show the mean of all samples.
    bool is_settled() const { return passes_ > 1 && in_mean() == passes_; }
    stereo::DisplayOptions kept_options(glm::ivec2 size, const PictureNote& frame) const;

    const Config& config_;
    stereo::Windows windows_;
    render::Gl gl_;
    const int passes_;
    render::FramesInFlight in_flight_;
    std::deque<stereo::Display> displays_; ///< by window
    std::optional<RoomView> room_;
    std::unique_ptr<stereo::Headset> headset_;
    std::optional<stereo::HeadsetDisplay> headset_display_;
    const std::vector<std::string> stereo_modes_;
    Drawn drawn_;
    BackgroundWork pictures_;
    bool lacks_overlay_ = false; ///< pictures to keep were made of what the windows show
    std::filesystem::path screenshot_folder_;
    int screenshots_taken_ = 0;
};

} // namespace isochron::app
