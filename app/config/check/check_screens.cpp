// Checks of each window and each screen by itself.
#include "app/config/check/check.h"

#include "stereo/screen.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace isochron::app {
namespace {

using stereo::StereoMode;

constexpr float kSmallest = 0.02f, kLargest = 30.0f; ///< [m] sides of screens that people build
constexpr float kSquare = 0.02f;  ///< pixels' width and height may differ by this fraction
constexpr float kLevelled = 0.7f; ///< cosine to an axis of the room

void geometry(const CheckedRoom& room, const Tell& tell) {
    for (const PlacedViewport& place : room.viewports())
        for (const std::string& problem :
             stereo::problems(place.viewport.screen, room.viewer_of(place).position))
            tell(place.line, "{}: {}", name_of(place), problem);
}

void impossible_sizes(const CheckedRoom& room, const Tell& tell) {
    for (const PlacedViewport& place : room.viewports()) {
        const glm::vec2 size = stereo::size_of(place.viewport.screen);
        if (std::max(size.x, size.y) > kLargest || std::min(size.x, size.y) < kSmallest)
            tell(place.line,
                 "{}: {:.4g} x {:.4g} m is no size of a screen: corners are in meters{}",
                 name_of(place), size.x, size.y, other_unit(size.x, 0.3f, 10));
    }
}

/// Walls that are high or wide and have coarse pixels, or that are high and face each other.
void unlikely_sizes(const CheckedRoom& room, const Tell& tell) {
    constexpr float kTall = 6, kWide = 12, kFine = 0.005f; // [m]
    for (const Wall& wall : room.walls()) {
        const glm::vec2 pixel = pixel_size(*wall.place), size = wall.size;
        const bool faced = std::ranges::any_of(room.walls(), [&](const Wall& other) {
            return glm::dot(other.normal, wall.normal) < -0.9f && other.size.y > kTall;
        });
        const bool tall = size.y > kTall && !wall.is_level();
        if (std::max(size.x, size.y) <= kLargest &&
            ((tall && faced) || ((tall || size.x > kWide) && std::max(pixel.x, pixel.y) > kFine)))
            tell(wall.line(),
                 "{}: {:.4g} x {:.4g} m, with pixels of {:.1f} mm: corners are in meters{}",
                 name_of(*wall.place), size.x, size.y, 1000 * std::max(pixel.x, pixel.y),
                 other_unit(size.x, 1, 5));
    }
}

void turned_floors(const CheckedRoom& room, const Tell& tell) {
    for (const Wall& wall : room.walls()) {
        const glm::vec3 up = wall.up;
        if (wall.normal.y > kLevelled && std::max(up.z, std::abs(up.x)) > kLevelled)
            tell(wall.line(),
                 "{}: a floor whose upper edge is at the {}: {} to who faces the front (-Z)",
                 name_of(*wall.place),
                 up.z > kLevelled ? "back"
                 : up.x > 0       ? "right"
                                  : "left",
                 up.z > kLevelled ? "upside down" : "turned by 90 degrees");
    }
}

/// A display that is higher than wide may be one that was turned; a square wall was not.
void turned_walls(const CheckedRoom& room, const Tell& tell) {
    constexpr float kOblong = 1.15f;
    for (const Wall& wall : room.walls())
        if (!wall.is_level() && std::abs(wall.across.y) > kLevelled &&
            wall.size.x < kOblong * wall.size.y)
            tell(wall.line(),
                 "{}: its left edge is at the {}, so the picture lies on its side: upper_left, or "
                 "the order of the corners, is another one; y points up",
                 name_of(*wall.place), wall.across.y > 0 ? "bottom" : "top");
}

/// A front wall is a ceiling, and other walls lie on their side, where z points up.
void z_up(const CheckedRoom& room, const Tell& tell) {
    for (std::size_t i = 0; i < room.installation().viewers.size(); ++i) {
        const glm::vec3 at = room.installation().viewers[i].position;
        const auto walls = room.walls_of(i);
        const auto upright = [](const Wall* wall) {
            const bool would_be_floor = wall->normal.z > kLevelled && wall->middle.z < 0.3f;
            return !wall->is_level() && wall->up.y > kLevelled && !would_be_floor;
        };
        const auto lying = [](const Wall* wall) { return wall->up.z > kLevelled; };
        if (at.z > 0.8f && at.z < 2.3f && std::abs(at.y) < 0.6f &&
            std::ranges::any_of(walls, lying) && std::ranges::none_of(walls, upright))
            tell(
                walls.front()->line(),
                "z points up in the corners and in viewer.position; in the room y points up and -z "
                "to the front: x y z of a frame with y to the front is x z -y");
    }
}

void oblong_pixels(const CheckedRoom& room, const Tell& tell) {
    for (const PlacedViewport& place : room.viewports()) {
        const stereo::Screen& screen = place.viewport.screen;
        const glm::vec2 pixel = pixel_size(place), size = stereo::size_of(screen);
        const float aspect = pixel.x / pixel.y;
        if (!screen.fit_aspect && std::abs(aspect - 1.0f) > kSquare)
            tell(place.line,
                 "{}: its pixels are not square: {:.2f} times as wide as high ({:.0f} x {:.0f} "
                 "pixels on {:.2f} x {:.2f} m)",
                 name_of(place), aspect, pixels_of(place).x, pixels_of(place).y, size.x, size.y);
    }
}

void coarse_pixels(const CheckedRoom& room, const Tell& tell) {
    constexpr float kCoarse = 0.012f, kHuge = 0.1f; // [m]
    constexpr float kThumbnail = 100;               // pixels: whoever tries a room in small
    for (const Wall& wall : room.walls()) {
        const glm::vec2 pixel = pixel_size(*wall.place), count = pixels_of(*wall.place);
        const float side = std::min(pixel.x, pixel.y);
        if (side > kHuge || (side > kCoarse && std::max(count.x, count.y) >= kThumbnail))
            tell(wall.line(),
                 "{}: {:.0f} x {:.0f} pixels on {:.2f} x {:.2f} m are {:.0f} mm each: windows have "
                 "a size in pixels, screens one in meters",
                 name_of(*wall.place), pixels_of(*wall.place).x, pixels_of(*wall.place).y,
                 wall.size.x, wall.size.y, 1000 * std::min(pixel.x, pixel.y));
    }
}

void missing_corners(const CheckedRoom& room, const Tell& tell) {
    const bool others_in_room =
        std::ranges::any_of(room.viewports(), [](const PlacedViewport& other) {
            return !other.viewport.screen.carried_by_head &&
                   !has_usual_corners(other.viewport.screen);
        });
    for (const PlacedViewport& place : room.viewports()) {
        const stereo::Screen& screen = place.viewport.screen;
        if (!screen.carried_by_head && has_usual_corners(screen) && !screen.fit_aspect &&
            others_in_room)
            tell(place.line,
                 "{} has no corners, those of others are given: it shows a screen of 1.6 x 0.9 m, "
                 "1 m ahead",
                 name_of(place));
    }
}

/// One of the screens that a head carries is where the eyes look.
void carried_screens(const CheckedRoom& room, const Tell& tell) {
    constexpr float kSteepest = 40.0f, kEdge = 1.04f; // [degrees]; half sizes
    for (std::size_t i = 0; i < room.installation().viewers.size(); ++i) {
        const PlacedViewport* first = nullptr;
        bool ahead = false;
        float least = 180;
        for (const PlacedViewport& place : room.viewports()) {
            const stereo::Screen& screen = place.viewport.screen;
            if (!screen.carried_by_head || screen.fit_aspect || place.viewport.viewer != i)
                continue;
            first = first ? first : &place;
            const glm::vec3 middle = 0.5f * (screen.lower_left + screen.upper_right);
            const glm::vec3 across = 0.5f * (screen.upper_right - screen.upper_left),
                            up = 0.5f * (screen.upper_left - screen.lower_left),
                            normal = glm::cross(across, up);
            const float times = glm::dot(middle, normal) / -normal.z;
            const glm::vec3 off = glm::vec3(0, 0, -times) - middle;
            ahead |= times > 0 &&
                     std::abs(glm::dot(off, across)) <= kEdge * glm::dot(across, across) &&
                     std::abs(glm::dot(off, up)) <= kEdge * glm::dot(up, up);
            if (glm::length(middle) > 0)
                least = std::min(least, glm::degrees(std::acos(-middle.z / glm::length(middle))));
        }
        if (first && (!ahead || least > kSteepest))
            tell(first->line,
                 "{}: the middle of a screen that the head carries is {:.0f} degrees off where the "
                 "eyes look: its corners are measured from between the eyes; with carried_by = "
                 "\"room\" they are in the room",
                 name_of(*first), least);
    }
}

/// The reverse: corners around an origin between the eyes, of a screen that the head does not carry.
void corners_from_the_eyes(const CheckedRoom& room, const Tell& tell) {
    for (std::size_t i = 0; i < room.installation().viewers.size(); ++i) {
        const auto walls = room.walls_of(i);
        if (walls.size() != 1 || walls.front()->normal.z < 0.9f || walls.front()->middle.z > 0)
            continue;
        const Wall& wall = *walls.front();
        const float height = room.installation().viewers[i].position.y;
        if (std::max(std::abs(wall.middle.x), std::abs(wall.middle.y)) < 1e-3f &&
            height > 0.5f * wall.size.y)
            tell(wall.line(),
                 "{}: its corners lie around the origin, {:.2f} m below the viewer: carried_by = "
                 "\"head\" if they are measured from the eyes; in the room, viewer.position and "
                 "corners have one origin",
                 name_of(*wall.place), height);
    }
}

/// What is drawn is not what the wall is.
void fitted_walls(const CheckedRoom& room, const Tell& tell) {
    for (const PlacedViewport& place : room.viewports()) {
        const stereo::Screen& screen = place.viewport.screen;
        if (!screen.fit_aspect || screen.carried_by_head || has_usual_corners(screen) ||
            !place.window.fullscreen)
            continue;
        const glm::vec2 pixel = pixel_size(place);
        if (std::abs(pixel.x / pixel.y - 1.0f) > kSquare)
            tell(place.line,
                 "{}: its corners are widened to the window's shape, which a real wall is not: "
                 "fit_aspect is for windows on a desktop",
                 name_of(place));
    }
}

/// The words of a name: `FrontLeft_2` is `front`, `left`.
std::set<std::string> name_words(const std::string& name) {
    std::set<std::string> words;
    std::string word;
    bool was_lower = false;
    const auto end = [&] {
        if (!word.empty())
            words.insert(word);
        word.clear();
    };
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (!std::isalpha(code) || (std::isupper(code) && was_lower))
            end();
        if (std::isalpha(code))
            word += static_cast<char>(std::tolower(code));
        was_lower = std::islower(code);
    }
    end();
    return words;
}

