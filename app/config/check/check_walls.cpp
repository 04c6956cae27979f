// Checks of how windows, viewports and the walls of a room stand to one another.
#include "app/config/check/check.h"

#include "stereo/nodes.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using stereo::StereoMode;

constexpr float kSeam = 0.010f;     ///< [m] widest gap between screens that is no problem
constexpr float kNeighbors = 0.10f; ///< [m] corners this near are meant to coincide

void overlapping_viewports(const CheckedRoom& room, const Tell& tell) {
    const auto& all = room.viewports();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const stereo::Viewport &a = all[j].viewport, &b = all[i].viewport;
            const glm::vec2 high = glm::min(a.position + a.size, b.position + b.size);
            const glm::vec2 overlap =
                (high - glm::max(a.position, b.position)) * glm::vec2(all[i].window.size);
            if (&all[i].window == &all[j].window && std::min(overlap.x, overlap.y) > 0.5f)
                tell(all[i].line,
                     "{} overlaps another of the window's viewports by {:.0f} x {:.0f} pixels",
                     name_of(all[i]), overlap.x, overlap.y);
        }
}

void same_eye_twice(const CheckedRoom& room, const Tell& tell) {
    each_pair(room, [&](const Wall& a, const Wall& b) {
        if (same_place(a, b) && shows_one_eye(a) && a.window().stereo == b.window().stereo)
            tell(b.line(), "{} and {} have the same corners, and both show the {} eye",
                 name_of(*a.place), name_of(*b.place), stereo::name_of(a.window().stereo));
    });
}

void repeated_walls(const CheckedRoom& room, const Tell& tell) {
    each_pair(room, [&](const Wall& a, const Wall& b) {
        if (same_place(a, b) && !(shows_one_eye(a) && shows_one_eye(b)))
            tell(b.line(), "{} has the same corners as {}", name_of(*b.place), name_of(*a.place));
    });
}

/// Two screens that do not meet where they seem to be meant to.
struct ScreenGap {
    const Wall* a;
    const Wall* b;
    float width = 0; ///< [m]
};

/// The widest gap between corners that are near each other.
float gap_between(const Wall& a, const Wall& b) {
    float widest = 0;
    for (const glm::vec3& p : a.corners)
        for (const glm::vec3& q : b.corners)
            if (glm::distance(p, q) < kNeighbors)
                widest = std::max(widest, glm::distance(p, q));
    return widest;
}

/// Monitors on a desk, turned towards the viewer: they have frames, and nobody sees a wall in them.
bool are_turned_monitors(const Wall& a, const Wall& b) {
    constexpr float kLargestMonitor = 1.0f; // [m] along a side
    const auto largest = [](const Wall& wall) {
        const glm::vec2 size = stereo::size_of(wall.screen());
        return std::max(size.x, size.y);
    };
    return !in_one_wall(a, b) && std::max(largest(a), largest(b)) < kLargestMonitor;
}

/// How far apart the corners of two walls may be that meet. At a corner of four displays, those on
/// the diagonal are farther apart.
float allowed_gap(const Wall& a, const Wall& b) {
    constexpr float kFrames = 0.06f; // [m] of two monitors
    return std::max(kSeam + std::sqrt(2.0f) * (a.screen().bezel + b.screen().bezel),
                    are_turned_monitors(a, b) ? kFrames : 0.0f);
}

/// Gaps wider than a seam, and than the frames of both: one for each two walls, and one for all
/// displays of a wall.
void gaps(const CheckedRoom& room, const Tell& tell) {
    struct GapsOfWalls {
        ScreenGap widest;
        std::size_t count = 1;
    };
    std::vector<GapsOfWalls> walls;
    each_pair(room, [&](const Wall& a, const Wall& b) {
        const ScreenGap gap{&a, &b, gap_between(a, b)};
        if (same_place(a, b) || gap.width <= allowed_gap(a, b))
            return;
        const auto same = std::ranges::find_if(walls, [&](const GapsOfWalls& known) {
            return in_one_wall(*known.widest.a, a) && in_one_wall(*known.widest.b, b);
        });
        if (same == walls.end()) {
            walls.push_back({gap});
            return;
        }
        ++same->count;
        if (gap.width > same->widest.width)
            same->widest = gap;
    });
    for (const auto& [gap, count] : walls) {
        std::string text = fmt::format(
            "{}: a corner is {:.0f} mm from one of {}, where walls meet within {:.0f} mm",
            name_of(*gap.b->place), 1000.0f * gap.width, name_of(*gap.a->place), 1000.0f * kSeam);
        if (count > 1)
            text += fmt::format("; there are {} such gaps: bezel says how wide the frames of the "
                                "displays are",
                                count);
        tell(gap.b->line(), "{}", text);
    }
}

