// Draws the figure of an installation.
#include "app/output/room_plan.h"

#include "app/config/check/checked_room.h"
#include "app/config/check_config.h"
#include "app/output/plan_canvas.h"
#include "app/safe_text.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace isochron::app {
namespace {

constexpr glm::ivec2 kFigure(1800, 1300); // pixels
constexpr float kText = 19, kSmall = 16;  // pixels, of a line
constexpr glm::vec3 kSheet(1.0f), kLitSide(0.30f, 0.55f, 0.95f);
constexpr glm::vec4 kInk(0.13f, 0.15f, 0.18f, 1), kPale(0.45f, 0.48f, 0.52f, 1),
    kGridLine(0.88f, 0.89f, 0.91f, 1), kSound(0.13f, 0.30f, 0.58f, 1),
    kAmber(0.80f, 0.47f, 0.0f, 1), kRed(0.82f, 0.07f, 0.10f, 1), kData(0.05f, 0.50f, 0.25f, 1),
    kLeftEye(0.85f, 0.10f, 0.15f, 1), kRightEye(0.0f, 0.55f, 0.75f, 1);
constexpr std::array kAxisColors{kRed, glm::vec4(0.10f, 0.60f, 0.15f, 1),
                                 glm::vec4(0.15f, 0.25f, 0.90f, 1)};

/// A screen in the room, while its viewer stands where the configuration has them.
struct DrawnWall {
    std::array<glm::vec3, 4> corners; ///< lower left, upper left, upper right, lower right
    glm::vec3 normal;
    bool carried;
    glm::vec4 color;
    std::string name, more;
    glm::vec3 middle() const { return 0.5f * (corners[0] + corners[2]); }
};

interaction::Pose head_of(const stereo::Viewer& viewer) {
    return {viewer.position, {1, 0, 0, 0}};
}

glm::vec4 color_of(const PlacedViewport& place, const std::vector<ConfigProblem>& problems) {
    glm::vec4 color = kSound;
    for (const ConfigProblem& problem : problems)
        if (problem.line > 0 &&
            (problem.line == place.line || problem.line == place.window.line.number) &&
            color != kRed)
            color = problem.wrong ? kRed : kAmber;
    return color;
}

std::vector<DrawnWall> drawn_walls(const CheckedRoom& room,
                                   const std::vector<ConfigProblem>& problems) {
    std::vector<DrawnWall> walls;
    for (const PlacedViewport& place : room.viewports()) {
        const stereo::Screen& screen = place.viewport.screen;
        const interaction::Pose head = head_of(room.viewer_of(place));
        DrawnWall wall{.corners = corners_in_room(screen, head, glm::ivec2(pixels_of(place))),
                       .normal = {},
                       .carried = screen.carried_by_head,
                       .color = color_of(place, problems),
                       .name =
                           place.viewport.name.empty() ? place.window.name : place.viewport.name,
                       .more = {}};
        const glm::vec3 front =
            glm::cross(wall.corners[2] - wall.corners[1], wall.corners[1] - wall.corners[0]);
        if (!(glm::length(front) > 0))
            continue;
        wall.normal = glm::normalize(front);
        const glm::vec2 size = stereo::size_of(screen);
        const bool faces = glm::dot(head.position - wall.middle(), wall.normal) > 0;
        wall.more = fmt::format("{:.3g} x {:.3g} m, {}{}", size.x, size.y,
                                stereo::name_of(place.window.stereo), faces ? "" : ", faces away");
        walls.push_back(wall);
    }
    // What is told of is drawn over its neighbors.
    std::ranges::stable_sort(walls, {}, [](const DrawnWall& wall) { return wall.color != kSound; });
    return walls;
}

/// What the figure has room for: walls, and what is near them.
Box drawn_box(const CheckedRoom& room, const std::vector<DrawnWall>& walls) {
    constexpr float kAround = 0.4f, kTimes = 1.5f; // [m]; of the room's size
    glm::vec3 low = room.installation().viewers.front().position, high = low;
    if (!walls.empty())
        low = high = walls.front().middle();
    for (const DrawnWall& wall : walls)
        for (const glm::vec3& corner : wall.corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    const Box core{low, high};
    const float far = std::max(2.0f, kTimes * glm::distance(low, high));
    const auto include = [&](const glm::vec3& place, float around) {
        if (glm::distance(place, glm::clamp(place, core.low, core.high)) > far)
            return;
        low = glm::min(low, place - around);
        high = glm::max(high, place + around);
    };
    for (const stereo::Viewer& viewer : room.installation().viewers)
        include(viewer.position, kAround);
    const PlacementOptions& placed = room.config().placement;
    if (placed.size < 2 * double(far))
        include({0, placed.height, -placed.distance}, static_cast<float>(placed.size) / 2);
    each_tracker(room.config().devices, [&](const char*, const auto& tracker) {
        include(tracker.common.calibration.room_from_tracker.position, kAround);
    });
    include(glm::vec3(0), 0); // the origin
    const float margin = 0.05f * glm::distance(low, high);
    return {low - margin, high + margin};
}

/// A view along an axis of the room: which axes of the room lead right and down in the figure.
struct PlanView {
    const char* title;
    int across, down, into;           ///< axes of the room
    float right, downwards, forwards; ///< 1 or -1: the direction along them
    const char* left_word;
    const char* right_word;
};
constexpr std::array kViews{
    PlanView{"From above", 0, 2, 1, 1, 1, -1, "left (-X)", "right (+X)"},
    PlanView{"From the right", 2, 1, 0, -1, -1, -1, "back (+Z)", "front (-Z)"},
    PlanView{"From behind", 0, 1, 2, 1, -1, -1, "left (-X)", "right (+X)"}};

struct Area {
    glm::vec2 low, high;
};

/// One view, in its part of the figure.
class PlanDrawing {
  public:
    PlanDrawing(PlanCanvas& canvas, const PlanView& view, const Box& box, const Area& area,
                float scale)
        : canvas_(canvas), view_(view), box_(box), area_(area), scale_(scale) {
        const glm::vec2 middle = flat(box.middle());
        origin_ = glm::round(0.5f * (area.low + area.high) - scale * middle);
    }

    glm::vec2 at(const glm::vec3& place) const { return origin_ + scale_ * flat(place); }

    /// Lines of round coordinates, with the coordinates at the edges.
    void grid(float step) {
        const glm::vec2 low = (area_.low - origin_) / scale_,
                        high = (area_.high - origin_) / scale_;
        const auto number = [](float value) { return fmt::format("{:.4g}", value + 0.0f); };
        for (float x = std::ceil(low.x / step) * step; x <= high.x; x += step) {
            const float px = origin_.x + scale_ * x;
            canvas_.line({px, area_.low.y}, {px, area_.high.y}, 1, kGridLine);
            const std::string text = number(std::round(x / step) * step * view_.right);
            canvas_.words({px - canvas_.width_of(text, kSmall) / 2, area_.high.y + 2}, kSmall, text,
                          kPale);
        }
        for (float y = std::ceil(low.y / step) * step; y <= high.y; y += step) {
            const float py = origin_.y + scale_ * y;
            canvas_.line({area_.low.x, py}, {area_.high.x, py}, 1, kGridLine);
            const std::string text = number(std::round(y / step) * step * view_.downwards);
            canvas_.words({area_.low.x - canvas_.width_of(text, kSmall) - 6, py - kSmall / 2},
                          kSmall, text, kPale);
        }
        canvas_.words(area_.low - glm::vec2(0, kText + 8), kText, view_.title, kInk);
        const float below = area_.high.y + kSmall + 4;
        canvas_.words({area_.low.x, below}, kSmall, view_.left_word, kPale);
        canvas_.words({area_.high.x - canvas_.width_of(view_.right_word, kSmall), below}, kSmall,
                      view_.right_word, kPale);
        const glm::vec2 origin = at(glm::vec3(0));
        if (glm::clamp(origin, area_.low, area_.high) == origin) {
            canvas_.line(origin - glm::vec2(7, 0), origin + glm::vec2(7, 0), 2, kPale);
            canvas_.line(origin - glm::vec2(0, 7), origin + glm::vec2(0, 7), 2, kPale);
        }
    }

    void wall(const DrawnWall& wall) {
        std::array<glm::vec2, 4> corners;
        for (std::size_t i = 0; i < corners.size(); ++i)
            corners[i] = at(wall.corners[i]);
        const glm::vec2 front = flat(wall.normal);
        const float towards = -view_.forwards * wall.normal[view_.into]; // who sees the figure
        const float steep = glm::length(front);
        if (towards > 0.05f)
            canvas_.area(corners, glm::vec4(kLitSide, 0.12f));
        if (steep > 0.5f) // the side that is to be looked at
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const glm::vec2 a = corners[i], b = corners[(i + 1) % 4];
                const glm::vec2 shift = 10.0f * front / steep;
                const glm::vec2 strip[]{a, b, b + shift, a + shift};
                if (glm::distance(a, b) > 2 && i % 2 == edge_to_light(wall))
                    canvas_.area(strip, wall.color == kSound
                                            ? glm::vec4(kLitSide, 0.30f)
                                            : glm::vec4(glm::vec3(wall.color), 0.35f));
            }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::vec2 a = corners[i], b = corners[(i + 1) % 4];
            if (wall.carried || (towards < -0.05f && steep < 0.5f))
                canvas_.dashed(a, b, 2.5f, wall.color);
            else
                canvas_.line(a, b, 4, wall.color);
        }
        if (std::abs(towards) > 0.3f) { // which corner is the upper left one
            const float size = 0.35f * std::min({glm::distance(corners[0], corners[1]),
                                                 glm::distance(corners[1], corners[2]), 60.0f});
            const glm::vec2 mark[]{corners[1],
                                   corners[1] + size * direction(corners[1], corners[2]),
                                   corners[1] + size * direction(corners[1], corners[0])};
            canvas_.area(mark, glm::vec4(glm::vec3(wall.color), 0.55f));
        }
        const glm::vec2 middle = at(wall.middle());
        if (steep > 0.5f)
            canvas_.arrow(middle, middle + 46.0f * front / steep, 3, wall.color);
    }