/// A name that says where a wall is, and a wall that is elsewhere.
void names_of_sides(const CheckedRoom& room, const Tell& tell) {
    for (const Wall& wall : room.walls()) {
        const stereo::Window& window = wall.window();
        const std::string& own = wall.place->viewport.name;
        if (own.empty() && window.viewports.size() > 1)
            continue;
        const std::set<std::string> words = name_words(own.empty() ? window.name : own);
        const glm::vec3 eyes = room.viewer_of(wall).position;
        const Box all = CheckedRoom::box_of(room.walls_of(wall.place->viewport.viewer));
        const float aside = 0.05f * (all.high.x - all.low.x);
        const auto is_right_of = [&](float side) { // right of the viewer and of the other walls
            return side * (wall.middle.x - eyes.x) > aside &&
                   side * (wall.middle.x - all.middle().x) > aside;
        };
        const bool one_eye =
            window.stereo == StereoMode::left || window.stereo == StereoMode::right;
        const bool one_side = !one_eye && words.contains("left") != words.contains("right");
        const bool opposite = std::ranges::any_of(room.walls(), [&](const Wall& other) {
            return glm::dot(other.normal, wall.normal) < -kLevelled;
        });
        const char* is = nullptr;
        const char* named = nullptr;
        const auto unless = [&](const char* word, bool lies, const char* place) {
            if (!is && words.contains(word) && lies) {
                named = word;
                is = place;
            }
        };
        unless("front", wall.middle.z > eyes.z + 0.1f, "behind the viewer");
        unless("back", opposite && wall.normal.z > kLevelled && wall.middle.z < eyes.z - 0.1f,
               "ahead of the viewer");
        unless("left", one_side && is_right_of(1), "on the right");
        unless("right", one_side && is_right_of(-1), "on the left");
        unless("floor", wall.normal.y < 0.5f, "not seen from above");
        unless("ceiling", wall.normal.y > -0.5f, "not seen from below");
        if (is)
            tell(wall.line(),
                 "{}: its name says {}, and by its corners it is {}: the front is at -Z, +X on the "
                 "right; are corners exchanged with those of another wall, or is the room turned?",
                 name_of(*wall.place), named, is);
    }
}

