// Checks of viewers, their eyes, and of what is placed before them.
#include "app/config/check/check.h"

#include "stereo/screen.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::app {
namespace {

using stereo::Viewer;

/// Calls `visit(viewer, number)` for each viewer.
template <class Visit>
void each_viewer(const CheckedRoom& room, Visit&& visit) {
    const auto& viewers = room.installation().viewers;
    for (std::size_t i = 0; i < viewers.size(); ++i)
        visit(viewers[i], i);
}

std::string at_place(const glm::vec3& place) {
    return fmt::format("({:g} {:g} {:g})", place.x, place.y, place.z);
}

void viewers_without_viewport(const CheckedRoom& room, const Tell& tell) {
    each_viewer(room, [&](const Viewer& viewer, std::size_t number) {
        if (std::ranges::none_of(room.viewports(), [&](const PlacedViewport& place) {
                return place.viewport.viewer == number;
            }))
            tell(viewer.line.number, "no viewport is for viewer {}", viewer.name);
    });
}

void shared_heads(const CheckedRoom& room, const Tell& tell) {
    each_viewer(room, [&](const Viewer& viewer, std::size_t number) {
        for (std::size_t j = 0; j < number; ++j)
            if (const Viewer& other = room.installation().viewers[j]; viewer.head == other.head)
                tell(viewer.line.number, "device {} tracks viewer {} and viewer {}", viewer.head,
                     other.name, viewer.name);
    });
}

/// Eyes far from all walls, above people, or on the floor.
void places_of_viewers(const CheckedRoom& room, const Tell& tell) {
    constexpr float kRoomAround = 3, kTallest = 2.5f, kLowest = 0.35f, kWallHigh = 1.5f; // [m]
    each_viewer(room, [&](const Viewer& viewer, std::size_t number) {
        const auto walls = room.walls_of(number);
        const glm::vec3 at = viewer.position;
        const int line = viewer.line.number;
        if (!walls.empty()) {
            const Box box = CheckedRoom::box_of(walls);
            const float away = glm::distance(at, glm::clamp(at, box.low, box.high));
            if (away > std::max(kRoomAround, glm::distance(box.low, box.high)))
                return tell(line,
                            "{} is {:.4g} m from all of the screens, {:.4g} m up: positions are in "
                            "meters{}",
                            viewer.name, away, at.y, other_unit(at.y, 0.9f, 2.1f));
        }
        const float level = floor_level(walls), up = at.y - level;
        const float foot = walls.empty() ? level : CheckedRoom::box_of(walls).low.y; // foot of a stage
        if (up > kTallest + 0.5f || at.y - std::max(level, foot) > kTallest)
            return tell(line,
                        "{}: the eyes are {:.2f} m above the floor: are position and corners in "
                        "meters, from one origin on the floor?{}",
                        viewer.name, up, other_unit(at.y, 0.9f, 2.1f));
        const bool stands_in_room = std::ranges::any_of(walls, [&](const Wall* wall) {
            return wall->is_floor() || (!wall->is_level() && wall->size.y >= kWallHigh &&
                                        CheckedRoom::box_of(walls).low.y > -0.3f);
        });
        if (stands_in_room && up < kLowest)
            tell(line, "{}: the eyes are {:.3g} m above the floor, at {}: y points up, in meters",
                 viewer.name, up, at_place(at));
    });
}

/// Walls that face each other, and a viewer who is not between them.
void viewers_outside(const CheckedRoom& room, const Tell& tell) {
    constexpr float kAbove = 0.1f; // [m]
    each_viewer(room, [&](const Viewer& viewer, std::size_t number) {
        const auto walls = room.walls_of(number);
        for (const Wall* wall : walls)
            for (const Wall* across : walls) {
                if (wall->is_level() || glm::dot(wall->normal, across->normal) > -0.9f)
                    continue;
                const float top = CheckedRoom::box_of(walls).high.y;
                if (viewer.position.y > top + kAbove)
                    return tell(viewer.line.number,
                                "{} at {} looks over walls that face each other and end {:.2f} m "
                                "up: corners are in meters",
                                viewer.name, at_place(viewer.position), top);
            }
    });
}

void viewers_at_walls(const CheckedRoom& room, const Tell& tell) {
    constexpr float kTooNear = 0.15f, kLarge = 1; // [m]
    for (const Wall& wall : room.walls()) {
        const Viewer& viewer = room.viewer_of(wall);
        const float away = glm::dot(viewer.position - wall.middle, wall.normal);
        if (away > 0 && away < kTooNear && std::min(wall.size.x, wall.size.y) > kLarge &&
            wall.is_met(viewer.position, -wall.normal))
            tell(viewer.line.number, "{} at {} touches {}, {:.0f} mm away: meters in the room",
                 viewer.name, at_place(viewer.position), name_of(*wall.place), 1000 * away);
    }
}

bool has_stereo(const CheckedRoom& room, std::size_t viewer) {
    return std::ranges::any_of(room.viewports(), [&](const PlacedViewport& place) {
        return place.viewport.viewer == viewer && place.window.stereo != stereo::StereoMode::mono;
    });
}

void distances_of_eyes(const CheckedRoom& room, const Tell& tell) {
    constexpr float kNarrow = 0.045f, kWide = 0.08f; // [m] of people
    each_viewer(room, [&](const Viewer& viewer, std::size_t number) {
        const float apart = viewer.eye_separation;
        const char* why = nullptr;
        if (apart <= 0 && viewer.left_eye)
            why = "left_eye and right_eye are one place";
        else if (apart <= 0 && has_stereo(room, number))
            why = "stereo shows both eyes one picture";
        else if ((apart < kNarrow && apart > 0 && has_stereo(room, number)) || apart > kWide)
            why = "people's eyes are 50 to 75 mm apart; meters from one eye to the other";
        if (why)
            tell(viewer.line.number, "{}: the eyes are {:.3g} mm apart: {}", viewer.name,
                 1000 * apart, why);
    });
}

void places_of_eyes(const CheckedRoom& room, const Tell& tell) {
    constexpr float kFar = 0.2f, kBeside = 1e-4f; // [m]
    for (const Viewer& viewer : room.installation().viewers) {
        if (!viewer.left_eye || !viewer.right_eye || viewer.eye_separation <= 0)
            continue;
        const glm::vec3 left = *viewer.left_eye, right = *viewer.right_eye;
        const float aside = (right.x - left.x) / viewer.eye_separation;
        const float off = 0.5f * glm::length(left + right);
        std::string why;
        if (aside < 0.8f)
            why = fmt::format("the right eye is not to the right of the left one, but {}",
                              std::abs(right.y - left.y) > std::abs(right.z - left.z)
                                  ? "above or below it"
                                  : "before or behind it");
        else if (off > kFar)
            why = fmt::format("the eyes are around a place {:.2f} m from the head", off);
        else if (left.x > -kBeside || right.x < kBeside)
            why = "both eyes are on one side of the origin, which is the point between the eyes";
        if (!why.empty())
            tell(viewer.line.number,
                 "{}: {}: meters in the frame of the head (x right, y up, z back)", viewer.name,
                 why);
    }
}

/// Nothing says how two pictures come to a tracked viewer whose eyes are described.
void forgotten_stereo(const CheckedRoom& room, const Tell& tell) {
    const bool eyes_given = room.has("viewer.eye_separation") || room.has("viewer.left_eye") ||
                            room.has("viewers.eye_separation") || room.has("viewers.left_eye");
    if (eyes_given && !room.has("windows.stereo") && !room.config().devices.empty() &&
        room.walls().size() > 1 && room.viewer_of(room.walls().front()).eye_separation > 0)
        tell(room.walls().front().window().line.number,
             "no window has a stereo mode, so both eyes of a tracked viewer see one picture: "
             "\"mono\" says that it is meant");
}

float nearest_screen(const CheckedRoom& room) {
    float nearest = std::numeric_limits<float>::max();
    for (const PlacedViewport& each : room.viewports())
        nearest = std::min(
            nearest, std::abs(stereo::distance_to(each.viewport.screen,
                                                  {room.viewer_of(each).position, {1, 0, 0, 0}})));
    return nearest;
}

float farthest_screen(const CheckedRoom& room) {
    float farthest = 0;
    for (const PlacedViewport& each : room.viewports())
        farthest = std::max(
            farthest, std::abs(stereo::distance_to(each.viewport.screen,
                                                   {room.viewer_of(each).position, {1, 0, 0, 0}})));
    return farthest;
}

/// The way from the first viewer's eyes to the middle of the data, if the file says where that is.
std::optional<glm::vec3> way_to_data(const CheckedRoom& room) {
    if (!room.has("placement"))
        return std::nullopt;
    const PlacementOptions& placed = room.config().placement;
    return glm::vec3(0, placed.height, -placed.distance) -
           room.installation().viewers.front().position;
}

void order_of_planes(const CheckedRoom& room, const Tell& tell) {
    if (room.installation().near_plane >= room.installation().far_plane)
        tell(0, "it is not nearer than rendering.far");
}

void near_planes(const CheckedRoom& room, const Tell& tell) {
    constexpr float kReach = 0.5f, kBefore = 0.5f; // [m]; share of the way to a screen
    const float front = room.installation().near_plane, farthest = farthest_screen(room),
                nearest = nearest_screen(room);
    if (front >= farthest)
        tell(0,
             "{:.4g} m is behind all screens, the farthest of which is {:.4g} m from its viewer: "
             "what is nearer is not drawn",
             front, farthest);
    else if (front > kReach)
        tell(0,
             "{:.4g} m: what is nearer to the eyes is not drawn, and that is within reach: meters",
             front);
    else if (front > kBefore * nearest)
        tell(0,
             "{:.4g} m: a screen is {:.4g} m from its viewer, and most of what stands out of it is "
             "not drawn",
             front, nearest);
}

void far_planes(const CheckedRoom& room, const Tell& tell) {
    const float back = room.installation().far_plane, nearest = nearest_screen(room),
                farthest = farthest_screen(room);
    const auto way = way_to_data(room);
    const auto half = static_cast<float>(0.5 * room.config().placement.size);
    if (back <= nearest)
        tell(0,
             "{:.4g} m is in front of all screens, the nearest of which is {:.4g} m from its "
             "viewer: what is farther is not drawn",
             back, nearest);
    else if (back < farthest)
        tell(0,
             "{:.4g} m is in front of a screen that is {:.4g} m from its viewer: what is farther "
             "is not drawn",
             back, farthest);
    else if (way && back < glm::length(*way) - half)
        tell(0,
             "{:.4g} m is before the data, which begin {:.4g} m away: what is farther is not drawn",
             back, glm::length(*way) - half);
}

/// Whether a part of the data's cube is seen through a wall, or before one.
bool is_seen(const CheckedRoom& room, const glm::vec3& way) {
    const auto half = static_cast<float>(0.5 * room.config().placement.size);
    const auto walls = room.walls_of(0);
    for (float x = -1; x <= 1; x += 0.5f)
        for (float y = -1; y <= 1; y += 0.5f)
            for (float z = -1; z <= 1; z += 0.5f)
                for (const Wall* wall : walls)
                    if (wall->is_met(room.installation().viewers.front().position,
                                     way + half * glm::vec3(x, y, z)))
                        return true;
    return false;
}

/// Data that no wall shows, that are too small where they are, or that are around the viewer.
void places_of_data(const CheckedRoom& room, const Tell& tell) {
    const auto way = way_to_data(room);
    const auto walls = room.walls_of(0);
    const PlacementOptions& placed = room.config().placement;
    if (!way || room.config().openxr.enabled || placed.fill > 0)
        return;
    const auto size = static_cast<float>(placed.size), half = 0.5f * size;
    const float away = glm::length(*way);
    const bool on_walls = std::ranges::none_of(room.viewports(), [](const PlacedViewport& place) {
        return place.viewport.screen.carried_by_head;
    });
    std::string why;
    if (!walls.empty() && on_walls) {
        const Box box = CheckedRoom::box_of(walls);
        const glm::vec3 sides = box.high - box.low;
        const float largest = std::max({sides.x, sides.y, sides.z});
        if (!is_seen(room, *way))
            why = fmt::format("no wall shows any of the data to a viewer at {}",
                              at_place(room.installation().viewers.front().position));
        else if (way->z > half && std::ranges::none_of(walls, [](const Wall* wall) {
                     return wall->normal.z < -0.7f;
                 }))
            why = "the data are behind the viewer, where no wall is; the front is at -Z";
        else if (placed.height + half < floor_level(walls))
            why = "the data are under the floor";
        else if (size > 4 * largest &&
                 std::max({std::abs(way->x), std::abs(way->y), std::abs(way->z)}) < half)
            why = fmt::format("the data are around the viewer, in a room of {:.4g} m: meters",
                              largest);
    }
    const bool small = size < 0.05f * away,
               far_off = size < 0.12f * away && away - size > 2.5f * farthest_screen(room);
    if (why.empty() && (small || far_off))
        why = fmt::format("the data are {:.1f} degrees wide and out of reach: meters",
                          glm::degrees(size / away));
    if (!why.empty())
        tell(0, "size = {:g}, height = {:g}, distance = {:g}: {}", placed.size, placed.height,
             placed.distance, why);
}

void fading(const CheckedRoom& room, const Tell& tell) {
    constexpr float kNone = 0.5f, kWhole = 1; // [m]
    const glm::vec2 fade = room.config().comfort.near_fade;
    const auto way = way_to_data(room);
    if (fade.x > kNone || fade.y > kWhole)
        tell(0,
             "nothing is drawn nearer than {:g} m, and all only beyond {:g} m: data within reach "
             "vanish",
             fade.x, fade.y);
    else if (way && fade.y > glm::length(*way) + 0.5 * room.config().placement.size)
        tell(0, "all data fade, as they are nearer than {:g} m at their place, {:.2f} m away",
             fade.y, glm::length(*way));
}

constexpr Check kOfViewers[]{
    {"viewers", Check::odd, viewers_without_viewport},
    {"viewers.head", Check::wrong, shared_heads},
    {"viewer.position", Check::odd, places_of_viewers},
    {"viewer.position", Check::odd, viewers_outside},
    {"viewer.position", Check::odd, viewers_at_walls},
    {"viewers.eye_separation", Check::odd, distances_of_eyes},
    {"viewers.left_eye", Check::odd, places_of_eyes},
    {"windows.stereo", Check::odd, forgotten_stereo},
    {"rendering.near", Check::wrong, order_of_planes},
    {"rendering.near", Check::odd, near_planes},
    {"rendering.far", Check::odd, far_planes},
    {"placement", Check::odd, places_of_data},
    {"comfort.near_fade", Check::odd, fading},
};

} // namespace

std::span<const Check> checks_of_viewers() {
    return kOfViewers;
}

} // namespace isochron::app
