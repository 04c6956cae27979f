// Lines and labels of the test pattern.
#include "app/scene/test_pattern.h"

#include "app/scene/font.h"
#include "app/scene/guides.h"
#include "app/scene/legend.h"
#include "app/scene/ticks.h"
#include "stereo/screen.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

using render::Line;
using stereo::Eye;

constexpr glm::vec4 kWhite(1.0f), kGrid(0.35f, 0.41f, 0.48f, 0.8f),
    kFrame(0.55f, 0.80f, 1.0f, 1.0f), kText(0.78f, 0.84f, 0.92f, 1.0f),
    kCross(1.0f, 0.80f, 0.10f, 1.0f);
constexpr float kLetterHeight = 0.26f; ///< share of the wall's height
constexpr float kCrossArm = 0.06f;     ///< share of the wall's height
constexpr float kAxis = 0.1f;          ///< [m]
constexpr float kBehind = 0.002f;      ///< [m] distance of the grid behind the letters
constexpr int kMostGridLines = 9;      ///< between two edges
/// Place of the axes of the wall's own viewer, in the head's frame [m]: visible, but below the line
/// of sight.
constexpr glm::vec3 kAhead(-0.25f, -0.22f, -0.8f);

glm::vec3 on_wall(const PatternWall& wall, glm::vec2 place) {
    return wall.corners[0] + place.x * (wall.corners[3] - wall.corners[0]) +
           place.y * (wall.corners[1] - wall.corners[0]);
}

/// Width and height [m].
glm::vec2 size_of(const PatternWall& wall) {
    return {glm::distance(wall.corners[0], wall.corners[3]),
            glm::distance(wall.corners[0], wall.corners[1])};
}

glm::vec3 normal_of(const PatternWall& wall) {
    return glm::normalize(
        glm::cross(wall.corners[3] - wall.corners[0], wall.corners[1] - wall.corners[0]));
}

/// The largest 1, 2 or 5 times a power of ten that is at most `length`.
float nice_below(float length) {
    const float power = std::pow(10.0f, std::floor(std::log10(length)));
    for (const float factor : {5.0f, 2.0f})
        if (factor * power <= length)
            return factor * power;
    return power;
}

float grid_spacing(const PatternWall& wall) {
    const glm::vec2 size = size_of(wall);
    return static_cast<float>(nice_ticks(0.0, std::min(size.x, size.y), kMostGridLines).step);
}

void add_grid(const PatternWall& wall, std::vector<Line>& lines) {
    const glm::vec2 size = size_of(wall);
    const float spacing = grid_spacing(wall);
    const glm::vec3 behind = kBehind * normal_of(wall);
    for (int axis = 0; axis < 2; ++axis) {
        const int count = static_cast<int>(0.5f * size[axis] / spacing);
        for (int i = -count; i <= count; ++i) {
            glm::vec2 from(0.0f), to(1.0f);
            from[axis] = to[axis] = 0.5f + static_cast<float>(i) * spacing / size[axis];
            lines.push_back({on_wall(wall, from) - behind, on_wall(wall, to) - behind, kGrid});
        }
    }
}

/// The strokes of a letter of height 1, as lines of points from its lower left.
std::vector<std::vector<glm::vec2>> strokes_of(Eye eye) {
    switch (eye) {
    case Eye::left: return {{{0.0f, 1.0f}, {0.0f, 0.0f}, {0.6f, 0.0f}}};
    case Eye::right:
        return {{{0.0f, 0.0f}, {0.0f, 1.0f}, {0.6f, 1.0f}, {0.6f, 0.48f}, {0.0f, 0.48f}},
                {{0.27f, 0.49f}, {0.58f, -0.04f}}};
    case Eye::center: break;
    }
    return {{{0.6f, 1.0f}, {0.0f, 1.0f}, {0.0f, 0.0f}, {0.6f, 0.0f}}};
}