/// Somewhere ahead, or on the floor there, something is shown.
void nothing_ahead(const CheckedRoom& room, const Tell& tell) {
    for (std::size_t i = 0; i < room.installation().viewers.size(); ++i) {
        const auto walls = room.walls_of(i);
        const glm::vec3 eyes = room.installation().viewers[i].position;
        bool ahead = false;
        for (float heading = -30; heading <= 30; heading += 15)
            for (float pitch = -80; pitch <= 50; pitch += 10) {
                const float h = glm::radians(heading), p = glm::radians(pitch);
                const glm::vec3 direction(std::sin(h) * std::cos(p), std::sin(p),
                                          -std::cos(h) * std::cos(p));
                ahead |= std::ranges::any_of(
                    walls, [&](const Wall* wall) { return wall->is_met(eyes, direction); });
            }
        if (!walls.empty() && !ahead)
            tell(walls.front()->line(),
                 "no wall is ahead of {} at ({:g} {:g} {:g}), where data are placed: the front is "
                 "at -Z",
                 room.installation().viewers[i].name, eyes.x, eyes.y, eyes.z);
    }
}

/// Interlaced rows and columns belong to eyes by their place on the monitor.
void odd_rows(const CheckedRoom& room, const Tell& tell) {
    for (const stereo::Window& window : room.installation().windows) {
        const glm::ivec2 at = window.position;
        const bool odd = window.stereo == StereoMode::vertical_interlaced     ? at.y % 2 == 1
                         : window.stereo == StereoMode::horizontal_interlaced ? at.x % 2 == 1
                         : window.stereo == StereoMode::checkerboard ? (at.x + at.y) % 2 == 1
                                                                     : false;
        if (odd && !window.fullscreen && at != glm::ivec2(-1))
            tell(window.line.number,
                 "window {} begins at {}, {}, where the monitor's rows or columns are for the "
                 "other eye: {}_inverted, or an even position",
                 window.name, at.x, at.y, stereo::name_of(window.stereo));
    }
}

