// Describes an installation and finds its problems.
#include "app/config/check_config.h"

#include "app/config/check/check.h"
#include "app/config/tracker_setup.h"
#include "app/telling.h"
#include "stereo/nodes.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace isochron::app {
namespace {

std::string place_on_desktop(const stereo::Window& window) {
    if (window.fullscreen && window.monitor == stereo::kNextMonitor)
        return "fullscreen on the next monitor";
    if (window.fullscreen)
        return fmt::format("fullscreen on monitor {}", window.monitor);
    if (window.position == glm::ivec2(-1))
        return "placed by the desktop";
    return fmt::format("at {}, {}", window.position.x, window.position.y);
}

SafeText describe_viewport(const PlacedViewport& place, const stereo::Viewer& viewer) {
    const stereo::Screen& screen = place.viewport.screen;
    const glm::vec2 low = place.viewport.position * glm::vec2(place.window.size);
    const glm::vec2 pixels = pixels_of(place), size = stereo::size_of(screen);
    const glm::vec2 millimeters = 1000.0f * pixel_size(place);
    const double angle = stereo::corner_angle(screen);
    const glm::vec3 eyes = screen.carried_by_head ? glm::vec3(0.0f) : viewer.position;
    return SafeText("  viewport {}: {:.0f} x {:.0f} pixels at {:.0f}, {:.0f}; for {}\n"
                    "    screen: {:.2f} x {:.2f} m, {}, {}, {}, {:.2f} m from the viewer{}{}\n",
                    place.viewport.name.empty() ? std::to_string(place.number)
                                                : place.viewport.name,
                    pixels.x, pixels.y, low.x, low.y, viewer.name, size.x, size.y,
                    screen.carried_by_head ? "carried by the head" : "fixed in the room",
                    std::abs(angle - 90.0) <= stereo::kSquareCorner
                        ? "corners square"
                        : fmt::format("corners of {:.1f} degrees", angle),
                    stereo::faces(screen, eyes) ? "faces the viewer" : "faces away from the viewer",
                    stereo::distance_to(screen, {viewer.position, {1, 0, 0, 0}}),
                    screen.fit_aspect
                        ? "; fitted to the window's shape"
                        : fmt::format("; pixels {:.2f} x {:.2f} mm", millimeters.x, millimeters.y),
                    place.viewport.upside_down ? "; hangs upside down" : "");
}

/// Where eyes are whose middle is not the head's origin.
std::string middle_of_eyes(const stereo::Viewer& viewer) {
    if (!viewer.left_eye || !viewer.right_eye)
        return {};
    const glm::vec3 middle = 500.0f * (*viewer.left_eye + *viewer.right_eye);
    return fmt::format(" around {:.1f} {:.1f} {:.1f} mm from the head", middle.x, middle.y,
                       middle.z);
}

/// The windows that each node opens; empty if there is one node.
SafeText describe_nodes(const stereo::Installation& installation) {
    SafeText text;
    const int nodes = stereo::node_count(installation);
    for (int node = 0; nodes > 1 && node < nodes; ++node) {
        std::vector<std::string> names;
        for (const std::size_t number : stereo::windows_of(installation, node, nodes))
            names.push_back(installation.windows[number].name);
        text += SafeText("node {}: {}\n", node,
                         names.empty() ? "the operator's window"
                                       : fmt::to_string(fmt::join(names, ", ")));
    }
    return text;
}

} // namespace

std::vector<ConfigProblem> problems_of(const Config& config) {
    const CheckedRoom room(config);
    std::vector<ConfigProblem> found;
    for (const auto& checks : {checks_of_screens(), checks_of_walls(), checks_of_displays(),
                               checks_of_viewers(), checks_of_devices(), checks_of_values()})
        for (ConfigProblem& problem : findings_of(checks, room))
            found.push_back(std::move(problem));
    return found;
}

std::vector<ConfigProblem> device_problems_of(const Config& config) {
    return findings_of(checks_of_devices(), CheckedRoom(config));
}

