// Draws an emulated room from outside.
#include "app/output/room_view.h"

#include "app/output/room_models.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::app {
namespace {

constexpr float kNear = 0.05f, kFar = 200.0f; ///< [m]
constexpr float kGlass = 0.3f;                ///< opacity of a wall that is seen from behind
constexpr float kBeforeWall = 1e-2f;          ///< share of the distance to the eye
constexpr float kFloorMargin = 0.5f;          ///< [m] that the floor reaches beyond the walls
constexpr float kWandRay = 1.2f;              ///< [m]
constexpr glm::vec3 kBackground(0.13f, 0.14f, 0.16f);
constexpr glm::vec4 kFrame(0.85f, 0.87f, 0.90f, 0.9f), kRay(1.0f, 0.77f, 0.36f, 0.9f);

/// Colors of the viewers and of the lines to their screens; the fifth viewer has the first color.
constexpr std::array<glm::vec3, 4> kViewers{
    {{0.93f, 0.76f, 0.62f}, {0.55f, 0.77f, 0.95f}, {0.65f, 0.90f, 0.62f}, {0.92f, 0.62f, 0.85f}}};

glm::vec3 color_of(std::size_t viewer) {
    return kViewers[viewer % kViewers.size()];
}

constexpr stereo::DisplayOptions kOptions{
    .near_plane = kNear, .far_plane = kFar, .background = kBackground};

/// A window with one screen that moves with the camera and adapts to the window's shape.
stereo::Window room_window() {
    const float half = std::tan(kRoomView / 2);
    stereo::Window window;
    window.name = "room";
    stereo::Screen& screen = window.viewports.front().screen;
    screen = {{-half, -half, -1.0f}, {-half, half, -1.0f}, {half, half, -1.0f}};
    screen.carried_by_head = screen.fit_aspect = true;
    return window;
}

std::vector<render::Line> floor_of(const stereo::Installation& installation) {
    glm::vec2 low(-1.0f), high(1.0f);
    for (const stereo::Window& window : installation.windows)
        for (const stereo::Viewport& viewport : window.viewports) {
            const interaction::Pose head{installation.viewers[viewport.viewer].position,
                                         {1, 0, 0, 0}};
            for (const glm::vec3& c : corners_in_room(viewport.screen, head, window.size)) {
                low = glm::min(low, glm::vec2(c.x, c.z));
                high = glm::max(high, glm::vec2(c.x, c.z));
            }
        }
    return floor_grid(low - kFloorMargin, high + kFloorMargin);
}

glm::vec3 middle(const std::array<glm::vec3, 4>& corners) {
    return 0.5f * (corners[0] + corners[2]);
}

bool seen_from_front(const std::array<glm::vec3, 4>& corners, glm::vec3 eye) {
    const glm::vec3 normal = glm::cross(corners[3] - corners[0], corners[1] - corners[0]);
    return glm::dot(eye - corners[0], normal) > 0.0f;
}

} // namespace

RoomView::RoomView(const render::Gl& gl, stereo::GlContext& window,
                   const stereo::Installation& installation)
    : gl_(gl), window_(window), start_(RoomCamera(installation).pose()),
      display_(gl, window, room_window(), kOptions), lines_(gl), pictures_(gl), solids_(gl),
      panels_(gl), floor_(floor_of(installation)) {}

stereo::StereoMode RoomView::shown(stereo::StereoMode mode) {
    return stereo::eyes_of(mode).size() == 1 ? mode : stereo::StereoMode::left;
}

void RoomView::draw(const std::deque<stereo::Display>& displays,
                    std::span<const stereo::ViewerPose> viewers,
                    const std::optional<interaction::Pose>& wand,
                    const interaction::InputState& input, const stereo::Display::Overlay& overlay) {
    const interaction::DeviceState* camera = input.find(kRoomCamera);
    drawn_ = {
        camera && camera->pose ? *camera->pose : start_, {viewers.begin(), viewers.end()}, wand};
    draw_into(display_, displays, overlay);
}