    void label(const DrawnWall& wall) {
        const glm::vec2 front = flat(wall.normal);
        const float steep = glm::length(front);
        const glm::vec2 size(
            std::max(canvas_.width_of(wall.name, kText), canvas_.width_of(wall.more, kSmall)),
            kText + kSmall);
        const glm::vec2 middle = at(wall.middle());
        glm::vec2 low = glm::min(at(wall.corners[1]), at(wall.corners[3])) + glm::vec2(14, 10);
        if (steep > 0.5f) { // behind the wall
            const glm::vec2 back = -front / steep;
            low = middle + back * (16.0f + 0.5f * std::abs(glm::dot(back, size))) - 0.5f * size;
        } else if (view_.into == 1) // where no head is
            low = {low.x, std::max(at(wall.corners[0]).y, at(wall.corners[1]).y) - size.y - 12};
        low =
            glm::clamp(low, area_.low + 3.0f, glm::max(area_.low + 3.0f, area_.high - size - 3.0f));
        for (const float move : {0.0f, 1.0f, -1.0f, 2.0f, -2.0f, 3.0f}) {
            const Area place{low + glm::vec2(0, move * size.y),
                             low + size + glm::vec2(0, move * size.y)};
            if (place.low.y < area_.low.y || place.high.y > area_.high.y || is_taken(place))
                continue;
            taken_.push_back(place);
            canvas_.words(place.low, kText, wall.name, wall.color);
            canvas_.words(place.low + glm::vec2(0, kText), kSmall, wall.more, kPale);
            return;
        }
    }