void unused_monitor(const CheckedRoom& room, const Tell& tell) {
    for (const stereo::Window& window : room.installation().windows)
        if (window.monitor != stereo::kNextMonitor && !window.fullscreen)
            tell(window.line.number,
                 "window {} does not go to monitor {}: without fullscreen = true, position says "
                 "where it is",
                 window.name, window.monitor);
}

void hidden_windows(const CheckedRoom& room, const Tell& tell) {
    const stereo::ContextKind context = room.config().rendering.context;
    if (context == stereo::ContextKind::glfw || room.config().openxr.enabled)
        return;
    const bool covers =
        std::ranges::any_of(room.installation().windows, &stereo::Window::fullscreen);
    if (covers || !room.config().devices.empty())
        tell(0, "{} shows no window, and {} for one: \"glfw\"", stereo::name_of(context),
             covers ? "fullscreen asks" : "trackers are");
}

constexpr const char* kProjection = "windows.viewports.projection";
constexpr Check kOfScreens[]{
    {kProjection, Check::wrong, geometry},
    {kProjection, Check::wrong, impossible_sizes},
    {kProjection, Check::odd, z_up},
    {kProjection, Check::odd, unlikely_sizes},
    {kProjection, Check::odd, turned_floors},
    {kProjection, Check::odd, turned_walls},
    {kProjection, Check::odd, oblong_pixels},
    {"windows.size", Check::odd, coarse_pixels},
    {kProjection, Check::odd, missing_corners},
    {"windows.viewports.projection.carried_by", Check::odd, carried_screens},
    {"windows.viewports.projection.carried_by", Check::odd, corners_from_the_eyes},
    {"windows.viewports.projection.fit_aspect", Check::odd, fitted_walls},
    {kProjection, Check::odd, names_of_sides},
    {kProjection, Check::odd, nothing_ahead},
    {"windows.stereo", Check::odd, odd_rows},
    {"windows.monitor", Check::odd, unused_monitor},
    {"rendering.context", Check::odd, hidden_windows},
};

} // namespace

std::span<const Check> checks_of_screens() {
    return kOfScreens;
}

} // namespace isochron::app