render::Image RoomView::picture(const std::deque<stereo::Display>& displays, int samples) {
    stereo::DisplayOptions options = kOptions;
    options.samples = samples;
    stereo::Display display(gl_, window_, room_window(), options);
    draw_into(display, displays, {});
    return display.read_window();
}

void RoomView::draw_into(stereo::Display& display, const std::deque<stereo::Display>& displays,
                         const stereo::Display::Overlay& overlay) {
    const std::vector<Wall> walls = walls_of(displays, drawn_.viewers);
    display.draw(
        drawn_.camera, 0.0f, stereo::StereoMode::mono,
        [&](std::span<const render::View> views) {
            draw_room(views.front(), walls, drawn_.viewers, drawn_.wand);
        },
        overlay);
}

std::vector<RoomView::Wall> RoomView::walls_of(const std::deque<stereo::Display>& displays,
                                               std::span<const stereo::ViewerPose> viewers) {
    std::vector<Wall> walls;
    for (const stereo::Display& display : displays)
        for (std::size_t i = 0; i < display.window().viewports.size(); ++i) {
            const stereo::Viewport& viewport = display.window().viewports[i];
            // A mode from `shown` has one eye, which has the whole picture.
            const stereo::EyePicture picture =
                display.eye_picture(stereo::eyes_of(display.mode()).front(), i);
            walls.push_back(
                {corners_in_room(viewport.screen, viewers[viewport.viewer].head, picture.size),
                 picture.target->color_texture(), viewport.viewer});
        }
    return walls;
}

void RoomView::draw_walls(const render::View& view, std::span<const Wall> walls,
                          bool from_front) const {
    const glm::vec3 eye = view.eye_in_room();
    std::vector<Wall> drawn;
    for (const Wall& wall : walls)
        if (seen_from_front(wall.corners, eye) == from_front)
            drawn.push_back(wall);
    // Walls like glass blend from back to front.
    std::ranges::sort(drawn, std::greater(),
                      [&](const Wall& wall) { return glm::distance(eye, middle(wall.corners)); });
    for (const Wall& wall : drawn)
        pictures_.draw(view, wall.corners, wall.picture, from_front ? 1.0f : kGlass);
}

void RoomView::draw_room(const render::View& view, std::span<const Wall> walls,
                         std::span<const stereo::ViewerPose> viewers,
                         const std::optional<interaction::Pose>& wand) {
    draw_walls(view, walls, true);
    for (std::size_t i = 0; i < viewers.size(); ++i)
        solids_.draw(view, room_from(viewers[i].head), head_model(color_of(i)));
    std::vector<render::Line> lines = floor_;
    const glm::vec3 eye = view.eye_in_room();
    for (const Wall& wall : walls)
        for (std::size_t i = 0; i < 4; ++i) {
            // Move the frame towards the eye, so that the wall does not cover it.
            const auto before = [&](const glm::vec3& corner) {
                return glm::mix(corner, eye, kBeforeWall);
            };
            lines.push_back({before(wall.corners[i]), before(wall.corners[(i + 1) % 4]), kFrame});
            lines.push_back({viewers[wall.viewer].head.position, wall.corners[i],
                             glm::vec4(color_of(wall.viewer), 0.35f)});
        }
    if (wand) {
        solids_.draw(view, room_from(*wand), wand_model());
        const glm::vec3 ahead =
            wand->orientation * glm::vec3(0, 0, -(panel_ && panel_->ray ? *panel_->ray : kWandRay));
        lines.push_back({wand->position, wand->position + ahead, kRay});
    }
    lines_.draw(view, glm::mat4(1.0f), lines);
    if (panel_)
        panels_.draw(view, panel_->quad);
    draw_walls(view, walls, false);
}

} // namespace isochron::app