bool meet(const Wall& a, const Wall& b) {
    for (const glm::vec3& p : a.corners)
        for (const glm::vec3& q : b.corners)
            if (glm::distance(p, q) <= allowed_gap(a, b))
                return true;
    return false;
}

/// How far, and where to, a wall must be moved so that one of its edges is that of another wall, for
/// each pair of edges of one direction and length.
std::vector<glm::vec3> moves_to(const Wall& from, const Wall& to) {
    constexpr float kAlike = 0.01f; // [m]
    std::vector<glm::vec3> moves;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            const glm::vec3 a = from.corners[i], b = from.corners[(i + 1) % 4];
            glm::vec3 p = to.corners[j], q = to.corners[(j + 1) % 4];
            if (glm::dot(b - a, q - p) < 0)
                std::swap(p, q);
            if (glm::distance(p - a, q - b) < kAlike)
                moves.push_back(0.5f * (p - a + q - b));
        }
    return moves;
}

/// A wall that would meet others if it were moved, all by the same, and meets none.
struct MovedWall {
    const Wall* wall;
    glm::vec3 move{0.0f};
    const Wall* other;
};

/// @param all walls, of which none is in the place of another
std::vector<MovedWall> moved_walls(const std::vector<const Wall*>& all) {
    constexpr float kAlike = 0.01f, kStep = 0.35f; // [m]
    std::vector<std::size_t> met(all.size());      // how many others each wall meets
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < all.size(); ++j)
            met[i] += i != j && meet(*all[i], *all[j]);
    std::vector<MovedWall> moved;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (met[i] > 0)
            continue;
        const Wall& wall = *all[i];
        std::vector<MovedWall> moves;
        for (std::size_t j = 0; j < all.size(); ++j)
            if (met[j] > 0)
                for (const glm::vec3& move : moves_to(wall, *all[j]))
                    moves.push_back({&wall, move, all[j]});
        const MovedWall* nearest = nullptr;
        for (const MovedWall& one : moves) {
            const float length = glm::length(one.move);
            const bool to_others = std::ranges::any_of(moves, [&](const MovedWall& again) {
                return again.other != one.other && glm::distance(one.move, again.move) < kAlike;
            });
            // The wall across from it meets the same neighbor.
            const bool faced = std::ranges::any_of(all, [&](const Wall* across) {
                return glm::dot(across->normal, wall.normal) < -0.9f && meet(*across, *one.other);
            });
            // Walls may begin above the floor, and end below the ceiling.
            const bool apart = wall.is_level() && std::abs(one.move.y) > 0.95f * length &&
                               wall.normal.y * one.move.y > 0;
            if ((to_others || (faced && length < kStep)) && length >= kNeighbors && !apart &&
                (!nearest || length < glm::length(nearest->move)))
                nearest = &one;
        }
        if (nearest)
            moved.push_back(*nearest);
    }
    return moved;
}

void walls_out_of_place(const CheckedRoom& room, const Tell& tell) {
    std::vector<const Wall*> all;
    for (const Wall& wall : room.walls())
        if (std::ranges::none_of(all, [&](const Wall* one) { return same_place(*one, wall); }))
            all.push_back(&wall);
    constexpr std::size_t kMost = 200; // walls, of which each is held against all others
    if (all.size() > kMost)
        return;
    for (const auto& [wall, move, other] : moved_walls(all)) {
        const std::string by =
            fmt::format("{:+.2f} {:+.2f} {:+.2f}", move.x + 0.0f, move.y + 0.0f, move.z + 0.0f);
        tell(wall->line(),
             "{}: {:.0f} mm from where it would meet {} and the other walls ({} m): are its "
             "corners measured from another origin?",
             name_of(*wall->place), 1000 * glm::length(move), name_of(*other->place), by);
    }
}