    void data(const PlacementOptions& placed) {
        const float half = static_cast<float>(placed.size) / 2;
        const glm::vec3 middle(0, placed.height, -placed.distance);
        const glm::vec2 a = at(middle - half), b = at(middle + half);
        const glm::vec2 low = glm::min(a, b), high = glm::max(a, b);
        canvas_.dashed(low, {high.x, low.y}, 2, kData);
        canvas_.dashed({high.x, low.y}, high, 2, kData);
        canvas_.dashed(high, {low.x, high.y}, 2, kData);
        canvas_.dashed({low.x, high.y}, low, 2, kData);
        note(low + glm::vec2(5, 3), fmt::format("data, {:g} m", placed.size), kData);
    }

    void viewer(const stereo::Viewer& viewer) {
        const interaction::Pose head = head_of(viewer);
        const float radius = std::max(9.0f, 0.1f * scale_);
        const glm::vec2 middle = at(head.position), ahead = flat(glm::vec3(0, 0, -1));
        canvas_.line(middle, middle, 2 * radius, glm::vec4(0.55f, 0.57f, 0.60f, 0.55f));
        if (glm::length(ahead) > 0.5f)
            canvas_.arrow(middle + radius * ahead, middle + (radius + 26) * ahead, 3, kPale);
        const stereo::Eyes eyes = stereo::eyes_of_viewer(viewer, viewer.eye_separation);
        for (const auto& [eye, color] :
             {std::pair(stereo::Eye::left, kLeftEye), std::pair(stereo::Eye::right, kRightEye)}) {
            const glm::vec2 place = at(eye_position(head, eye, eyes));
            canvas_.line(place, place, 6, color);
        }
        note(middle + glm::vec2(radius + 6, 4),
             fmt::format("{}, eyes {:.4g} m up", viewer.name, viewer.position.y), kInk);
    }