/// @param half half of a stroke's width, in heights of the letter; strokes extend by it at corners
void add_letter(const PatternWall& wall, Eye eye, float half, std::vector<Line>& lines) {
    const glm::vec2 size = size_of(wall);
    const glm::vec2 unit = kLetterHeight * glm::vec2(size.y / size.x, 1.0f); // round on the wall
    const auto at = [&](glm::vec2 place) {
        return on_wall(wall, letter_place(eye) + (place - glm::vec2(0.3f, 0.5f)) * unit);
    };
    for (const auto& stroke : strokes_of(eye))
        for (std::size_t i = 1; i < stroke.size(); ++i) {
            const glm::vec2 along = stroke[i] - stroke[i - 1];
            const bool upright = along.x == 0.0f || along.y == 0.0f; // others have no corner
            const glm::vec2 beyond = upright ? half * glm::normalize(along) : glm::vec2(0.0f);
            lines.push_back({at(stroke[i - 1] - beyond), at(stroke[i] + beyond), kWhite});
        }
}

std::array<Line, 3> cross_lines(const PatternWall& wall) {
    const glm::vec3 at = cross_of(wall);
    const float arm = kCrossArm * size_of(wall).y;
    const glm::vec3 up = arm * glm::normalize(wall.corners[1] - wall.corners[0]);
    const glm::vec3 right = arm * glm::normalize(wall.corners[3] - wall.corners[0]);
    const glm::vec3 out = arm * normal_of(wall);
    return {{{at - right, at + right, kCross}, {at - up, at + up, kCross}, {at - out, at, kCross}}};
}

std::vector<render::Label> wall_labels(const PatternWall& wall, Eye eye, glm::ivec2 pixels) {
    const glm::vec2 size = size_of(wall);
    const glm::vec2 under(letter_place(eye).x, letter_place(eye).y - 0.7f * kLetterHeight);
    const float apart = 1e3f * disparity_on(wall, cross_of(wall));
    return {
        {.text = wall.name, .at = on_wall(wall, {0.5f, 0.92f}), .color = kWhite},
        {.text = fmt::format("{:.2f} x {:.2f} m, {} x {} pixels, grid {:g} m", size.x, size.y,
                             pixels.x, pixels.y, grid_spacing(wall)),
         .at = on_wall(wall, {0.5f, 0.86f}),
         .color = kText},
        {.text = fmt::format("{} eye", name_of(eye)), .at = on_wall(wall, under), .color = kText},
        {.text =
             fmt::format("{:g} m before the wall, {:.0f} mm apart on it", wall.cross_depth, apart),
         .at = on_wall(wall, {0.5f, 0.3f}), // readable without glasses, too

         .color = kCross}};
}

/// Adds the axes of every device with a pose, and the device's name.
void add_axes(const PatternWall& wall, const interaction::InputState& input,
              std::vector<Line>& lines, std::vector<render::Label>& labels) {
    constexpr std::array<glm::vec4, 3> kColors{
        {{0.95f, 0.30f, 0.28f, 1}, {0.35f, 0.85f, 0.35f, 1}, {0.35f, 0.55f, 1.0f, 1}}};
    for (const interaction::DeviceState& device : input.devices) {
        if (!device.pose)
            continue;
        const bool own = device.name == wall.head_device;
        interaction::Pose pose = *device.pose;
        if (own)
            pose.position += pose.orientation * kAhead;
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 along(0.0f);
            along[axis] = kAxis;
            const glm::vec3 tip = pose.position + pose.orientation * along;
            lines.push_back({pose.position, tip, kColors[axis]});
            labels.push_back({.text = std::string(1, "xyz"[axis]),
                              .at = tip + 0.12f * (tip - pose.position),
                              .color = kColors[axis]});
        }
        std::string name = device.name;
        if (own)
            name += fmt::format(" (shown {:g} m ahead)", -kAhead.z);
        if (device.tracking() != interaction::Tracking::tracked)
            name += fmt::format(", {}", name_of(device.tracking()));
        labels.push_back({.text = name,
                          .at = pose.position,
                          .anchor = {0.0f, 1.0f},
                          .offset = {0.3f, -0.3f},
                          .color = kText});
    }
}

} // namespace

