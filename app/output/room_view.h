// The picture of an emulated installation: the room from outside, with the pictures on its walls.
#pragma once

#include "app/output/room_camera.h"
#include "app/scene/shown_panel.h"
#include "interaction/input/tracked_input.h"
#include "render/passes/line_pass.h"
#include "render/passes/picture_pass.h"
#include "render/passes/solid_pass.h"
#include "stereo/display.h"

#include <deque>
#include <optional>
#include <span>

namespace isochron::app {

/// Name of the device whose pose is the camera's, so that a recording holds it.
inline constexpr const char* kRoomCamera = "camera";

class RoomView {
  public:
    /// @param gl, window (which draws), installation outlive the view
    RoomView(const render::Gl& gl, stereo::GlContext& window,
             const stereo::Installation& installation);

    /// The mode in which walls are drawn: as one picture, the left eye's or the only one.
    static stereo::StereoMode shown(stereo::StereoMode mode);

    /// Sets the panel that stands in the room; empty: none.
    void set_panel(const std::optional<ShownPanel>& panel) { panel_ = panel; }

    /// Keeps the edges of the window free for the panel over it.
    void leave_free(const stereo::Margins& margins) { display_.leave_free(margins); }

    /// Draws the room around the displays: walls with the picture of one eye, opaque from the front
    /// and like glass from behind; lines from each viewer to the corners of their screens; heads,
    /// wand and floor. Then the overlay.
    /// @param input holds the camera's pose; without it the camera is at its start
    void draw(const std::deque<stereo::Display>& displays,
              std::span<const stereo::ViewerPose> viewers,
              const std::optional<interaction::Pose>& wand, const interaction::InputState& input,
              const stereo::Display::Overlay& overlay);
    void present() { display_.present(); }
    render::Image read() const { return display_.read_window(); }
    glm::ivec2 size() const { return display_.size(); } ///< size of the last picture, pixels
    /// Draws the last picture once more, without the overlay.
    /// @param displays with the same contents as then
    render::Image picture(const std::deque<stereo::Display>& displays, int samples);

  private:
    /// A screen in the room, in this frame.
    struct Wall {
        std::array<glm::vec3, 4> corners;
        GLuint picture;
        std::size_t viewer;
    };
    static std::vector<Wall> walls_of(const std::deque<stereo::Display>& displays,
                                      std::span<const stereo::ViewerPose> viewers);
    void draw_room(const render::View& view, std::span<const Wall> walls,
                   std::span<const stereo::ViewerPose> viewers,
                   const std::optional<interaction::Pose>& wand);
    void draw_walls(const render::View& view, std::span<const Wall> walls, bool from_front) const;

    /// The last picture, apart from the displays.
    struct Drawn {
        interaction::Pose camera;
        std::vector<stereo::ViewerPose> viewers;
        std::optional<interaction::Pose> wand;
    };
    void draw_into(stereo::Display& display, const std::deque<stereo::Display>& displays,
                   const stereo::Display::Overlay& overlay);

    const render::Gl& gl_;
    stereo::GlContext& window_;
    const interaction::Pose start_; ///< pose of the camera at the start
    Drawn drawn_;
    stereo::Display display_;
    render::LinePass lines_;
    render::PicturePass pictures_;
    render::SolidPass solids_;
    render::PanelPass panels_;
    std::optional<ShownPanel> panel_;
    std::vector<render::Line> floor_;
};

} // namespace isochron::app