    /// The tracker's origin, with one of its meters along each axis.
    void tracker(const std::string& name, const interaction::Calibration& known) {
        const glm::vec3 origin = known.room_from_tracker.position;
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 tip(0);
            tip[axis] = static_cast<float>(known.scale);
            const glm::vec2 end = at(origin + known.room_from_tracker.orientation * tip);
            canvas_.arrow(at(origin), end, 2, kAxisColors[axis]);
            if (glm::distance(at(origin), end) > 20)
                canvas_.words(end + glm::vec2(4, -kSmall), kSmall, std::string(1, "xyz"[axis]),
                              kAxisColors[axis]);
        }
        canvas_.line(at(origin), at(origin), 8, kInk);
        note(at(origin) + glm::vec2(8, 6), name, kInk);
    }

    /// Something that is beyond the figure, as an arrow at its edge.
    void beyond(const glm::vec3& place, const std::string& name) {
        const glm::vec2 to = at(place), edge = glm::clamp(to, area_.low + 4.0f, area_.high - 4.0f);
        if (edge == to)
            return;
        const glm::vec2 middle = 0.5f * (area_.low + area_.high);
        canvas_.arrow(edge - 40.0f * direction(middle, edge), edge, 3, kAmber);
        note(edge - glm::vec2(to.x < edge.x ? 0 : canvas_.width_of(name, kSmall), kSmall + 6), name,
             kAmber);
    }

  private:
    glm::vec2 flat(const glm::vec3& v) const {
        return {view_.right * v[view_.across], view_.downwards * v[view_.down]};
    }
    static glm::vec2 direction(glm::vec2 from, glm::vec2 to) {
        return glm::distance(from, to) > 0 ? glm::normalize(to - from) : glm::vec2(0);
    }
    /// Which pair of a wall's edges is seen as its length: the one that lies in the figure.
    std::size_t edge_to_light(const DrawnWall& wall) const {
        return glm::distance(at(wall.corners[0]), at(wall.corners[1])) >
                       glm::distance(at(wall.corners[1]), at(wall.corners[2]))
                   ? 0
                   : 1;
    }
    bool is_taken(const Area& place) const {
        return std::ranges::any_of(taken_, [&](const Area& other) {
            return place.low.x < other.high.x && place.high.x > other.low.x &&
                   place.low.y < other.high.y && place.high.y > other.low.y;
        });
    }
    /// Words at a place, or below it where others stand.
    void note(glm::vec2 low, const std::string& text, glm::vec4 color) {
        const glm::vec2 size(canvas_.width_of(text, kSmall), kSmall);
        low = glm::clamp(low, area_.low, glm::max(area_.low, area_.high - size));
        for (int i = 0; i < 4 && is_taken({low, low + size}); ++i)
            low.y += size.y;
        taken_.push_back({low, low + size});
        canvas_.words(low, kSmall, text, color);
    }

    PlanCanvas& canvas_;
    const PlanView& view_;
    Box box_;
    Area area_;
    float scale_;
    glm::vec2 origin_; ///< where the room's origin is
    std::vector<Area> taken_;
};

/// Words in as many lines as they need. @return where the next line begins
float wrapped(PlanCanvas& canvas, glm::vec2 at, float width, const std::string& text,
              glm::vec4 color) {
    std::string line;
    const auto flush = [&] {
        canvas.words(at, kSmall, line, color);
        at.y += kSmall + 2;
        line.clear();
    };
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = std::min(text.find(' ', i + 1), text.size());
        const std::string word = text.substr(i, end - i);
        if (!line.empty() && canvas.width_of(line + word, kSmall) > width) {
            flush();
            line = "    ";
        }
        line += word;
        i = end;
    }
    flush();
    return at.y;
}