/// Frames that are wider than the gap between two displays have no room.
void frames_in_gaps(const CheckedRoom& room, const Tell& tell) {
    constexpr float kSlack = 0.02f; // [m]
    bool told = false;
    each_pair(room, [&](const Wall& a, const Wall& b) {
        const float frames = a.screen().bezel + b.screen().bezel;
        float gap = kNeighbors;
        for (const glm::vec3& p : a.corners)
            for (const glm::vec3& q : b.corners)
                gap = std::min(gap, glm::distance(p, q));
        if (told || gap >= kNeighbors || frames <= 3 * gap + kSlack || same_place(a, b))
            return;
        told = true;
        tell(b.line(),
             "{}: its frame and that of {} are {:.0f} mm wide together, and the displays are "
             "{:.0f} mm apart: bezel is in meters",
             name_of(*b.place), name_of(*a.place), 1000 * frames, 1000 * gap);
    });
}

/// Stereo as who wears the glasses knows it: two projectors for two eyes are one way.
StereoMode way_of(const Wall& wall) {
    return shows_one_eye(wall) ? StereoMode::left : wall.window().stereo;
}

/// One wall that shows eyes in another way than those around it.
void mixed_stereo(const CheckedRoom& room, const Tell& tell) {
    constexpr float kNear = 0.35f; // [m]
    std::vector<const Wall*> left;
    for (const Wall& wall : room.walls())
        left.push_back(&wall);
    while (!left.empty()) {
        std::vector<const Wall*> group{left.back()};
        left.pop_back();
        for (std::size_t i = 0; i < group.size(); ++i) // it grows
            std::erase_if(left, [&](const Wall* wall) {
                bool near = wall->place->viewport.viewer == group[i]->place->viewport.viewer &&
                            !same_place(*wall, *group[i]);
                near = near && std::ranges::any_of(wall->corners, [&](const glm::vec3& p) {
                           return std::ranges::any_of(group[i]->corners, [&](const glm::vec3& q) {
                               return glm::distance(p, q) < kNear;
                           });
                       });
                if (near)
                    group.push_back(wall);
                return near;
            });
        std::ranges::sort(group, {}, &Wall::line);
        std::map<StereoMode, int> counts;
        for (const Wall* wall : group)
            ++counts[way_of(*wall)];
        const int most =
            std::ranges::max_element(counts, {}, &std::pair<const StereoMode, int>::second)->second;
        const auto usual = std::ranges::find_if(
            group, [&](const Wall* wall) { return counts[way_of(*wall)] == most; });
        for (const Wall* wall : group) {
            const StereoMode mode = way_of(*wall), other = way_of(**usual);
            if (mode == other)
                continue;
            const char* why = mode == StereoMode::mono ? "both eyes see one picture on it"
                              : stereo::upright(mode) == stereo::upright(other)
                                  ? "its eyes are exchanged"
                                  : "other glasses would see it";
            tell(wall->window().line.number, "{} is {}, and {} beside it {}: {}",
                 name_of(*wall->place), stereo::name_of(wall->window().stereo),
                 name_of(*(*usual)->place), stereo::name_of((*usual)->window().stereo), why);
        }
    }
}

/// The window of the other eye, on the same wall.
void one_eye_alone(const CheckedRoom& room, const Tell& tell) {
    const auto& all = room.viewports();
    for (const PlacedViewport& place : all) {
        const StereoMode mode = place.window.stereo;
        const stereo::Screen& screen = place.viewport.screen;
        if ((mode != StereoMode::left && mode != StereoMode::right) || screen.fit_aspect)
            continue;
        const bool paired = std::ranges::any_of(all, [&](const PlacedViewport& other) {
            const stereo::Screen& twin = other.viewport.screen;
            const glm::vec3 apart = 0.5f * (screen.lower_left + screen.upper_right -
                                            twin.lower_left - twin.upper_right);
            const glm::vec2 size = stereo::size_of(screen);
            const bool one_eye =
                other.window.stereo == mode || other.window.stereo == stereo::inverted(mode);
            return &other != &place && one_eye && other.viewport.viewer == place.viewport.viewer &&
                   twin.carried_by_head == screen.carried_by_head &&
                   (screen.carried_by_head || glm::length(apart) < 0.5f * std::min(size.x, size.y));
        });
        if (!paired)
            tell(place.window.line.number,
                 "{} shows the {} eye alone, and no window shows the {} eye there", name_of(place),
                 stereo::name_of(mode), stereo::name_of(stereo::inverted(mode)));
    }
}

