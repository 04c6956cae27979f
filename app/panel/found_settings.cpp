// Lists the values of the panel's settings, and picks those that have the words of a search.
#include "app/panel/found_settings.h"

#include "app/panel/parts/color_section.h"
#include "app/panel/parts/sections.h"
#include "app/text.h"

#include <fmt/format.h>

#include <type_traits>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Coloring;
using interaction::Commands;
using interaction::Look;

/// Lines that are found, in the order in which they are added.
class Found {
  public:
    explicit Found(std::string_view words) : words_(words) {}
    void add(std::string line, Commands commands) {
        if (has_words(line, words_))
            lines_.push_back({std::move(line), std::move(commands)});
    }
    std::vector<FoundSetting> take() { return std::move(lines_); }

  private:
    std::string_view words_;
    std::vector<FoundSetting> lines_;
};

void add_look(const Look& look, Found& found) {
    const auto add = [&](std::string line, const Look& changed) {
        Commands commands;
        commands.look = changed;
        if (changed != look)
            found.add(std::move(line), std::move(commands));
    };
    const auto add_each = [&](const char* setting, auto Look::* member) {
        using Value = std::decay_t<decltype(look.*member)>;
        const std::vector<std::string> names = interaction::all_names<Value>();
        for (std::size_t i = 0; i < names.size(); ++i) {
            Look changed = look;
            changed.*member = static_cast<Value>(i);
            add(fmt::format("{}: {}", setting, names[i]), changed);
        }
    };
    add_each("background", &Look::background);
    add_each("material", &Look::material);
    Look changed = look;
    changed.light.reset();
    add("light: from where it usually comes", changed);
    changed = look;
    changed.occlusion = 0.0f;
    add("ambient occlusion: none", changed);
    changed.occlusion = Look{}.occlusion;
    add("ambient occlusion: as usual", changed);
}

void add_coloring(const PanelModel& model, Found& found) {
    const Coloring& now = model.asked.coloring;
    const auto add = [&](std::string line, Coloring changed) {
        Commands commands;
        commands.coloring = changed;
        if (changed != now)
            found.add(std::move(line), std::move(commands));
    };
    const auto by = [&](interaction::ColorBy what, std::string array) {
        Coloring changed = now;
        if (changed.by != what || changed.array != array)
            changed.range.reset();
        changed.by = what;
        changed.array = std::move(array);
        return changed;
    };
    add("color by: surface", by(interaction::ColorBy::surface, now.array));
    const bool has_values = now.by == interaction::ColorBy::value;
    for (std::size_t i = 0; i < model.arrays.color_names.size(); ++i)
        if (const std::string& array = model.arrays.color_names[i];
            !has_values || i != model.arrays.color)
            add(fmt::format("color by: array {}", array), by(interaction::ColorBy::value, array));
    add("color by: first crossing", by(interaction::ColorBy::first_crossing, now.array));
    for (const OfferedMap& map : offered_maps(model)) {
        Coloring changed = now;
        changed.map = map.name;
        changed.colors = map.colors;
        add(fmt::format("color map: {}", map.words), changed);
    }
    Coloring changed = now;
    changed.reversed = !now.reversed;
    add("color map: the other way around (reversed)", changed);
    changed = now;
    changed.logarithmic = !now.logarithmic;
    add(now.logarithmic ? "colors: linear scale" : "colors: logarithmic scale", changed);
}

void add_stereo(const PanelModel& model, Found& found) {
    for (const std::string& name : offered_stereo(model)) {
        Commands commands;
        commands.stereo = name;
        if (name != model.asked.stereo)
            found.add(fmt::format("stereo: {}", name), std::move(commands));
    }
}

void add_places(const PanelModel& model, Found& found) {
    for (std::size_t i = 0; i < model.arrays.names.size(); ++i)
        if (i != model.arrays.asked)
            found.add(fmt::format("array: {}", model.arrays.names[i]), model.arrays.way_to(i));
    for (const interaction::Viewpoint& each : model.asked.views) {
        Commands commands;
        commands.room_from_physical = each.room_from_physical;
        found.add(fmt::format("viewpoint: {}", each.name), std::move(commands));
    }
}

} // namespace

std::vector<FoundSetting> found_settings(std::string_view words, const PanelModel& model) {
    if (words.find_first_not_of(' ') == std::string_view::npos)
        return {};
    Found found(words);
    add_look(model.asked.look, found);
    add_coloring(model, found);
    add_places(model, found);
    add_stereo(model, found);
    return found.take();
}

} // namespace isochron::app
