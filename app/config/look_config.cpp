// Reading of the tables about colors and the look of the picture.
#include "app/config/look_config.h"

#include "render/passes/color_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace isochron::app {
namespace {

std::vector<std::string> map_names(const std::vector<LoadedColorMap>& loaded) {
    std::vector<std::string> names{render::kColorMapNames.begin(), render::kColorMapNames.end()};
    for (const LoadedColorMap& map : loaded)
        names.push_back(map.name);
    const auto old = render::old_color_map_names();
    names.insert(names.end(), old.begin(), old.end());
    return names;
}

void read_maps(TomlReader& reader, Config& config) {
    std::string file;
    reader.text("file", file);
    if (!reader.has("file"))
        return;
    const auto folder = std::filesystem::path(config.name).parent_path();
    try {
        config.color_maps = read_color_maps(folder / file);
    } catch (const ConfigError& error) {
        reader.fail("file", error.what());
    }
}

} // namespace

void read_coloring(TomlReader& reader, Config& config) {
    interaction::Coloring& coloring = config.coloring;
    reader.word("by", interaction::all_names<interaction::ColorBy>(), [&](const std::string& word) {
        coloring.by = *interaction::value_named<interaction::ColorBy>(word);
    });
    read_maps(reader, config);
    reader.given_word("map", map_names(config.color_maps), [&](const std::string& word) {
        coloring.map = word;
        const auto loaded = std::ranges::find(config.color_maps, word, &LoadedColorMap::name);
        if (loaded != config.color_maps.end())
            coloring.colors = loaded->colors;
    });
    reader.flag("reversed", coloring.reversed);
    int bands = static_cast<int>(coloring.bands);
    reader.integer("bands", 0, static_cast<int>(interaction::kMostBands), bands);
    coloring.bands = static_cast<std::uint32_t>(bands);
    reader.flag("logarithmic", coloring.logarithmic);
    glm::dvec2 range(0.0);
    reader.vector("range", range);
    if (!reader.has("range"))
        return;
    if (!(range.x < range.y))
        reader.fail("range",
                    fmt::format("expected two ascending numbers, got {} and {}", range.x, range.y));
    if (coloring.logarithmic && !(range.x > 0))
        reader.fail("range", fmt::format("a logarithmic range is above 0, got {}", range.x));
    coloring.range = {range.x, range.y};
}

void read_look(TomlReader& reader, interaction::Look& look) {
    reader.word("background", interaction::all_names<interaction::Background>(),
                [&](const std::string& word) {
                    look.background = *interaction::value_named<interaction::Background>(word);
                });
    reader.word("material", interaction::all_names<interaction::Material>(),
                [&](const std::string& word) {
                    look.material = *interaction::value_named<interaction::Material>(word);
                });
    reader.number("occlusion", 0.0, 1.0, look.occlusion);
}

} // namespace isochron::app
