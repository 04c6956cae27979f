// Finds measures of a configuration that no room has.
#include "app/config/check/check_parts.h"

#include "stereo/screen.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

namespace isochron::app {
namespace {

constexpr float kArmsLength = 1.5f;    ///< [m] from a sensor to what it is fixed on, at most
constexpr float kSteepestHead = 40.0f; ///< [degrees] off the eyes, of a screen on the head
/// Limits of the units that trackers have.
constexpr double kLargestScale = 10, kSmallestScale = 1e-4;

/// The line of `key = ` in a table of a file; 0: it is not there.
int line_of_key(const std::string& text, std::string_view table, std::string_view key) {
    std::istringstream lines(text);
    std::string current;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::size_t start = line.find_first_not_of(" \t");
        if (start == line.npos)
            continue;
        const std::string_view rest = std::string_view(line).substr(start);
        if (rest.starts_with('['))
            current = rest.substr(1, rest.find(']') - 1);
        const std::size_t end = rest.find_first_of(" \t=");
        if (current == table && rest.substr(0, end) == key)
            return number;
    }
    return 0;
}

bool is_usual(const stereo::Screen& screen) {
    const stereo::Screen usual;
    return screen.lower_left == usual.lower_left && screen.upper_left == usual.upper_left &&
           screen.upper_right == usual.upper_right;
}

/// Whether a rotation turns by amounts that are round in radians when they are read as degrees.
bool looks_like_radians(const glm::quat& rotation) {
    const glm::quat q = rotation.w < 0 ? -rotation : rotation;
    const glm::vec3 axis(q.x, q.y, q.z);
    const float sine = glm::length(axis);
    if (sine <= 0)
        return false;
    // Rotations as small as these add up axis by axis.
    const glm::vec3 degrees = axis * (glm::degrees(2 * std::atan2(sine, q.w)) / sine);
    constexpr float kRound = glm::quarter_pi<float>(), kNear = 0.02f, kFull = 6.4f;
    bool turns = false;
    for (int i = 0; i < 3; ++i) {
        const float turn = std::abs(degrees[i]);
        const float whole = kRound * std::round(turn / kRound);
        if (turn > kFull || std::abs(turn - whole) > kNear)
            return false;
        turns |= whole > 0;
    }
    return turns;
}

class MeasureJudge {
  public:
    MeasureJudge(const Config& config, Findings& findings)
        : config_(config), screens_(viewports_of(config)), findings_(findings) {}

    void judge() {
        viewers();
        planes();
        for (const PlacedViewport& screen : screens_)
            projection(screen);
        each_tracker(config_.devices, [&](const char* key, const auto& tracker) {
            for (const auto& each : tracker.devices)
                calibration(key, tracker.line, each.device);
        });
    }

  private:
    void warn(int line, const std::string& key, const std::string& text) {
        const auto same = [&](const ConfigProblem& known) {
            return known.line == line && known.key == key && known.text == text;
        };
        if (std::ranges::none_of(findings_.found, same))
            findings_.warn(line, key, text);
    }

    /// A viewer far outside of the room that the screens around them make.
    void viewers() {
        const auto& all = config_.installation.viewers;
        for (std::size_t i = 0; i < all.size(); ++i) {
            constexpr float kEmpty = std::numeric_limits<float>::max();
            glm::vec3 low(kEmpty), high(-kEmpty);
            for (const PlacedViewport& each : screens_) {
                if (each.viewport.screen.carried_by_head || each.viewport.viewer != i)
                    continue;
                for (const glm::vec3& corner :
                     corners_in_room(each.viewport.screen, {}, each.window.size)) {
                    low = glm::min(low, corner);
                    high = glm::max(high, corner);
                }
            }
            if (low.x > high.x)
                continue;
            constexpr float kRoomAround = 3; // [m] even for a small display
            const float margin = std::max(kRoomAround, glm::distance(low, high));
            const glm::vec3 at = all[i].position;
            const float away = glm::distance(at, glm::clamp(at, low, high));
            if (away > margin)
                warn(all[i].line.number, "viewer.position",
                     fmt::format("{} is {:.4g} m from all of the screens, {:.4g} m up: positions "
                                 "are in meters",
                                 all[i].name, away, at.y));
        }
    }