/// The legend, and the problems in words.
void explain(PlanCanvas& canvas, const Area& area, const std::vector<ConfigProblem>& problems,
             float step) {
    glm::vec2 at = area.low;
    const auto sign = [&](const std::string& text, const auto& draw) {
        draw(at + glm::vec2(0, kSmall / 2 + 2));
        canvas.words(at + glm::vec2(64, 0), kSmall, text, kInk);
        at.y += kSmall + 6;
    };
    sign(fmt::format("a wall, the side to look at, and its front; a square of the grid is {:g} m",
                     step),
         [&](glm::vec2 p) {
             const glm::vec2 strip[]{p, p + glm::vec2(50, 0), p + glm::vec2(50, 8),
                                     p + glm::vec2(0, 8)};
             canvas.area(strip, glm::vec4(kLitSide, 0.30f));
             canvas.line(p, p + glm::vec2(50, 0), 4, kSound);
         });
    sign("upper left corner of a picture; dashed: seen from its back, or carried by the head",
         [&](glm::vec2 p) {
             const glm::vec2 mark[]{p + glm::vec2(16, -8), p + glm::vec2(34, -8),
                                    p + glm::vec2(16, 10)};
             canvas.area(mark, glm::vec4(glm::vec3(kSound), 0.55f));
         });
    sign("left eye and right eye of a viewer who looks to the front", [&](glm::vec2 p) {
        canvas.line(p + glm::vec2(18, 0), p + glm::vec2(18, 0), 8, kLeftEye);
        canvas.line(p + glm::vec2(34, 0), p + glm::vec2(34, 0), 8, kRightEye);
    });
    sign("a tracker's origin and axes, as long as what it reports as 1 m", [&](glm::vec2 p) {
        for (int axis = 0; axis < 3; ++axis)
            canvas.line(p + glm::vec2(16 * axis, 0), p + glm::vec2(16 * axis + 12, 0), 3,
                        kAxisColors[axis]);
    });
    at.y += 8;
    if (problems.empty())
        canvas.words(at, kText, "Nothing is wrong.", kData);
    std::size_t told = 0;
    for (const ConfigProblem& problem : problems) {
        if (at.y > area.high.y - 4 * kSmall)
            break;
        at.y =
            wrapped(canvas, at, area.high.x - area.low.x,
                    one_line(fmt::format(
                        "{}{}: {}", problem.line > 0 ? fmt::format("line {}, ", problem.line) : "",
                        problem.key, problem.text)),
                    problem.wrong ? kRed : kAmber) +
            4;
        ++told;
    }
    if (told < problems.size())
        canvas.words(at, kSmall, fmt::format("and {} more", problems.size() - told), kPale);
}

/// 1, 2 or 5 times a power of ten, so that lines are so many pixels apart at least.
float grid_step(float scale) {
    constexpr float kApart = 48;
    float step = 1e-3f;
    for (int i = 0; step * scale < kApart; ++i)
        step *= i % 3 == 1 ? 2.5f : 2;
    return step;
}

} // namespace

render::Image room_plan(const Config& config, const std::vector<ConfigProblem>& problems) {
    const CheckedRoom room(config);
    const std::vector<DrawnWall> walls = drawn_walls(room, problems);
    const Box box = drawn_box(room, walls);
    PlanCanvas canvas(kFigure, kSheet);
    const glm::vec2 half = 0.5f * glm::vec2(kFigure);
    const glm::vec2 inset(64, 44), outset(24, 52);
    const float top = 34;
    const std::array<Area, 4> areas{
        Area{{inset.x, top + inset.y}, {half.x - outset.x, half.y + top / 2 - outset.y}},
        Area{{half.x + inset.x, top + inset.y},
             {2 * half.x - outset.x, half.y + top / 2 - outset.y}},
        Area{{inset.x, half.y + top / 2 + inset.y}, {half.x - outset.x, 2 * half.y - outset.y}},
        Area{{half.x + inset.x, half.y + top / 2 + 20}, {2 * half.x - outset.x, 2 * half.y - 12}}};
    const glm::vec3 sides = glm::max(box.high - box.low, 0.05f);
    const glm::vec2 space = areas[0].high - areas[0].low;
    const float scale =
        std::min({space.x / sides.x, space.y / sides.z, space.x / sides.z, space.y / sides.y});
    const float step = grid_step(scale);
    canvas.words({24, 12}, 24,
                 one_line(fmt::format("{}    meters, +Y up, front at -Z",
                                      std::filesystem::path(config.name).filename().string())),
                 kInk);
    for (std::size_t i = 0; i < kViews.size(); ++i) {
        PlanDrawing drawing(canvas, kViews[i], box, areas[i], scale);
        drawing.grid(step);
        canvas.clip(areas[i].low, areas[i].high);
        for (const DrawnWall& wall : walls)
            drawing.wall(wall);
        drawing.data(config.placement);
        each_tracker(config.devices, [&](const char* key, const auto& tracker) {
            const interaction::Calibration& known = tracker.common.calibration;
            drawing.tracker(key, known);
            drawing.beyond(known.room_from_tracker.position, key);
        });
        for (const stereo::Viewer& viewer : config.installation.viewers) {
            drawing.viewer(viewer);
            drawing.beyond(viewer.position, viewer.name);
        }
        for (const DrawnWall& wall : walls)
            drawing.label(wall);
        canvas.clip_nothing();
    }
    explain(canvas, areas[3], problems, step);
    return canvas.image();
}

} // namespace isochron::app
