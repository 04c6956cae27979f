// What the checks of a configuration look at.
#include "app/config/check/checked_room.h"

#include "app/config/toml_table.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace isochron::app {
namespace {

constexpr float kLevel = 0.7f; ///< cosine to an axis of the room

/// Lines of all keys in a table, by path. @param path of the table, with a dot at its end
void note_lines(const toml::table& table, const std::string& path,
                std::map<std::string, int, std::less<>>& lines) {
    for (const auto& [name, node] : table) {
        const std::string key = path + std::string(name.str());
        lines.try_emplace(key, static_cast<int>(node.source().begin.line));
        if (const toml::table* inner = node.as_table())
            note_lines(*inner, key + ".", lines);
        else if (const toml::array* items = node.as_array())
            for (const toml::node& item : *items)
                if (const toml::table* one = item.as_table())
                    note_lines(*one, key + ".", lines);
    }
}

std::optional<Wall> wall_at(const PlacedViewport& place) {
    const stereo::Screen& screen = place.viewport.screen;
    if (screen.carried_by_head || screen.fit_aspect || has_usual_corners(screen))
        return std::nullopt;
    const glm::vec3 across = screen.upper_right - screen.upper_left,
                    up = screen.upper_left - screen.lower_left, front = glm::cross(across, up);
    if (!(glm::length(front) > 0))
        return std::nullopt;
    return Wall{.place = &place,
                .middle = 0.5f * (screen.lower_left + screen.upper_right),
                .across = glm::normalize(across),
                .up = glm::normalize(up),
                .normal = glm::normalize(front),
                .size = {glm::length(across), glm::length(up)},
                .corners = {screen.lower_left, screen.upper_left, screen.upper_right,
                            screen.lower_left + across}};
}

} // namespace

std::string name_of(const PlacedViewport& place) {
    if (!place.viewport.name.empty())
        return fmt::format("{} of window {}", place.viewport.name, place.window.name);
    if (place.window.viewports.size() > 1)
        return fmt::format("viewport {} of window {}", place.number, place.window.name);
    return fmt::format("window {}", place.window.name);
}

glm::vec2 pixels_of(const PlacedViewport& place) {
    return place.viewport.size * glm::vec2(place.window.size);
}

glm::vec2 pixel_size(const PlacedViewport& place) {
    const glm::vec2 whole = stereo::size_of(place.viewport.screen) / pixels_of(place);
    glm::vec2 half = whole;
    const stereo::StereoMode mode = stereo::upright(place.window.stereo);
    if (mode == stereo::StereoMode::side_by_side)
        half.x *= 2.0f;
    else if (mode == stereo::StereoMode::top_bottom)
        half.y *= 2.0f;
    const auto oblong = [](glm::vec2 size) { return std::abs(std::log(size.x / size.y)); };
    return oblong(half) < oblong(whole) ? half : whole;
}

float floor_level(const std::vector<const Wall*>& walls) {
    constexpr float kUnder = 0.3f; // [m] that the foot of a wall may be under the floor
    float floor = std::numeric_limits<float>::max();
    for (const Wall* wall : walls)
        if (wall->is_floor())
            floor = std::min(floor, wall->middle.y);
    if (floor < std::numeric_limits<float>::max())
        return floor;
    const float foot = walls.empty() ? 0 : CheckedRoom::box_of(walls).low.y;
    return foot >= -kUnder ? 0 : foot;
}

bool shows_one_eye(const Wall& wall) {
    return wall.window().stereo == stereo::StereoMode::left ||
           wall.window().stereo == stereo::StereoMode::right;
}

bool same_place(const Wall& a, const Wall& b) {
    constexpr float kSame = 1e-3f; // [m]
    for (std::size_t i = 0; i < a.corners.size(); ++i)
        if (glm::distance(a.corners[i], b.corners[i]) >= kSame)
            return false;
    return true;
}

bool in_one_wall(const Wall& a, const Wall& b) {
    constexpr float kParallel = 0.999f, kDeep = 0.1f; // cosine, and [m]
    return glm::dot(a.normal, b.normal) > kParallel &&
           std::abs(glm::dot(a.normal, b.corners[0] - a.corners[0])) < kDeep;
}

bool has_usual_corners(const stereo::Screen& screen) {
    const stereo::Screen usual;
    return screen.lower_left == usual.lower_left && screen.upper_left == usual.upper_left &&
           screen.upper_right == usual.upper_right;
}

bool Wall::is_level() const {
    return std::abs(normal.y) > kLevel;
}

bool Wall::is_floor() const {
    constexpr float kStood = 1.8f; // [m] across
    return normal.y > kLevel && std::min(size.x, size.y) >= kStood;
}

bool Wall::is_met(const glm::vec3& from, const glm::vec3& direction) const {
    const float along = glm::dot(direction, normal);
    const float times = along == 0 ? -1 : glm::dot(middle - from, normal) / along;
    const glm::vec3 off = from + times * direction - middle;
    return times > 0 && std::abs(glm::dot(off, across)) <= 0.5f * size.x &&
           std::abs(glm::dot(off, up)) <= 0.5f * size.y;
}

CheckedRoom::CheckedRoom(const Config& config) : config_(config) {
    for (const stereo::Window& window : config_.installation.windows)
        for (std::size_t i = 0; i < window.viewports.size(); ++i)
            viewports_.push_back({window, window.viewports[i], i + 1});
    for (const PlacedViewport& place : viewports_)
        if (const auto wall = wall_at(place))
            walls_.push_back(*wall);
    try {
        note_lines(toml::parse(config_.text), "", lines_);
    } catch (const toml::parse_error&) { // the text is of no file
    }
}

const stereo::Viewer& CheckedRoom::viewer_of(const PlacedViewport& place) const {
    return config_.installation.viewers[place.viewport.viewer];
}

std::vector<const Wall*> CheckedRoom::walls_of(std::size_t viewer) const {
    std::vector<const Wall*> seen;
    for (const Wall& wall : walls_)
        if (wall.place->viewport.viewer == viewer)
            seen.push_back(&wall);
    return seen;
}

Box CheckedRoom::box_of(const std::vector<const Wall*>& walls) {
    Box box{glm::vec3(std::numeric_limits<float>::max()),
            glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Wall* wall : walls)
        for (const glm::vec3& corner : wall->corners)
            box = {glm::min(box.low, corner), glm::max(box.high, corner)};
    return box;
}

int CheckedRoom::line_of(std::string_view key) const {
    const auto found = lines_.find(key);
    return found == lines_.end() ? 0 : found->second;
}

std::string other_unit(float length, float low, float high) {
    struct Unit {
        const char* name;
        double meters;
    };
    // The unit that makes the rounder length, among those that fit.
    constexpr Unit kUnits[]{{"decimeters", 0.1},
                            {"feet", 0.3048},
                            {"inches", 0.0254},
                            {"centimeters", 0.01},
                            {"millimeters", 0.001}};
    const Unit* best = nullptr;
    double least = 0;
    for (const Unit& unit : kUnits) {
        const double meters = double(length) * unit.meters;
        const double rest = std::abs(10 * meters - std::round(10 * meters));
        if (meters >= double(low) && meters <= double(high) && (!best || rest < least - 0.01)) {
            best = &unit;
            least = rest;
        }
    }
    return best ? fmt::format("; {:.4g} {} would be {:.2f} m", length, best->name,
                              double(length) * best->meters)
                : std::string();
}

} // namespace isochron::app