    void planes() {
        float nearest = std::numeric_limits<float>::max(), farthest = 0;
        for (const PlacedViewport& each : screens_) {
            const auto& viewer = config_.installation.viewers[each.viewport.viewer];
            const float away =
                stereo::distance_to(each.viewport.screen, {viewer.position, {1, 0, 0, 0}});
            nearest = std::min(nearest, std::abs(away));
            farthest = std::max(farthest, std::abs(away));
        }
        const float front = config_.installation.near_plane, back = config_.installation.far_plane;
        if (front >= farthest)
            warn(line_of_key(config_.text, "rendering", "near"), "rendering.near",
                 fmt::format("{:.4g} m is behind all screens, the farthest of which is {:.4g} m "
                             "from its viewer: what is nearer is not drawn",
                             front, farthest));
        if (back <= nearest)
            warn(line_of_key(config_.text, "rendering", "far"), "rendering.far",
                 fmt::format("{:.4g} m is in front of all screens, the nearest of which is {:.4g} "
                             "m from its viewer: what is farther is not drawn",
                             back, nearest));
    }

    void projection(const PlacedViewport& each) {
        const stereo::Screen& screen = each.viewport.screen;
        const bool others_in_room = std::ranges::any_of(screens_, [&](const PlacedViewport& other) {
            return !other.viewport.screen.carried_by_head && !is_usual(other.viewport.screen);
        });
        if (!screen.carried_by_head && is_usual(screen) && !screen.fit_aspect && others_in_room)
            warn(each.line, "windows.viewports.projection",
                 fmt::format("window {} has no corners, those of others are given: it shows a "
                             "screen of 1.6 x 0.9 m, 1 m ahead",
                             each.window.name));
        if (!screen.carried_by_head)
            return;
        // The lower right corner is across from the upper left one.
        const glm::vec3 middle = 0.5f * (screen.lower_left + screen.upper_right);
        const float length = glm::length(middle);
        const float off = length > 0 ? glm::degrees(std::acos(-middle.z / length)) : 0;
        if (off > kSteepestHead && others_in_room)
            warn(each.line, "windows.viewports.projection",
                 fmt::format("window {}: the middle of a screen that the head carries is {:.0f} "
                             "degrees off where the eyes look: its corners are measured from "
                             "between the eyes, not in the room",
                             each.window.name, off));
    }

    void calibration(const std::string& tracker, int line,
                     const interaction::DeviceOptions& device) {
        const interaction::Calibration& known = device.calibration;
        if (known.scale > kLargestScale || known.scale < kSmallestScale)
            warn(line, tracker + ".scale",
                 fmt::format("{:.4g}: meters for each meter that the tracker reports, expected "
                             "1, or 0.001 where it takes millimeters for meters",
                             known.scale));
        const float arm = glm::length(known.sensor_from_thing.position);
        if (arm > kArmsLength)
            warn(line, tracker + ".devices.offset",
                 fmt::format("{}: {:.4g} m from its sensor: offsets are in meters", device.name,
                             arm));
        if (looks_like_radians(known.room_from_tracker.orientation))
            warn(line, tracker + ".orientation",
                 "its angles are round in radians, and are read as degrees");
        if (looks_like_radians(known.sensor_from_thing.orientation))
            warn(line, tracker + ".devices.rotation",
                 fmt::format("{}: its angles are round in radians, and are read as degrees",
                             device.name));
    }

    const Config& config_;
    std::vector<PlacedViewport> screens_;
    Findings& findings_;
};

} // namespace

void check_measures(const Config& config, Findings& findings) {
    MeasureJudge(config, findings).judge();
}

} // namespace isochron::app
