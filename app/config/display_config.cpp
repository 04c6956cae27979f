// Reading of viewers, windows, viewports and screens.
#include "app/config/display_config.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::app {
namespace {

constexpr int kFarthestPixel = 65536; ///< from a desktop's corner
constexpr float kFarthestEye = 0.5f;  ///< [m] from the head's origin
constexpr float kThinnest = 1e-3f;    ///< [m] a narrower screen is a mistake

void read_screen(TomlReader& reader, stereo::Screen& screen) {
    reader.vector("lower_left", screen.lower_left);
    reader.vector("upper_left", screen.upper_left);
    reader.vector("upper_right", screen.upper_right);
    reader.word("carried_by", {"room", "head"},
                [&](const std::string& word) { screen.carried_by_head = word == "head"; });
    reader.flag("fit_aspect", screen.fit_aspect);
    reader.number("bezel", 0.0, 0.5, screen.bezel);
    // If some corners are given, all must be: a missing one must not keep its default.
    const std::array kCorners{"lower_left", "upper_left", "upper_right"};
    const auto given = std::count_if(kCorners.begin(), kCorners.end(),
                                     [&](const char* corner) { return reader.has(corner); });
    for (const char* corner : kCorners)
        if (given > 0 && !reader.has(corner))
            reader.fail(corner, "missing, a screen is given by three corners");
    const float width = glm::length(screen.upper_right - screen.upper_left);
    const float height = glm::length(screen.upper_left - screen.lower_left);
    if (width < kThinnest || height < kThinnest)
        reader.fail("lower_left",
                    fmt::format("the screen is {} m wide and {} m high", width, height));
    const glm::vec3 across = (screen.upper_right - screen.upper_left) / width;
    const glm::vec3 upwards = (screen.upper_left - screen.lower_left) / height;
    if (glm::length(glm::cross(across, upwards)) < kThinnest)
        reader.fail("upper_right", "the three corners lie on one line");
}

/// @return the line of the screen
int read_viewport(TomlReader& reader, const std::vector<std::string>& viewers,
                  stereo::Viewport& viewport) {
    reader.text("name", viewport.name);
    reader.vector("position", viewport.position);
    reader.vector("size", viewport.size);
    for (int axis = 0; axis < 2; ++axis)
        if (viewport.position[axis] < 0 || viewport.size[axis] <= 0 ||
            viewport.position[axis] + viewport.size[axis] > 1.0001f)
            reader.fail("size",
                        "the viewport leaves its window (position and size are fractions, 0 to 1)");
    reader.given_word("viewer", viewers, [&](const std::string& word) {
        viewport.viewer = std::ranges::find(viewers, word) - viewers.begin();
    });
    reader.flag("upside_down", viewport.upside_down);
    int line = reader.line();
    reader.table("projection", [&](TomlReader& inner) {
        line = inner.line();
        read_screen(inner, viewport.screen);
    });
    return line;
}

DisplayPlaces::Window read_window(TomlReader& reader, const std::vector<std::string>& viewers,
                                  stereo::Window& window) {
    DisplayPlaces::Window place{reader.line(), {}};
    reader.text("name", window.name);
    reader.integers("size", 16, 16384, window.size);
    reader.integers("position", -kFarthestPixel, kFarthestPixel, window.position);
    reader.flag("fullscreen", window.fullscreen);
    reader.integer("monitor", 0, 63, window.monitor);
    reader.integer("node", 0, 255, window.node);
    reader.flag("border", window.border);
    std::vector<std::string> modes;
    for (const std::string_view word : stereo::stereo_mode_words())
        modes.emplace_back(word);
    reader.word("stereo", modes, [&](const std::string& word) {
        window.stereo = *stereo::stereo_mode_from_name(word);
    });
    std::vector<stereo::Viewport> viewports;
    if (reader.tables("viewports", [&](TomlReader& inner) {
            place.viewports.push_back(read_viewport(inner, viewers, viewports.emplace_back()));
        }))
        window.viewports = std::move(viewports);
    else
        place.viewports.push_back(place.line);
    return place;
}

/// Refuses a name that another window (or viewer) has already: messages and picture names tell them
/// apart by name.
template <typename Named>
void refuse_twin(const TomlReader& reader, const std::vector<Named>& all, const char* what) {
    const std::string& name = all.back().name;
    if (name.empty())
        reader.fail("name", fmt::format("a {} needs a name", what));
    if (std::ranges::count(all, name, &Named::name) > 1)
        reader.fail("name", fmt::format("two {}s are called '{}'", what, name));
}

void read_windows(TomlReader& reader, stereo::Installation& installation, DisplayPlaces& places) {
    std::vector<std::string> viewers;
    for (const stereo::Viewer& viewer : installation.viewers)
        viewers.push_back(viewer.name);
    std::vector<stereo::Window> windows;
    if (!reader.tables("windows", [&](TomlReader& inner) {
            stereo::Window& window = windows.emplace_back();
            if (windows.size() > 1)
                window.name = fmt::format("window {}", windows.size());
            places.windows.push_back(read_window(inner, viewers, window));
            refuse_twin(inner, windows, "window");
        }))
        places.windows.push_back({0, {0}});
    else
        installation.windows = std::move(windows);
}

/// Measured places of the eyes; what is written of one eye alone, or beside `eye_separation`, is a
/// mistake.
void read_eyes(TomlReader& reader, stereo::Viewer& viewer) {
    glm::vec3 left(0.0f), right(0.0f);
    reader.vector("left_eye", left);
    reader.vector("right_eye", right);
    const bool has_left = reader.has("left_eye"), has_right = reader.has("right_eye");
    if (!has_left && !has_right)
        return;
    if (!has_left || !has_right)
        reader.fail(has_left ? "right_eye" : "left_eye", "missing, both eyes are given or none");
    if (reader.has("eye_separation"))
        reader.fail("eye_separation", "left_eye and right_eye say how far apart the eyes are");
    for (const auto& [key, eye] : {std::pair("left_eye", left), std::pair("right_eye", right)})
        if (!(glm::length(eye) <= kFarthestEye))
            reader.fail(key,
                        fmt::format("the eye is {:.4g} m from the head, expected at most {:g}: "
                                    "meters in the frame of the head (x right, y up, z back)",
                                    glm::length(eye), kFarthestEye));
    const float apart = glm::length(right - left);
    if (!(apart <= interaction::kWidestEyes))
        reader.fail("right_eye", fmt::format("the eyes are {:.4g} m apart, expected at most {:g}",
                                             apart, interaction::kWidestEyes));
    if (left.x > right.x)
        reader.fail("left_eye", "the left eye is right of the right one: x points to the right");
    viewer.left_eye = left;
    viewer.right_eye = right;
    viewer.eye_separation = apart;
}

void read_viewer(TomlReader& reader, stereo::Viewer& viewer) {
    reader.text("name", viewer.name);
    reader.text("head", viewer.head);
    if (viewer.head.empty())
        reader.fail("head", "expected the name of the device that tracks the head");
    reader.vector("position", viewer.position);
    reader.number("eye_separation", 0.0, 0.1, viewer.eye_separation);
    read_eyes(reader, viewer);
}

void read_viewers(TomlReader& reader, stereo::Installation& installation, DisplayPlaces& places) {
    const bool one = reader.table("viewer", [&](TomlReader& inner) {
        places.viewers.push_back(inner.line());
        read_viewer(inner, installation.viewers.front());
    });
    if (one && reader.has("viewers"))
        reader.fail("viewers", "[viewer] describes the one viewer already");
    std::vector<stereo::Viewer> viewers;
    if (reader.tables("viewers", [&](TomlReader& inner) {
            places.viewers.push_back(inner.line());
            stereo::Viewer& viewer = viewers.emplace_back();
            if (viewers.size() > 1)
                viewer.name = fmt::format("viewer {}", viewers.size());
            read_viewer(inner, viewer);
            refuse_twin(inner, viewers, "viewer");
        }))
        installation.viewers = std::move(viewers);
    else if (!one)
        places.viewers.push_back(0);
}

} // namespace

DisplayPlaces read_displays(TomlReader& reader, stereo::Installation& installation) {
    DisplayPlaces places;
    read_viewers(reader, installation, places);
    read_windows(reader, installation, places);
    return places;
}

} // namespace isochron::app