std::string line_of(const ConfigProblem& problem, const Config& config) {
    const std::string name = config.name.empty() ? "built-in configuration" : config.name;
    return one_line(fmt::format("{}{}: {}{}: {}", name,
                                problem.line > 0 ? fmt::format(":{}", problem.line) : "",
                                problem.wrong ? "" : "warning: ", problem.key, problem.text));
}

void expect_sound(const Config& config) {
    const std::vector<ConfigProblem> problems = problems_of(config);
    const auto first = std::ranges::find(problems, true, &ConfigProblem::wrong);
    if (first == problems.end())
        return;
    const auto wrong = std::ranges::count(problems, true, &ConfigProblem::wrong);
    throw ConfigError(line_of(*first, config) +
                      (wrong > 1 ? fmt::format(" (the first of {} faults)", wrong) : ""));
}

std::string describe(const Config& config) {
    const stereo::Installation& installation = config.installation;
    SafeText text;
    for (const stereo::Viewer& viewer : installation.viewers)
        text +=
            SafeText("viewer {}: head {}, at {:g} {:g} {:g} m until it is tracked, eyes "
                     "{:.1f} mm apart{}\n",
                     viewer.name, viewer.head, viewer.position.x, viewer.position.y,
                     viewer.position.z, 1000.0f * viewer.eye_separation, middle_of_eyes(viewer));
    const stereo::Window* last = nullptr;
    const CheckedRoom room(config);
    for (const PlacedViewport& place : room.viewports()) {
        const stereo::Window& window = place.window;
        if (&window != last)
            text +=
                SafeText("window {}: {} x {} pixels, {}, {}\n", window.name, window.size.x,
                         window.size.y, place_on_desktop(window), stereo::name_of(window.stereo));
        last = &window;
        text += describe_viewport(place, room.viewer_of(place));
    }
    text += describe_nodes(installation);
    for (const std::string& line : describe_devices(config))
        text += SafeText("devices: {}\n", line);
    return text.str();
}

nlohmann::ordered_json json_of(const std::vector<ConfigProblem>& problems, const Config& config) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const ConfigProblem& problem : problems)
        all.push_back({{"line", problem.line},
                       {"key", problem.key},
                       {"text", problem.text},
                       {"error", problem.wrong},
                       {"message", line_of(problem, config)}});
    return all;
}

namespace {

/// What `describe` says of viewers, windows and devices, as objects.
nlohmann::ordered_json description_json(const Config& config) {
    using Json = nlohmann::ordered_json;
    const auto numbers = [](const auto& v) {
        Json list = Json::array();
        for (int i = 0; i < v.length(); ++i)
            list.push_back(v[i]);
        return list;
    };
    Json viewers = Json::array(), windows = Json::array();
    for (const stereo::Viewer& viewer : config.installation.viewers)
        viewers.push_back({{"name", viewer.name},
                           {"head", viewer.head},
                           {"position", numbers(viewer.position)},
                           {"eye_separation", viewer.eye_separation}});
    const stereo::Window* last = nullptr;
    const CheckedRoom room(config);
    for (const PlacedViewport& place : room.viewports()) {
        if (&place.window != last)
            windows.push_back({{"name", place.window.name},
                               {"size", numbers(place.window.size)},
                               {"stereo", stereo::name_of(place.window.stereo)},
                               {"viewports", Json::array()}});
        last = &place.window;
        windows.back()["viewports"].push_back(
            {{"name", place.viewport.name},
             {"viewer", room.viewer_of(place).name},
             {"size", numbers(pixels_of(place))},
             {"screen_size", numbers(stereo::size_of(place.viewport.screen))}});
    }
    return {{"viewers", viewers}, {"windows", windows}, {"devices", describe_devices(config)}};
}

} // namespace

void check_config(const Config& config) {
    const std::vector<ConfigProblem> problems = problems_of(config);
    tell_result({{"configuration", config.name}});
    tell_result(description_json(config));
    tell_result({{"problems", json_of(problems, config)}});
    print_answer(SafeText::lines(describe(config)));
    for (const ConfigProblem& problem : problems)
        print_answer("{}\n", line_of(problem, config));
    std::fflush(stdout); // before the error
    expect_sound(config);
    print_answer("nothing is wrong\n");
}

} // namespace isochron::app
