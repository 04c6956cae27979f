// Checks of how displays share windows, desktops, machines and the plane of a wall.
#include "app/config/check/check.h"

#include "stereo/screen.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace isochron::app {
namespace {

using stereo::StereoMode;

bool alike(const Wall& a, const Wall& b) {
    constexpr float kAlike = 0.02f; // share of a side
    const glm::vec2 off = glm::abs(a.size / b.size - 1.0f);
    return std::max(off.x, off.y) < kAlike;
}

/// From the middle of one display of a wall to that of another, in shares of the display's sides.
glm::vec2 way_on_wall(const Wall& a, const Wall& b) {
    const glm::vec3 way = b.middle - a.middle;
    return glm::vec2(glm::dot(way, a.across), glm::dot(way, a.up)) / a.size;
}

/// From one middle to the other in the window or on the desktop that both are on, in shares of the
/// pixels, y up; empty: nothing says.
std::optional<glm::vec2> way_in_pixels(const Wall& a, const Wall& b) {
    const auto is_placed = [](const stereo::Window& window) {
        return !window.fullscreen && window.position != glm::ivec2(-1);
    };
    const auto middle = [](const Wall& wall) {
        const stereo::Viewport& viewport = wall.place->viewport;
        const stereo::Window& window = wall.window();
        return (viewport.position + 0.5f * viewport.size) * glm::vec2(window.size) +
               glm::vec2(window.position.x, -window.position.y - window.size.y);
    };
    const bool one_desktop = is_placed(a.window()) && is_placed(b.window()) &&
                             a.window().node == b.window().node &&
                             a.window().stereo == b.window().stereo;
    if (&a.window() != &b.window() && !one_desktop)
        return std::nullopt;
    return (middle(b) - middle(a)) / pixels_of(*a.place);
}

/// Two displays of a wall, one beside or above the other, whose pixels lie the other way round. On a
/// desktop, rows may be in any order.
template <bool in_a_window>
void exchanged_displays(const CheckedRoom& room, const Tell& tell) {
    constexpr float kApart = 0.5f, kAligned = 0.25f; // shares of a display
    bool told = false;
    each_pair(room, [&](const Wall& a, const Wall& b) {
        const auto pixels = way_in_pixels(a, b);
        if (told || !pixels || (&a.window() == &b.window()) != in_a_window || !in_one_wall(a, b))
            return;
        const glm::vec2 wall = way_on_wall(a, b);
        for (int i = 0; i < (in_a_window ? 2 : 1); ++i) {
            const float least = std::min(std::abs(wall[i]), std::abs((*pixels)[i]));
            const float aside = std::max(std::abs(wall[1 - i]), std::abs((*pixels)[1 - i]));
            if (told || least < kApart || aside > kAligned || wall[i] * (*pixels)[i] > 0)
                continue;
            told = true;
            const char* const words[][2]{{"left of", "right of"}, {"below", "above"}};
            tell(in_a_window ? b.line() : b.window().line.number,
                 "{} is {} {} by its corners, and {} it by its pixels: position counts from the {}",
                 name_of(*b.place), words[i][wall[i] > 0], name_of(*a.place), words[i][wall[i] < 0],
                 in_a_window ? "lower left of the window" : "upper left of the desktop");
        }
    });
}

/// One display of a wall of equal displays has coarser pixels than its neighbor.
void unlike_pixels(const CheckedRoom& room, const Tell& tell) {
    constexpr float kUnlike = 1.5f;
    bool told = false;
    each_pair(room, [&](const Wall& a, const Wall& b) {
        const float one = pixel_size(*a.place).x, other = pixel_size(*b.place).x;
        if (told || !in_one_wall(a, b) || !alike(a, b) || same_place(a, b) ||
            std::max(one, other) < kUnlike * std::min(one, other))
            return;
        told = true;
        tell(b.window().line.number,
             "{} has pixels of {:.2f} mm, and {}, which is as large, of {:.2f} mm: are both sizes "
             "the displays' own?",
             name_of(*b.place), 1000 * other, name_of(*a.place), 1000 * one);
    });
}

/// Displays of which one lies over most of another. Blended projectors share less.
void covering_displays(const CheckedRoom& room, const Tell& tell) {
    constexpr float kMost = 0.5f; // share of a display
    each_pair(room, [&](const Wall& a, const Wall& b) {
        const bool pair_of_eyes =
            shows_one_eye(a) && a.window().stereo == stereo::inverted(b.window().stereo);
        const glm::vec2 left = glm::max(1.0f - glm::abs(way_on_wall(a, b)), 0.0f);
        if (a.place->viewport.viewer == b.place->viewport.viewer && in_one_wall(a, b) &&
            alike(a, b) && !same_place(a, b) && !pair_of_eyes && left.x * left.y > kMost)
            tell(b.line(),
                 "{} lies over {:.0f} % of {}: projectors that are blended share 10 to 30 %",
                 name_of(*b.place), 100 * left.x * left.y, name_of(*a.place));
    });
}

/// Where the middle line of a wall, from its left to its right, meets another wall well within that
/// wall's sides [m from the nearer side]; 0: nowhere.
float stands_within(const Wall& wall, const Wall& other) {
    constexpr float kOn = 0.01f, kWithin = 0.15f; // [m]
    if (wall.is_level() || other.is_level() || std::abs(glm::dot(wall.normal, other.normal)) > 0.7f)
        return 0;
    const glm::vec3 half = 0.5f * wall.size.x * wall.across;
    const float from = glm::dot(wall.middle - half - other.middle, other.normal),
                to = glm::dot(wall.middle + half - other.middle, other.normal);
    if (std::min(from, to) > kOn || std::max(from, to) < -kOn)
        return 0;
    const float share = glm::clamp(from / (from - to), 0.0f, 1.0f);
    const glm::vec3 off = wall.middle + (2 * share - 1) * half - other.middle;
    const float within = 0.5f * other.size.x - std::abs(glm::dot(off, other.across));
    return within > kWithin && std::abs(glm::dot(off, other.up)) < 0.5f * other.size.y ? within : 0;
}

void crossing_walls(const CheckedRoom& room, const Tell& tell) {
    each_pair(room, [&](const Wall& a, const Wall& b) {
        const float b_in_a = stands_within(b, a), a_in_b = stands_within(a, b);
        const bool first = b_in_a > 0;
        if (first || a_in_b > 0)
            tell(b.line(),
                 "{} stands in the middle of {}, {:.2f} m from its side: walls meet at their sides",
                 name_of(*(first ? b : a).place), name_of(*(first ? a : b).place),
                 first ? b_in_a : a_in_b);
    });
}

/// Upright walls that meet at a side, at nearly a right angle.
void skewed_corners(const CheckedRoom& room, const Tell& tell) {
    constexpr float kMeet = 0.05f;                    // [m]
    constexpr float kMeasured = 2.5f, kMeant = 10.0f; // degrees off a right angle
    each_pair(room, [&](const Wall& a, const Wall& b) {
        if (a.is_level() || b.is_level())
            return;
        for (const float i : {-1.0f, 1.0f})
            for (const float j : {-1.0f, 1.0f}) {
                const glm::vec3 on_a = 0.5f * i * a.size.x * a.across,
                                on_b = 0.5f * j * b.size.x * b.across;
                const float angle = glm::degrees(std::acos(glm::dot(-i * a.across, -j * b.across)));
                const float off = std::abs(angle - 90);
                if (glm::distance(a.middle + on_a, b.middle + on_b) < kMeet && off > kMeasured &&
                    off < kMeant)
                    tell(b.line(), "{} and {} meet at {:.1f} degrees: is one of them turned?",
                         name_of(*a.place), name_of(*b.place), angle);
            }
    });
}

/// Monitors that are counted through all machines.
void monitors_of_machines(const CheckedRoom& room, const Tell& tell) {
    std::map<int, const stereo::Window*> alone; // the window of a node that has no other
    for (const stereo::Window& window : room.installation().windows)
        if (const auto [known, is_new] = alone.emplace(window.node, &window); !is_new)
            known->second = nullptr;
    std::set<int> monitors;
    const stereo::Window* last = nullptr;
    for (const auto& [node, window] : alone)
        if (window && window->fullscreen && window->monitor != stereo::kNextMonitor)
            if (last = window; !monitors.insert(window->monitor).second)
                return;
    if (monitors.size() > 2)
        tell(last->line.number,
             "node {} opens window {} alone, on monitor {}: each machine counts its own monitors "
             "from 0",
             last->node, last->name, last->monitor);
}

void places_of_fullscreen(const CheckedRoom& room, const Tell& tell) {
    for (const stereo::Window& window : room.installation().windows)
        if (window.fullscreen && std::max(window.position.x, window.position.y) > 0)
            tell(
                window.line.number,
                "window {} covers a monitor, so its position has no effect: monitor says which one",
                window.name);
}

void names_of_viewports(const CheckedRoom& room, const Tell& tell) {
    for (const stereo::Window& window : room.installation().windows) {
        std::set<std::string> names;
        for (const stereo::Viewport& viewport : window.viewports)
            if (!viewport.name.empty() && !names.insert(viewport.name).second)
                tell(viewport.screen.line.number, "two viewports of window {} are called {}",
                     window.name, viewport.name);
    }
}

/// The screens of a headset's two eyes: each reaches farther out on the side of its eye.
void screens_of_eyes(const CheckedRoom& room, const Tell& tell) {
    const auto middle = [](const PlacedViewport& place) {
        return 0.5f * (place.viewport.screen.lower_left + place.viewport.screen.upper_right).x;
    };
    for (const PlacedViewport& left : room.viewports())
        for (const PlacedViewport& right : room.viewports()) {
            const stereo::Screen& screen = left.viewport.screen;
            constexpr float kAside = 0.02f; // share of the width
            if (left.window.stereo == StereoMode::left &&
                right.window.stereo == StereoMode::right && screen.carried_by_head &&
                right.viewport.screen.carried_by_head &&
                left.viewport.viewer == right.viewport.viewer &&
                middle(left) - middle(right) > kAside * stereo::size_of(screen).x)
                tell(right.line,
                     "{} is for the left eye and reaches farther to the right than {}: are they "
                     "exchanged?",
                     name_of(left), name_of(right));
        }
}

constexpr const char* kCorners = "windows.viewports.projection";
constexpr Check kOfDisplays[]{
    {"windows.viewports.position", Check::odd, exchanged_displays<true>},
    {"windows.position", Check::odd, exchanged_displays<false>},
    {"windows.size", Check::odd, unlike_pixels},
    {kCorners, Check::odd, covering_displays},
    {kCorners, Check::odd, crossing_walls},
    {kCorners, Check::odd, skewed_corners},
    {"windows.monitor", Check::odd, monitors_of_machines},
    {"windows.position", Check::odd, places_of_fullscreen},
    {"windows.viewports.name", Check::odd, names_of_viewports},
    {kCorners, Check::odd, screens_of_eyes},
};

} // namespace

std::span<const Check> checks_of_displays() {
    return kOfDisplays;
}

} // namespace isochron::app
