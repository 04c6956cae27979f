// Reading of the TOML configuration: the only file that knows its keys.
#include "app/config.h"

#include "app/shipped_configs.h"
#include "app/toml_reader.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

namespace isochron::app {
namespace {

using interaction::QualityMode;

const std::vector<std::pair<QualityMode, std::string>> kQualityModes{
    {QualityMode::automatic, "auto"},
    {QualityMode::fast, "fast"},
    {QualityMode::quality, "quality"}};

void read_screen(TomlReader& reader, stereo::Screen& screen) {
    reader.vector("lower_left", screen.lower_left);
    reader.vector("upper_left", screen.upper_left);
    reader.vector("upper_right", screen.upper_right);
    reader.word("carried_by", {"room", "head"},
                [&](const std::string& word) { screen.carried_by_head = word == "head"; });
    reader.flag("fit_aspect", screen.fit_aspect);
    // The corners of another screen are no substitute for one that was forgotten.
    const std::array kCorners{"lower_left", "upper_left", "upper_right"};
    const auto given = std::count_if(kCorners.begin(), kCorners.end(),
                                     [&](const char* corner) { return reader.has(corner); });
    for (const char* corner : kCorners)
        if (given > 0 && !reader.has(corner))
            reader.fail(corner, "missing, a screen is given by three corners");
    const float width = glm::length(screen.upper_right - screen.upper_left);
    const float height = glm::length(screen.upper_left - screen.lower_left);
    if (width < 1e-3f || height < 1e-3f)
        reader.fail("lower_left",
                    fmt::format("the screen is {} m wide and {} m high", width, height));
}

void read_viewport(TomlReader& reader, stereo::Viewport& viewport) {
    reader.vector("position", viewport.position);
    reader.vector("size", viewport.size);
    for (int axis = 0; axis < 2; ++axis)
        if (viewport.position[axis] < 0 || viewport.size[axis] <= 0 ||
            viewport.position[axis] + viewport.size[axis] > 1.0001f)
            reader.fail("size",
                        "the viewport leaves its window (position and size are fractions, 0 to 1)");
    reader.table("projection", [&](TomlReader& inner) { read_screen(inner, viewport.screen); });
}

void read_window(TomlReader& reader, stereo::Window& window) {
    reader.text("name", window.name);
    reader.integers("size", 16, 16384, window.size);
    reader.integers("position", -1, 65536, window.position);
    reader.flag("fullscreen", window.fullscreen);
    reader.integer("monitor", 0, 63, window.monitor);
    reader.word("stereo", stereo_mode_names(), [&](const std::string& word) {
        window.stereo = *stereo::stereo_mode_from_name(word);
    });
    std::vector<stereo::Viewport> viewports;
    if (reader.tables("viewports",
                      [&](TomlReader& inner) { read_viewport(inner, viewports.emplace_back()); }))
        window.viewports = std::move(viewports);
}

void read_windows(TomlReader& reader, stereo::Installation& installation) {
    std::vector<stereo::Window> windows;
    if (!reader.tables("windows",
                       [&](TomlReader& inner) { read_window(inner, windows.emplace_back()); }))
        return;
    if (windows.size() > 1)
        reader.fail("windows", fmt::format("expected one window, got {}", windows.size()));
    installation.windows = std::move(windows);
}

void read_viewer(TomlReader& reader, Config& config) {
    reader.number("eye_separation", 0.0, 0.1, config.installation.eye_separation);
    reader.vector("position", config.emulation.head.position);
}

void read_emulation(TomlReader& reader, interaction::EmulationOptions& emulation) {
    reader.number("walk_speed", 0.01, 100.0, emulation.walk_speed);
    reader.number("look_speed", 0.01, 100.0, emulation.look_speed);
    reader.number("wand_reach", 0.05, 5.0, emulation.wand_reach);
}

void read_quality(TomlReader& reader, Config& config) {
    reader.word("mode", quality_mode_names(),
                [&](const std::string& word) { config.quality = quality_mode_from_name(word); });
    reader.number("still_linear", 0.0, 10.0, config.stillness.linear);
    reader.number("still_angular", 0.0, 10.0, config.stillness.angular);
    reader.number("leave_factor", 1.0, 100.0, config.stillness.leave_factor);
    double settle_ms = config.stillness.settle.count() * 1e3;
    reader.number("settle_ms", 0.0, 10000.0, settle_ms);
    config.stillness.settle = interaction::Seconds(settle_ms / 1e3);
}

void read_rendering(TomlReader& reader, Config& config) {
    reader.word("context", {"glfw", "egl", "osmesa"}, [&](const std::string& word) {
        config.context = *stereo::context_kind_from_name(word);
    });
    reader.flag("vsync", config.vsync);
    reader.number("frame_rate_limit", 1.0, 1000.0, config.frame_rate_limit);
    reader.integer("upload_kilobytes_per_frame", 16, 1 << 20, config.upload_kilobytes_per_frame);
    reader.number("near", 1e-3, 10.0, config.installation.near_plane);
    reader.number("far", 1.0, 1e5, config.installation.far_plane);
    reader.vector("background", config.background);
    reader.vector("surface_colour", config.surface_colour);
    for (auto [key, colour] : {std::pair{"background", config.background},
                               std::pair{"surface_colour", config.surface_colour}})
        for (int channel = 0; channel < 3; ++channel)
            if (colour[channel] < 0 || colour[channel] > 1)
                reader.fail(key, fmt::format("expected sRGB from 0 to 1, got {}", colour[channel]));
    reader.flag("bounding_box", config.bounding_box);
    reader.flag("wand_ray", config.wand_ray);
}

void read_placement(TomlReader& reader, PlacementOptions& placement) {
    reader.number("size", 0.01, 100.0, placement.size);
    reader.number("height", -100.0, 100.0, placement.height);
    reader.number("distance", -100.0, 100.0, placement.distance);
}

void read_root(TomlReader& reader, Config& config) {
    int version = 1;
    reader.integer("version", 1, 1, version);
    reader.table("viewer", [&](TomlReader& inner) { read_viewer(inner, config); });
    read_windows(reader, config.installation);
    reader.table("emulation", [&](TomlReader& inner) { read_emulation(inner, config.emulation); });
    reader.table("quality", [&](TomlReader& inner) { read_quality(inner, config); });
    reader.table("rendering", [&](TomlReader& inner) { read_rendering(inner, config); });
    reader.table("placement", [&](TomlReader& inner) { read_placement(inner, config.placement); });
}

} // namespace

std::string name_of(QualityMode mode) {
    for (const auto& [candidate, name] : kQualityModes)
        if (candidate == mode)
            return name;
    return {};
}

QualityMode quality_mode_from_name(const std::string& name) {
    for (const auto& [mode, candidate] : kQualityModes)
        if (candidate == name)
            return mode;
    throw ConfigError(
        fmt::format("unknown quality mode '{}', expected auto, fast or quality", name));
}

std::vector<std::string> quality_mode_names() {
    std::vector<std::string> names;
    names.reserve(kQualityModes.size());
    for (const auto& row : kQualityModes)
        names.push_back(row.second);
    return names;
}

std::vector<std::string> stereo_mode_names() {
    std::vector<std::string> names;
    for (stereo::StereoMode mode : stereo::all_stereo_modes())
        names.emplace_back(stereo::name_of(mode));
    return names;
}

interaction::EmulationOptions emulation_for(const Config& config) {
    interaction::EmulationOptions options = config.emulation;
    const stereo::Screen& screen = config.installation.windows.front().viewports.front().screen;
    const float height = glm::length(screen.upper_left - screen.lower_left);
    // A carried screen is given in the head's frame already.
    const float head_z = screen.carried_by_head ? 0.0f : options.head.position.z;
    const float distance = std::max(0.1f, std::abs(screen.lower_left.z - head_z));
    options.vertical_fov = 2.0f * std::atan(height / (2.0f * distance));
    return options;
}

std::vector<std::string> screen_warnings(const Config& config) {
    std::vector<std::string> warnings;
    for (const stereo::Window& window : config.installation.windows)
        for (const stereo::Viewport& viewport : window.viewports)
            for (const std::string& problem :
                 stereo::problems(viewport.screen, config.emulation.head.position))
                warnings.push_back(
                    fmt::format("{}: window {}: {}", config.name, window.name, problem));
    return warnings;
}

Config parse_config(const std::string& text, const std::string& name) {
    Config config;
    config.name = name;
    config.text = text;
    try {
        const toml::table table = toml::parse(text, name);
        TomlReader reader(table, name, "");
        read_root(reader, config);
        reader.finish();
    } catch (const toml::parse_error& error) {
        throw ConfigError(
            fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
    }
    return config;
}

Config read_config(const std::filesystem::path& path) {
    if (const auto shipped = shipped_config(path.string());
        shipped && !std::filesystem::exists(path))
        return parse_config(*shipped, path.string());
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path))
        throw ConfigError(fmt::format("{}: cannot be read, expected a TOML file or the name of a "
                                      "shipped configuration (desktop, headless)",
                                      path.string()));
    return parse_config({std::istreambuf_iterator<char>(file), {}}, path.string());
}

} // namespace isochron::app
