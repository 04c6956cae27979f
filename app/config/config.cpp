// Reading of the TOML configuration: the only file that knows its keys.
#include "app/config/config.h"

#include "app/config/look_config.h"
#include "app/config/shipped_configs.h"
#include "app/config/toml_reader.h"
#include "app/text.h"
#include "index/error.h"
#include "index/system/input_file.h"
#include "render/passes/color_map.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <system_error>
#include <utility>

namespace isochron::app {
namespace {

using interaction::QualityMode;

constexpr std::uint64_t kMostBytes = 16 << 20; ///< largest configuration file
constexpr const char* kAnyFootprint = "auto";
constexpr std::array kSettledFootprints{render::Footprint::gaussian, render::Footprint::mesh,
                                        render::Footprint::surface};
constexpr std::array kCellShapes{render::CellShape::plane, render::CellShape::voxel};

void read_emulation(TomlReader& reader, interaction::EmulationOptions& emulation) {
    reader.number("walk_speed", 0.01, 100.0, emulation.walk_speed);
    reader.number("look_speed", 0.01, 100.0, emulation.look_speed);
    reader.number("wand_reach", 0.05, 5.0, emulation.wand_reach);
}

void read_quality(TomlReader& reader, Config& config) {
    reader.word("mode", interaction::all_names<QualityMode>(), [&](const std::string& word) {
        config.quality.mode = quality_mode_from_name(word);
    });
    reader.word("settled", settled_footprint_names(), [&](const std::string& word) {
        config.quality.settled = settled_footprint_from_name(word);
    });
    reader.number("frame_budget_ms", 0.0, 1000.0, config.quality.frame_budget_ms);
    reader.number("longest_ms", 0.0, 1000.0, config.quality.longest_ms);
    reader.number("least_resolution", 0.35, 1.0, config.quality.least_resolution);
    reader.number("still_budget_ms", 0.0, 10000.0, config.quality.still_budget_ms);
    reader.number("still_linear", 0.0, 10.0, config.quality.stillness.linear);
    reader.number("still_angular", 0.0, 10.0, config.quality.stillness.angular);
    reader.number("leave_factor", 1.0, 100.0, config.quality.stillness.leave_factor);
    double settle_ms = config.quality.stillness.settle.count() * 1e3;
    reader.number("settle_ms", 0.0, 10000.0, settle_ms);
    config.quality.stillness.settle = interaction::Seconds(settle_ms / 1e3);
}

void read_surface(TomlReader& reader, std::vector<ConfiguredSurface>& surfaces) {
    const auto& palette = render::surface_palette();
    ConfiguredSurface& surface = surfaces.emplace_back(
        ConfiguredSurface{std::nullopt, kFirstQuantile, palette[surfaces.size() % palette.size()]});
    double isovalue = 0;
    constexpr double kMost = std::numeric_limits<double>::max();
    reader.number("isovalue", -kMost, kMost, isovalue);
    if (reader.has("isovalue") && reader.has("quantile"))
        reader.fail("quantile", "a surface has either an isovalue or a quantile");
    if (reader.has("isovalue"))
        surface.isovalue = isovalue;
    reader.number("quantile", 0.0, 1.0, surface.quantile);
    reader.color("color", surface.color);
    reader.number("opacity", 0.0, 1.0, surface.opacity);
}

void read_surfaces(TomlReader& reader, Config& config) {
    reader.tables("surfaces", [&](TomlReader& inner) { read_surface(inner, config.surfaces); });
    if (config.surfaces.size() > interaction::kMostIsosurfaces)
        reader.fail("surfaces", fmt::format("expected at most {}, got {}",
                                            interaction::kMostIsosurfaces, config.surfaces.size()));
}

void read_lighting(TomlReader& reader, render::CellAppearance& look) {
    constexpr double kBrightest = 4.0;
    reader.number("ambient", 0.0, kBrightest, look.ambient);
    reader.number("head_light", 0.0, kBrightest, look.head_light);
    reader.number("key_light", 0.0, kBrightest, look.key_light);
    reader.vector("key_direction", look.key_direction);
    if (glm::length(look.key_direction) < 1e-6f)
        reader.fail("key_direction", "expected a direction towards the light, got 0 0 0");
    reader.number("ground", 0.0, 1.0, look.ground);
    reader.number("reflectance", 0.0, 1.0, look.reflectance);
    reader.number("shininess", 1.0, 1000.0, look.shininess);
    reader.number("outline", 0.0, 1.0, look.outline);
    reader.number("depth_cue", 0.0, 1.0, look.depth_cue);
}

void read_rendering(TomlReader& reader, Config& config) {
    reader.word("shape", cell_shape_names(), [&](const std::string& word) {
        config.rendering.cell_shape = cell_shape_from_name(word);
    });
    reader.word("context", {"glfw", "egl", "osmesa"}, [&](const std::string& word) {
        config.rendering.context = *stereo::context_kind_from_name(word);
    });
    reader.flag("vsync", config.rendering.vsync);
    reader.number("frame_rate_limit", 1.0, 1000.0, config.rendering.frame_rate_limit);
    reader.integer("upload_kilobytes_per_frame", 16, 1 << 20,
                   config.rendering.upload_kilobytes_per_frame);
    reader.number("near", 1e-3, 10.0, config.installation.near_plane);
    reader.number("far", 1.0, 1e5, config.installation.far_plane);
    reader.color("background", config.rendering.background);
    reader.color("surface_color", config.rendering.surface_color);
    reader.integer("samples", 0, 64, config.rendering.samples);
    reader.integer("picture_samples", 0, 64, config.pictures.samples);
    reader.word("blending", {"auto", "linear", "display"}, [&](const std::string& word) {
        config.rendering.blending = word == "auto"     ? Blending::automatic
                                    : word == "linear" ? Blending::linear
                                                       : Blending::display;
    });
    reader.word("drawn_by", {"auto", "gpu", "processor"}, [&](const std::string& word) {
        config.rendering.drawn_by = word == "auto"  ? render::DrawnBy::automatic
                                    : word == "gpu" ? render::DrawnBy::gpu
                                                    : render::DrawnBy::processor;
    });
    reader.flag("level_of_detail", config.rendering.level_of_detail);
    reader.flag("bounding_box", config.rendering.bounding_box);
    reader.flag("wand_ray", config.rendering.wand_ray);
    reader.flag("picture_ray", config.pictures.ray);
    reader.flag("picture_caption", config.pictures.caption);
}

void read_placement(TomlReader& reader, PlacementOptions& placement) {
    reader.number("size", 0.01, 100.0, placement.size);
    reader.number("height", -100.0, 100.0, placement.height);
    reader.number("distance", -100.0, 100.0, placement.distance);
    reader.number("fill", 0.0, 1.0, placement.fill);
}

void read_time(TomlReader& reader, std::optional<interaction::BetweenSteps>& between) {
    reader.word("between", {"auto", "hold", "blend"}, [&](const std::string& word) {
        between = interaction::value_named<interaction::BetweenSteps>(word); // none is `auto`
    });
}

void read_root(TomlReader& reader, Config& config) {
    int version = 1;
    reader.integer("version", 1, 1, version);
    config.places = read_displays(reader, config.installation);
    config.emulation.head.position = config.installation.viewers.front().position;
    reader.table("emulation", [&](TomlReader& inner) { read_emulation(inner, config.emulation); });
    read_devices(reader, config.devices, config.emulation);
    read_panel(reader, config.panel);
    read_cluster(reader, config.cluster);
    reader.table("openxr", [&](TomlReader& inner) { read_openxr(inner, config.openxr); });
    read_comfort(reader, config.comfort, config.grid);
    reader.table("quality", [&](TomlReader& inner) { read_quality(inner, config); });
    reader.table("rendering", [&](TomlReader& inner) { read_rendering(inner, config); });
    reader.table("lighting",
                 [&](TomlReader& inner) { read_lighting(inner, config.rendering.appearance); });
    reader.table("coloring", [&](TomlReader& inner) {
        read_coloring(inner, config.name, config.coloring, config.color_maps);
    });
    reader.table("look", [&](TomlReader& inner) { read_look(inner, config.look); });
    reader.table("time", [&](TomlReader& inner) { read_time(inner, config.between); });
    read_surfaces(reader, config);
    reader.table("memory", [&](TomlReader& inner) {
        inner.integer("cache_megabytes", 0, 1 << 24, config.memory.cache_megabytes);
        inner.integer("mesh_megabytes", 0, 1 << 16, config.memory.mesh_megabytes);
        inner.integer("most_cells", 20'000, 500'000'000, config.memory.most_cells);
    });
    reader.table("placement", [&](TomlReader& inner) { read_placement(inner, config.placement); });
}

} // namespace

QualityMode quality_mode_from_name(const std::string& name) {
    if (const auto mode = interaction::value_named<QualityMode>(name))
        return *mode;
    throw ConfigError(
        fmt::format("unknown quality mode '{}', expected auto, fast, quality or paper", name));
}

std::optional<render::Footprint> settled_footprint_from_name(const std::string& name) {
    for (const render::Footprint footprint : kSettledFootprints)
        if (name == render::name_of(footprint))
            return footprint;
    if (name == kAnyFootprint)
        return std::nullopt;
    throw ConfigError(
        fmt::format("unknown footprint '{}', expected auto, gaussian, mesh or surface", name));
}

std::vector<std::string> settled_footprint_names() {
    std::vector<std::string> names{kAnyFootprint};
    for (const render::Footprint footprint : kSettledFootprints)
        names.emplace_back(render::name_of(footprint));
    return names;
}

render::CellShape cell_shape_from_name(const std::string& name) {
    for (const render::CellShape shape : kCellShapes)
        if (name == render::name_of(shape))
            return shape;
    throw ConfigError(fmt::format("unknown shape '{}', expected plane or voxel", name));
}

std::vector<std::string> cell_shape_names() {
    std::vector<std::string> names;
    for (const render::CellShape shape : kCellShapes)
        names.emplace_back(render::name_of(shape));
    return names;
}

std::vector<std::string> stereo_mode_names() {
    std::vector<std::string> names;
    for (const std::string_view word : stereo::stereo_mode_words())
        names.emplace_back(word);
    return names;
}

interaction::EmulationOptions emulation_for(const Config& config) {
    interaction::EmulationOptions options = config.emulation;
    const stereo::Window& window = config.installation.windows.front();
    options.vertical_fov =
        stereo::vertical_field_of_view(window.viewports.front().screen, options.head);
    return options;
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
        throw ConfigError(one_line(
            fmt::format("{}:{}: {}", name, error.source().begin.line, error.description())));
    }
    return config;
}

std::string config_schema() {
    TableSchema schema;
    TomlReader reader(schema);
    Config defaults;
    read_root(reader, defaults);
    return schema.text();
}

Config read_config(const std::filesystem::path& path) {
    // A shipped name means the shipped configuration, even if the working directory has such a
    // file.
    if (const auto shipped = shipped_config(path.string()))
        return parse_config(*shipped, path.string());
    std::string text;
    try {
        text = index::read_text(path, kMostBytes);
    } catch (const index::Error& error) {
        throw ConfigError(fmt::format("{}; expected a TOML file or the name of a shipped "
                                      "configuration ({})",
                                      error.what(), fmt::join(shipped_config_names(), ", ")));
    }
    return parse_config(text, path.string());
}

} // namespace isochron::app
