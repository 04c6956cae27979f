// What is refused of colors and light, and what one part of a file says of another.
#include "app/config/color_map_file.h"
#include "app/config/config_checks.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>
#include <ranges>

namespace isochron::app {
namespace {

/// Takes the map that a file of color maps has under the name `coloring.file_map`.
void take_maps(const TomlTable& at, Config& config) {
    const std::string& name = config.color_map_of_file;
    if (at.has("file"))
        try {
            config.color_maps = read_color_maps(std::filesystem::path(config.name).parent_path() /
                                                config.color_map_file);
        } catch (const ConfigError& error) {
            at.fail("file", error.what());
        }
    if (!at.has("file_map"))
        return;
    if (!at.has("file"))
        at.fail("file_map", "a map of a file needs the file");
    const auto map = std::ranges::find(config.color_maps, name, &LoadedColorMap::name);
    if (map == config.color_maps.end())
        at.fail("file_map", fmt::format("unknown value '{}', expected one of {}", name,
                                        fmt::join(config.color_maps |
                                                      std::views::transform(&LoadedColorMap::name),
                                                  ", ")));
    config.start.coloring.map = name;
    config.start.coloring.colors = map->colors;
}

} // namespace

void begin(const Config&, std::vector<ConfiguredSurface>& all) {
    const auto& palette = render::surface_palette();
    all.back().color = palette[(all.size() - 1) % palette.size()];
}

void check(const TomlTable& at, const Config&, ConfiguredSurface&) {
    if (at.has("isovalue") && at.has("quantile"))
        at.fail("quantile", "a surface has either an isovalue or a quantile");
}

void check(const TomlTable& at, const Config&, interaction::Coloring& coloring) {
    if (coloring.range && coloring.percentiles)
        at.fail("percentiles", "expected range or percentiles, got both");
    if (coloring.range && coloring.logarithmic && !(coloring.range->front() > 0))
        at.fail("range",
                fmt::format("a logarithmic range is above 0, got {}", coloring.range->front()));
}

void check(const TomlTable& at, const Config&, Config& config) {
    config.emulation.head.position = config.installation.viewers.front().position;
    const glm::vec2 near = config.comfort.near_fade;
    if (at.has("comfort.near_fade") && !(near.x >= 0 && near.x < near.y && near.y <= 10))
        at.fail("comfort.near_fade",
                fmt::format("expected two ascending distances from 0 to 10 m, got {} and {}",
                            near.x, near.y));
    if (glm::length(config.rendering.appearance.key_direction) < 1e-6f)
        at.fail("lighting.key_direction", "expected a direction towards the light, got 0 0 0");
    if (config.surfaces.size() > interaction::kMostIsosurfaces)
        at.fail("surfaces", fmt::format("expected at most {}, got {}",
                                        interaction::kMostIsosurfaces, config.surfaces.size()));
    take_maps(at.within("coloring"), config);
}

} // namespace isochron::app