PatternWall pattern_wall(const stereo::Window& window, std::size_t viewport,
                         const stereo::Viewer& viewer, const interaction::Pose& head,
                         const stereo::Eyes& eyes, glm::ivec2 pixels) {
    const stereo::Viewport& shown = window.viewports[viewport];
    std::string name = window.name;
    if (!shown.name.empty())
        name += " / " + shown.name;
    else if (window.viewports.size() > 1)
        name += fmt::format(" / {}", viewport + 1);
    // Uses the viewer's configured position, so that the cross does not move with the head.
    const float distance = distance_to(shown.screen, {viewer.position, {1, 0, 0, 0}});
    constexpr float kNearest = 0.1f; // meters
    return {.name = name,
            .corners = corners_in_room(shown.screen, head, pixels),
            .head_device = viewer.head,
            .head = head,
            .eyes = eyes,
            .cross_depth = nice_below(0.5f * std::max(distance, kNearest))};
}

glm::vec3 cross_of(const PatternWall& wall) {
    return on_wall(wall, glm::vec2(0.5f)) + wall.cross_depth * normal_of(wall);
}

float disparity_on(const PatternWall& wall, const glm::vec3& point) {
    const glm::vec3 normal = normal_of(wall);
    const auto image = [&](Eye eye) {
        const glm::vec3 from = stereo::eye_position(wall.head, eye, wall.eyes);
        const float far = glm::dot(from - wall.corners[0], normal);
        const float near = glm::dot(point - wall.corners[0], normal);
        return from + far / (far - near) * (point - from);
    };
    const glm::vec3 right = glm::normalize(wall.corners[3] - wall.corners[0]);
    const glm::vec3 between = image(Eye::left) - image(Eye::right);
    return std::copysign(glm::length(between), glm::dot(between, right));
}

glm::vec2 letter_place(Eye eye) {
    return {eye == Eye::left ? 0.25f : eye == Eye::right ? 0.75f : 0.5f, 0.6f};
}

TestPattern::TestPattern(const render::Gl& gl) : lines_(gl), text_(gl, room_font) {}

void TestPattern::draw(std::span<const render::View> views, std::span<const Eye> eyes,
                       const PatternWall& wall, const interaction::InputState& input) {
    constexpr float kStroke = 0.16f; // share of a letter's height
    std::vector<Line> thin = lines_of(Guides{.floor = true, .target = {}}), frame, axes;
    add_grid(wall, thin);
    for (std::size_t i = 0; i < 4; ++i)
        frame.push_back({wall.corners[i], wall.corners[(i + 1) % 4], kFrame});
    std::vector<render::Label> names;
    add_axes(wall, input, axes, names);
    const std::array<Line, 3> cross = cross_lines(wall);
    const glm::mat4 room(1.0f);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const render::View& view = views[i];
        const float text = text_height(view.size);
        std::vector<Line> letter;
        add_letter(wall, eyes[i], 0.5f * kStroke, letter);
        lines_.draw(view, room, thin);
        lines_.draw(view, room, frame, 0.5f * text); // only one half of it is visible
        lines_.draw(view, room, axes, 0.25f * text);
        lines_.draw(view, room, cross, 0.25f * text);
        lines_.draw(view, room, letter, kStroke * kLetterHeight * static_cast<float>(view.size.y));
        std::vector<render::ScreenQuad> quads;
        const auto labels = wall_labels(wall, eyes[i], view.size);
        text_.set(labels.front(), 2.0f * text, quads);
        for (const render::Label& label : std::span(labels).subspan(1))
            text_.set(label, text, quads);
        for (const render::Label& label : names)
            text_.set(label, text, quads);
        text_.draw(view, room, quads);
    }
}

} // namespace isochron::app
