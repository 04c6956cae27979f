// Reading of the tables about colors and the look of the picture.
#include "app/config/look_config.h"

#include "render/passes/color_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace isochron::app {
namespace {

std::vector<LoadedColorMap> maps_of(const TomlReader& reader, const std::filesystem::path& path) {
    try {
        return read_color_maps(path);
    } catch (const ConfigError& error) {
        reader.fail("file", error.what());
    }
    return {};
}

} // namespace

void read_coloring(TomlReader& reader, const std::string& name, interaction::Coloring& coloring,
                   std::vector<LoadedColorMap>& color_maps) {
    reader.word("by", interaction::all_names<interaction::ColorBy>(), [&](const std::string& word) {
        coloring.by = *interaction::value_named<interaction::ColorBy>(word);
    });
    reader.word("map", {render::kColorMapNames.begin(), render::kColorMapNames.end()},
                [&](const std::string& word) { coloring.map = word; });
    std::string file;
    reader.text("file", file);
    if (reader.has("file"))
        color_maps = maps_of(reader, std::filesystem::path(name).parent_path() / file);
    std::vector<std::string> loaded;
    for (const LoadedColorMap& map : color_maps)
        loaded.push_back(map.name);
    if (reader.has("file_map") && !reader.has("file"))
        reader.fail("file_map", "a map of a file needs the file");
    reader.given_word("file_map", loaded, [&](const std::string& word) {
        coloring.map = word;
        coloring.colors = std::ranges::find(color_maps, word, &LoadedColorMap::name)->colors;
    });
    reader.text("array", coloring.array);
    reader.flag("reversed", coloring.reversed);
    int bands = static_cast<int>(coloring.bands);
    reader.integer("bands", 0, static_cast<int>(interaction::kMostBands), bands);
    coloring.bands = static_cast<std::uint32_t>(bands);
    reader.flag("logarithmic", coloring.logarithmic);
    glm::dvec2 ends(0.0);
    reader.vector("percentiles", ends);
    if (reader.has("percentiles")) {
        if (reader.has("range"))
            reader.fail("percentiles", "expected range or percentiles, got both");
        if (!(0 <= ends.x && ends.x < ends.y && ends.y <= 100))
            reader.fail("percentiles",
                        fmt::format("expected two ascending numbers from 0 to 100, got {} and {}",
                                    ends.x, ends.y));
        coloring.percentiles = {ends.x, ends.y};
    }
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
