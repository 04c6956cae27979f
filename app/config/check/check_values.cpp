// Checks of numbers that are possible and unlikely to be meant, such as seconds for milliseconds.
#include "app/config/check/check.h"

#include "app/config/check/usual_values.h"
#include "app/config/config_words.h"
#include "stereo/nodes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>

namespace isochron::app {
namespace {

/// What lengths, times and the like are often given in by mistake: `value` of it is `value * factor`
/// of the unit that is expected.
struct Confusion {
    std::string_view expected;
    const char* given;
    double factor;
};
constexpr Confusion kConfusions[]{
    {"ms", "seconds", 1e3},
    {"ms", "microseconds", 1e-3},
    {"s", "milliseconds", 1e-3},
    {"m/s", "km/s", 1e3},
    {"m/s", "mm/s", 1e-3},
    {"m/s", "cm/s", 1e-2},
    {"m", "centimeters", 1e-2},
    {"m", "millimeters", 1e-3},
    {"degrees/s", "radians/s", 57.29577951},
    {"rad/s", "degrees/s", 1 / 57.29577951},
    {"MB", "GB", 1024},
    {"MB", "kB", 1.0 / 1024},
    {"kB", "MB", 1024},
    {"kB", "bytes", 1.0 / 1024},
};

std::string confused(const UsualValues& usual, double value) {
    for (const Confusion& each : kConfusions)
        if (const double meant = value * each.factor;
            each.expected == usual.unit && meant >= usual.low && meant <= usual.high)
            return fmt::format("; {:g} {} would be {:g} {}", value, each.given, meant, usual.unit);
    return {};
}

/// Calls `visit(path, value in the file's unit, line)` for each number of a table and those within.
template <Table T, class Visit>
void each_number(T& table, const std::string& path, int line, const Visit& visit) {
    each_field(
        [&]<class V>(const Field& field, V&& member) {
            using Value = std::remove_cvref_t<V>;
            const std::string key = path + field.key;
            if constexpr (Tables<Value>) {
                for (auto& item : member) {
                    int at = line;
                    if constexpr (requires { item.line.number; })
                        at = item.line.number;
                    else if constexpr (requires { item.line = 0; })
                        at = item.line;
                    each_number(item, key + ".", at, visit);
                }
            } else if constexpr (Table<Value>) {
                each_number(member, key + ".", line, visit);
            } else if constexpr (kIsDuration<Value>) {
                visit(key, member.count() * field.per, line);
            } else if constexpr (std::is_arithmetic_v<Value> && !std::same_as<Value, bool>) {
                visit(key, static_cast<double>(member) * field.per, line);
            }
        },
        table);
}

/// `latency_ms` for `dtrack.latency_ms`.
std::string_view last_name(std::string_view path) {
    return path.substr(path.rfind('.') + 1);
}

void unusual_values(const CheckedRoom& room, const Tell& tell) {
    Config config = room.config();                 // the list of keys takes what can be changed
    std::set<std::pair<std::string, double>> told; // devices have what their tracker says
    each_number(config, "", 0, [&](const std::string& path, double value, int line) {
        const std::string_view name = last_name(path);
        for (const UsualValues& usual : usual_values()) {
            const bool same = path == usual.key || (std::string_view(usual.key).starts_with('*') &&
                                                    name == last_name(usual.key));
            // Halves of the last digit of a float are no matter.
            const double slack = 1e-5 * std::abs(value);
            if (!same || value == 0 ||
                (value >= usual.low - slack && value <= usual.high + slack) ||
                !told.emplace(name, value).second)
                continue;
            tell.of(path)(line, "{:.6g} {} is unusual, expected {:g} to {:g}{}", value, usual.unit,
                          usual.low, usual.high, confused(usual, value));
        }
    });
}

/// A number and another one that it is not below, where neither is 0.
constexpr std::pair<const char*, const char*> kOrders[]{
    {"quality.longest_ms", "quality.frame_budget_ms"},
    {"quality.still_budget_ms", "quality.frame_budget_ms"},
    {"comfort.vignette_full", "comfort.vignette_speed"},
    {"comfort.vignette_turn_full", "comfort.vignette_turn"},
    {"cluster.frame_timeout", "cluster.timeout"},
    {"rendering.picture_samples", "rendering.samples"},
};

void orders(const CheckedRoom& room, const Tell& tell) {
    Config config = room.config();
    std::map<std::string, double, std::less<>> numbers;
    each_number(config, "", 0,
                [&](const std::string& path, double value, int) { numbers[path] = value; });
    for (const auto& [key, least] : kOrders)
        if (const double value = numbers[key], low = numbers[least]; value > 0 && value < low)
            tell.of(key)(0, "{:g} is less than {}, {:g}", value, least, low);
}

/// Keys of what another key turns on, and a file that does not have that key.
constexpr std::pair<const char*, const char*> kSwitches[]{
    {"openxr", "openxr.enabled"},
    {"comfort.vignette_speed", "comfort.vignette"},
    {"comfort.vignette_full", "comfort.vignette"},
    {"comfort.vignette_turn", "comfort.vignette"},
    {"comfort.vignette_turn_full", "comfort.vignette"},
    {"comfort.vignette_fade_ms", "comfort.vignette"},
};

void left_off(const CheckedRoom& room, const Tell& tell) {
    for (const auto& [key, on] : kSwitches)
        if (room.has(key) && !room.has(on))
            tell.of(on)(room.line_of(key), "{} has no effect without it", key);
}

void odd_samples(const CheckedRoom& room, const Tell& tell) {
    const auto samples = static_cast<unsigned>(room.config().rendering.samples);
    if (samples != 0 && (!std::has_single_bit(samples) || samples > 16))
        tell(0, "{}: drivers have 2, 4, 8 or 16 samples of a pixel", samples);
}

/// Shutters open with each picture of the display: an eye would see parts of the other's.
void unpaced_shutters(const CheckedRoom& room, const Tell& tell) {
    if (!room.config().rendering.vsync &&
        std::ranges::any_of(room.installation().windows, [](const stereo::Window& window) {
            return stereo::upright(window.stereo) == stereo::StereoMode::quadbuffer;
        }))
        tell(0, "with \"quadbuffer\", pictures have to wait for the display");
}

/// A frame's time for drawing that is longer than the frame.
void budgets_of_frames(const CheckedRoom& room, const Tell& tell) {
    constexpr double kSlack = 1.05, kOfHeadset = 1000.0 / 72; // [ms]
    const double budget = room.config().quality.frame_budget_ms,
                 period = 1000.0 / double(room.config().rendering.frame_rate_limit);
    if (room.has("rendering.frame_rate_limit") && budget > kSlack * period)
        tell(0, "{:g} ms for drawing, and {:.3g} ms for a frame of rendering.frame_rate_limit",
             budget, period);
    else if (room.config().openxr.enabled && budget > kSlack * kOfHeadset)
        tell(0, "{:g} ms for drawing, and headsets show a frame every {:.3g} ms or sooner", budget,
             kOfHeadset);
}

void size_of_panel(const CheckedRoom& room, const Tell& tell) {
    constexpr float kSmallest = 12, kLargest = 100; // degrees
    const auto& panel = room.config().panel;
    const float seen = glm::degrees(2 * std::atan(0.5f * panel.width / panel.distance));
    if (seen < kSmallest || seen > kLargest)
        tell(0, "{:g} m wide and {:g} m away, it is {:.0f} degrees wide for the eyes: {}",
             panel.width, panel.distance, seen,
             seen < kSmallest ? "too small to be read" : "too large to be seen");
}

void cluster_of_one(const CheckedRoom& room, const Tell& tell) {
    if (room.has("cluster") && stereo::node_count(room.installation()) == 1)
        tell(room.line_of("cluster"), "no window names a node, so there is one process");
}

/// What is said of data in a window, of a room.
void filled_rooms(const CheckedRoom& room, const Tell& tell) {
    if (room.config().placement.fill > 0 && !room.walls().empty())
        tell(0, "it is for a window on a desktop, and has no effect on walls: size, height and "
                "distance say where the data are");
}

/// A headset beside walls, which show the mirror of it.
void headset_in_a_room(const CheckedRoom& room, const Tell& tell) {
    if (room.config().openxr.enabled && room.walls().size() > 1)
        tell(0, "the walls only mirror the headset while it is there");
}

void dark_lights(const CheckedRoom& room, const Tell& tell) {
    const render::CellAppearance& light = room.config().rendering.appearance;
    if (light.ambient + light.head_light + light.key_light < 0.05f)
        tell(0, "with all lights at 0, surfaces are black");
    else if (light.key_light > 0 &&
             light.key_direction.y < -0.5f * glm::length(light.key_direction))
        tell(0, "lighting.key_direction points down: it is the way to the light, and y is up");
    const auto& angles = room.config().start.look.light;
    if (angles && (*angles)[1] < -30)
        tell(room.line_of("look.light"), "the light comes from below the floor");
    else if (angles && std::abs((*angles)[0]) < 3.2 && std::abs((*angles)[1]) < 1.6 &&
             std::floor((*angles)[1]) != (*angles)[1])
        tell(room.line_of("look.light"), "its angles are degrees: are these radians?");
}

void unseen_surfaces(const CheckedRoom& room, const Tell& tell) {
    const Config& config = room.config();
    std::set<double> isovalues;
    for (const ConfiguredSurface& surface : config.surfaces)
        if (surface.opacity <= 0)
            tell(room.line_of("surfaces.opacity"), "an opacity of 0 shows no surface");
        else if (glm::distance(surface.color, config.rendering.background) < 0.05f)
            tell(room.line_of("surfaces.color"), "a surface of the background's color");
        else if (!surface.isovalue && (surface.quantile <= 0 || surface.quantile >= 1))
            tell(room.line_of("surfaces.quantile"), "at a quantile of {:g} there is no surface",
                 surface.quantile);
        else if (surface.isovalue && !isovalues.insert(*surface.isovalue).second)
            tell(room.line_of("surfaces.isovalue"), "two surfaces at {:g}", *surface.isovalue);
    if (config.surfaces.empty() &&
        glm::distance(config.rendering.surface_color, config.rendering.background) < 0.05f)
        tell(room.line_of("rendering.surface_color"), "it is rendering.background's color");
}

void percentiles(const CheckedRoom& room, const Tell& tell) {
    const auto& given = room.config().start.coloring.percentiles;
    if (given && (*given)[1] <= 1)
        tell(0, "{:g} and {:g}: percentiles go from 0 to 100", (*given)[0], (*given)[1]);
}

constexpr Check kOfValues[]{
    {"*", Check::odd, unusual_values},
    {"*", Check::odd, orders},
    {"*", Check::odd, left_off},
    {"rendering.samples", Check::odd, odd_samples},
    {"rendering.vsync", Check::odd, unpaced_shutters},
    {"quality.frame_budget_ms", Check::odd, budgets_of_frames},
    {"panel", Check::odd, size_of_panel},
    {"cluster", Check::odd, cluster_of_one},
    {"placement.fill", Check::odd, filled_rooms},
    {"openxr.enabled", Check::odd, headset_in_a_room},
    {"lighting", Check::odd, dark_lights},
    {"surfaces", Check::odd, unseen_surfaces},
    {"coloring.percentiles", Check::odd, percentiles},
};

} // namespace

std::span<const Check> checks_of_values() {
    return kOfValues;
}

} // namespace isochron::app
