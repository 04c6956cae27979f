// Describes an installation and finds its problems.
#include "app/config/check_config.h"

#include "app/config/check/check_parts.h"
#include "app/config/tracker_setup.h"
#include "app/safe_text.h"
#include "stereo/nodes.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace isochron::app {
namespace {

constexpr float kSmallest = 0.02f, kLargest = 30.0f; ///< [m] sides of screens that people build
constexpr float kSquare = 0.02f;    ///< pixels' width and height may differ by this fraction
constexpr float kNeighbors = 0.10f; ///< [m] corners this near are meant to coincide
constexpr float kSame = 1e-3f;      ///< [m] corners this near are the same
constexpr float kLevel = 0.7f;      ///< cosine to an axis of the room
constexpr const char* kScreenKey = "windows.viewports.projection";

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

/// Size of a pixel on the screen [m]. An eye with half of the window is either stretched over the
/// whole screen or has its own projector: takes the one with squarer pixels.
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

/// Whether two screens have the same corners. Screens without configured corners do not count: all
/// have the default ones.
bool same_place(const stereo::Screen& a, const stereo::Screen& b) {
    const stereo::Screen usual;
    const bool given = a.lower_left != usual.lower_left || a.upper_right != usual.upper_right;
    return given && glm::distance(a.lower_left, b.lower_left) < kSame &&
           glm::distance(a.upper_left, b.upper_left) < kSame &&
           glm::distance(a.upper_right, b.upper_right) < kSame;
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

class Judge {
  public:
    Judge(const Config& config, Findings& findings) : config_(config), findings_(findings) {}

    void judge() {
        const auto all = viewports_of(config_);
        for (std::size_t i = 0; i < all.size(); ++i) {
            screen(all[i]);
            for (std::size_t j = 0; j < i; ++j)
                pair(all[j], all[i]);
        }
        check_gaps(gaps_, kScreenKey, findings_);
        windows();
        viewers(all);
        const std::string misfit = stereo::misfit(config_.installation, 1);
        if (!misfit.empty())
            add(0, "windows.node", misfit);
        if (config_.installation.near_plane >= config_.installation.far_plane)
            add(0, "rendering.near", "it is not nearer than rendering.far");
    }

  private:
    void add(int line, const std::string& key, const std::string& text, bool wrong = true) {
        wrong ? findings_.wrong(line, key, text) : findings_.warn(line, key, text);
    }

    void screen(const PlacedViewport& place) {
        const stereo::Screen& screen = place.viewport.screen;
        const stereo::Viewer& viewer = config_.installation.viewers[place.viewport.viewer];
        for (const std::string& problem : stereo::problems(screen, viewer.position))
            add(place.line, kScreenKey, fmt::format("{}: {}", name_of(place), problem));
        const glm::vec2 size = stereo::size_of(screen);
        if (std::max(size.x, size.y) > kLargest || std::min(size.x, size.y) < kSmallest)
            add(place.line, kScreenKey,
                fmt::format("{}: {:.4g} x {:.4g} m is no size of a screen: corners are in meters",
                            name_of(place), size.x, size.y));
        const glm::vec3 up = glm::normalize(screen.upper_left - screen.lower_left);
        const glm::vec3 across = glm::normalize(screen.upper_right - screen.upper_left);
        const bool is_floor = !screen.carried_by_head && glm::cross(across, up).y > kLevel;
        if (is_floor && std::max(up.z, std::abs(up.x)) > kLevel)
            add(place.line, kScreenKey,
                fmt::format("{}: a floor whose upper edge is at the {}: {} to who faces the front "
                            "(-Z)",
                            name_of(place),
                            up.z > kLevel ? "back"
                            : up.x > 0    ? "right"
                                          : "left",
                            up.z > kLevel ? "upside down" : "turned by 90 degrees"),
                false);
        const glm::vec2 pixel = pixel_size(place);
        const float aspect = pixel.x / pixel.y;
        if (!screen.fit_aspect && std::abs(aspect - 1.0f) > kSquare)
            add(place.line, kScreenKey,
                fmt::format("{}: its pixels are not square: {:.2f} times as wide as high "
                            "({:.0f} x {:.0f} pixels on {:.2f} x {:.2f} m)",
                            name_of(place), aspect, pixels_of(place).x, pixels_of(place).y, size.x,
                            size.y),
                false);
    }

    void pair(const PlacedViewport& a, const PlacedViewport& b) {
        if (&a.window == &b.window) {
            const glm::vec2 low = glm::max(a.viewport.position, b.viewport.position);
            const glm::vec2 high = glm::min(a.viewport.position + a.viewport.size,
                                            b.viewport.position + b.viewport.size);
            const glm::vec2 overlap = (high - low) * glm::vec2(a.window.size);
            if (std::min(overlap.x, overlap.y) > 0.5f)
                add(b.line, "windows.viewports",
                    fmt::format("{} overlaps another of the window's viewports by {:.0f} x {:.0f} "
                                "pixels",
                                name_of(b), overlap.x, overlap.y));
        }
        if (a.viewport.screen.carried_by_head || b.viewport.screen.carried_by_head)
            return;
        if (same_place(a.viewport.screen, b.viewport.screen))
            twins(a, b);
        else
            seam(a, b);
    }

    /// Checks two viewports on one wall, such as two projectors that show one eye each.
    void twins(const PlacedViewport& a, const PlacedViewport& b) {
        using stereo::StereoMode;
        const StereoMode first = a.window.stereo, second = b.window.stereo;
        const bool one_eye = first == StereoMode::left || first == StereoMode::right;
        if (one_eye && first == second)
            add(b.line, "windows.stereo",
                fmt::format("{} and {} have the same corners, and both show the {} eye", name_of(a),
                            name_of(b), stereo::name_of(first)));
        else if (!one_eye || (second != StereoMode::left && second != StereoMode::right))
            add(b.line, kScreenKey,
                fmt::format("{} has the same corners as {}", name_of(b), name_of(a)), false);
    }

    /// Looks for a gap wider than a seam, and than the frames of both, where walls meet.
    void seam(const PlacedViewport& a, const PlacedViewport& b) {
        const interaction::Pose anywhere;
        const float frames = a.viewport.screen.bezel + b.viewport.screen.bezel;
        // At a corner of four displays, those on the diagonal are farther apart.
        const float allowed = kSeam + std::sqrt(2.0f) * frames;
        float widest = 0;
        for (const glm::vec3& p : corners_in_room(a.viewport.screen, anywhere, a.window.size))
            for (const glm::vec3& q : corners_in_room(b.viewport.screen, anywhere, b.window.size))
                if (glm::distance(p, q) < kNeighbors)
                    widest = std::max(widest, glm::distance(p, q));
        if (widest > allowed)
            gaps_.push_back(
                {&a.viewport.screen, &b.viewport.screen, name_of(a), name_of(b), b.line, widest});
    }

    void windows() {
        const auto& windows = config_.installation.windows;
        for (std::size_t i = 0; i < windows.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const int line = windows[i].line.number;
                if (windows[i].fullscreen && windows[j].fullscreen &&
                    windows[i].monitor != stereo::kNextMonitor &&
                    windows[i].monitor == windows[j].monitor && windows[i].node == windows[j].node)
                    add(line, "windows.monitor",
                        fmt::format("window {} covers monitor {}, as window {} does",
                                    windows[i].name, windows[i].monitor, windows[j].name));
                const glm::ivec2 shared = shared_pixels(windows[i], windows[j]);
                if (shared.x > 0 && shared.y > 0)
                    add(line, "windows.position",
                        fmt::format("window {} covers {} x {} pixels of window {}", windows[i].name,
                                    shared.x, shared.y, windows[j].name),
                        false);
            }
    }

    void viewers(const std::vector<PlacedViewport>& all) {
        const auto& viewers = config_.installation.viewers;
        for (std::size_t i = 0; i < viewers.size(); ++i) {
            if (std::ranges::none_of(
                    all, [&](const PlacedViewport& place) { return place.viewport.viewer == i; }))
                add(viewers[i].line.number, "viewers",
                    fmt::format("no viewport is for viewer {}", viewers[i].name), false);
            for (std::size_t j = 0; j < i; ++j)
                if (viewers[i].head == viewers[j].head)
                    add(viewers[i].line.number, "viewers.head",
                        fmt::format("device {} tracks viewer {} and viewer {}", viewers[i].head,
                                    viewers[j].name, viewers[i].name));
        }
    }

    const Config& config_;
    Findings& findings_;
    std::vector<ScreenGap> gaps_;
};

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

std::vector<PlacedViewport> viewports_of(const Config& config) {
    std::vector<PlacedViewport> all;
    for (const stereo::Window& window : config.installation.windows)
        for (std::size_t i = 0; i < window.viewports.size(); ++i)
            all.push_back({window, window.viewports[i], i + 1});
    return all;
}

std::vector<ConfigProblem> problems_of(const Config& config) {
    Findings findings;
    Judge(config, findings).judge();
    check_measures(config, findings);
    check_devices(config, findings);
    return std::move(findings.found);
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
    for (const PlacedViewport& place : viewports_of(config)) {
        const stereo::Window& window = place.window;
        if (&window != last)
            text +=
                SafeText("window {}: {} x {} pixels, {}, {}\n", window.name, window.size.x,
                         window.size.y, place_on_desktop(window), stereo::name_of(window.stereo));
        last = &window;
        text += describe_viewport(place, installation.viewers[place.viewport.viewer]);
    }
    text += describe_nodes(installation);
    for (const std::string& line : describe_devices(config))
        text += SafeText("devices: {}\n", line);
    return text.str();
}

void check_config(const std::filesystem::path& path) {
    const Config config = read_config(path);
    print_safely(SafeText::lines(describe(config)));
    const std::vector<ConfigProblem> problems = problems_of(config);
    for (const ConfigProblem& problem : problems)
        print_safely("{}\n", line_of(problem, config));
    for (const std::string& warning : device_warnings(config))
        print_safely("{}: warning: {}\n", path.string(), warning);
    std::fflush(stdout); // before the error
    expect_sound(config);
    print_safely("nothing is wrong\n");
}

} // namespace isochron::app