/// Two projectors of a wall, or screens of a headset, whose names say the eyes the other way round.
void exchanged_eyes(const CheckedRoom& room, const Tell& tell) {
    const auto says = [](const PlacedViewport& place, const char* word, const char* other) {
        const std::string& name = place.window.name;
        return name.find(word) != name.npos && name.find(other) == name.npos;
    };
    const auto tell_if = [&](const PlacedViewport& left, const PlacedViewport& right) {
        if (says(left, "right", "left") && says(right, "left", "right"))
            tell(std::max(left.window.line.number, right.window.line.number),
                 "{} shows the right eye and {} the left eye: their names say the reverse",
                 name_of(right), name_of(left));
    };
    for (const PlacedViewport& left : room.viewports())
        for (const PlacedViewport& right : room.viewports())
            if (left.window.stereo == StereoMode::left &&
                right.window.stereo == StereoMode::right &&
                left.viewport.viewer == right.viewport.viewer &&
                left.viewport.screen.carried_by_head && right.viewport.screen.carried_by_head)
                tell_if(left, right);
    each_pair(room, [&](const Wall& a, const Wall& b) {
        if (same_place(a, b) && shows_one_eye(a) &&
            a.window().stereo == stereo::inverted(b.window().stereo))
            a.window().stereo == StereoMode::left ? tell_if(*a.place, *b.place)
                                                  : tell_if(*b.place, *a.place);
    });
}

/// Size of the area of the desktop that two windows share, if both have a configured position.
glm::ivec2 shared_pixels(const stereo::Window& a, const stereo::Window& b) {
    const glm::ivec2 nowhere(-1);
    if (a.fullscreen || b.fullscreen || a.position == nowhere || b.position == nowhere ||
        a.node != b.node)
        return glm::ivec2(0);
    return glm::max(glm::min(a.position + a.size, b.position + b.size) -
                        glm::max(a.position, b.position),
                    glm::ivec2(0));
}

template <class Visit>
void each_two_windows(const CheckedRoom& room, Visit&& visit) {
    const auto& windows = room.installation().windows;
    for (std::size_t i = 0; i < windows.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            visit(windows[j], windows[i]);
}

void monitors_covered_twice(const CheckedRoom& room, const Tell& tell) {
    each_two_windows(room, [&](const stereo::Window& a, const stereo::Window& b) {
        if (a.fullscreen && b.fullscreen && b.monitor != stereo::kNextMonitor &&
            a.monitor == b.monitor && a.node == b.node)
            tell(b.line.number, "window {} covers monitor {}, as window {} does", b.name, b.monitor,
                 a.name);
    });
}

void covered_windows(const CheckedRoom& room, const Tell& tell) {
    const auto look = [&](const stereo::Window& a, const stereo::Window& b) {
        const glm::ivec2 shared = shared_pixels(a, b);
        if (shared.x > 0 && shared.y > 0)
            tell(b.line.number, "window {} covers {} x {} pixels of window {}", b.name, shared.x,
                 shared.y, a.name);
    };
    each_two_windows(room, look);
    if (const auto& console = room.config().panel.console)
        for (const stereo::Window& window : room.installation().windows)
            look(window, console->window());
}

void nodes_without_windows(const CheckedRoom& room, const Tell& tell) {
    if (const std::string misfit = stereo::misfit(room.installation(), 1); !misfit.empty())
        tell(0, "{}", misfit);
}

constexpr Check kOfWalls[]{
    {"windows.viewports", Check::wrong, overlapping_viewports},
    {"windows.stereo", Check::wrong, same_eye_twice},
    {"windows.viewports.projection", Check::odd, repeated_walls},
    {"windows.viewports.projection", Check::odd, gaps},
    {"windows.viewports.projection", Check::odd, walls_out_of_place},
    {"windows.viewports.projection.bezel", Check::odd, frames_in_gaps},
    {"windows.stereo", Check::odd, mixed_stereo},
    {"windows.stereo", Check::odd, one_eye_alone},
    {"windows.stereo", Check::odd, exchanged_eyes},
    {"windows.monitor", Check::wrong, monitors_covered_twice},
    {"windows.position", Check::odd, covered_windows},
    {"windows.node", Check::wrong, nodes_without_windows},
};

} // namespace

std::span<const Check> checks_of_walls() {
    return kOfWalls;
}

} // namespace isochron::app
