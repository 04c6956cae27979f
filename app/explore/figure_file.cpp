// Reads the description of a figure.
#include "app/explore/figure_file.h"

#include "app/config/config_problem.h"
#include "app/config/toml_table.h"
#include "app/explore/story_file.h"
#include "app/kept/session_file.h"
#include "index/system/input_file.h"
#include "interaction/command_fields.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint64_t kMostFigureBytes = 1 << 20, kMostReferred = 1 << 26;

double number_in(TomlTable& table, const char* key, double usual, double low, double high) {
    const toml::node* const node = table.take(key);
    if (!node)
        return usual;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !(*value >= low && *value <= high))
        table.fail(key, fmt::format("expected a number from {:g} to {:g}{}", low, high,
                                    value ? fmt::format(", got {:g}", *value)
                                          : ", got " + type_name(*node)));
    return *value;
}

std::size_t whole_in(TomlTable& table, const char* key, std::size_t usual, std::size_t most) {
    const double value =
        number_in(table, key, static_cast<double>(usual), 1, static_cast<double>(most));
    if (value != std::floor(value) && table.has(key))
        table.fail(key, fmt::format("expected a whole number, got {:g}", value));
    return static_cast<std::size_t>(value);
}

std::optional<std::string> text_in(TomlTable& table, const char* key) {
    const toml::node* const node = table.take(key);
    if (!node)
        return std::nullopt;
    const auto value = node->value<std::string>();
    if (!node->is_string() || !value)
        table.fail(key, fmt::format("expected a string, got {}", type_name(*node)));
    return value;
}

bool switch_in(TomlTable& table, const char* key, bool usual) {
    const toml::node* const node = table.take(key);
    if (node && !node->is_boolean())
        table.fail(key, fmt::format("expected true or false, got {}", type_name(*node)));
    return node ? node->value<bool>().value_or(usual) : usual;
}

/// Members that a table of a setting leaves out are as they are at first.
json with_defaults(const std::string& key, json value) {
    interaction::KeyFrame usual;
    usual.coloring.emplace();
    usual.look.emplace();
    usual.clip.emplace();
    usual.isosurfaces.emplace(1);
    interaction::Commands commands;
    commands.keys = {usual};
    const json all = interaction::commands_json(commands).at("keys").at(0);
    if (value.is_object() && all.contains(key)) {
        json whole = all.at(key);
        whole.merge_patch(value);
        return whole;
    }
    if (key == "isosurfaces" && value.is_array())
        for (json& one : value)
            if (one.is_object()) {
                json whole = all.at(key).at(0);
                whole.merge_patch(one);
                one = whole;
            }
    return value;
}

/// Reads panels, one after the other.
class PanelReader {
  public:
    PanelReader(FigureFile& figure, fs::path name) : figure_(figure), name_(std::move(name)) {}

    FigurePanel read(TomlTable& table, const toml::table& plain) {
        FigurePanel panel;
        panel.line = static_cast<int>(plain.source().begin.line);
        const auto index = text_in(table, "index");
        if (!index)
            table.fail("index", "a panel needs an index: index = \"run42.isochron\"");
        panel.index = *index;
        panel.title = text_in(table, "title");
        panel.aspect = number_in(table, "aspect", panel.aspect, 0.1, 10);
        panel.turn = glm::radians(number_in(table, "turn", 0, -360, 360));
        panel.tilt = glm::radians(number_in(table, "tilt", 0, -90, 90));
        panel.zoom = number_in(table, "zoom", 1, 0.01, 100);
        panel.legend = switch_in(table, "legend", panel.legend);
        panel.scale_bar = switch_in(table, "scale_bar", panel.scale_bar);
        panel.axes = switch_in(table, "axes", panel.axes);
        refer(table, panel);
        settings(table, plain, panel);
        table.finish();
        return panel;
    }

  private:
    /// The session, and the key of it or of a file of keys.
    void refer(TomlTable& table, FigurePanel& panel) {
        const auto session = text_in(table, "session"), keys = text_in(table, "keys");
        const bool numbered = table.has("key");
        const std::size_t number = whole_in(table, "key", 1, interaction::kMostKeyFrames);
        if (session)
            panel.state = session_in(text_of_file(*session), in_folder(*session)).state;
        if (!keys && !(numbered && session)) {
            if (numbered)
                table.fail("key", "a key of what? expected keys = \"keys.json\", or a session");
            return;
        }
        const std::string& from = keys ? *keys : *session;
        const auto all = keys_in(text_of_file(from), in_folder(from));
        if (number > all.size())
            table.fail("key", fmt::format("expected 1 to {}, got {}", all.size(), number));
        panel.key = all[number - 1];
    }

    void settings(TomlTable& table, const toml::table& plain, FigurePanel& panel) {
        json key{{"time", 0}};
        for (const auto& [name, node] : plain) {
            const std::string word(name.str());
            if (is_own(word))
                continue;
            table.take(word);
            std::ostringstream text;
            text << toml::json_formatter(toml::table{{"value", node}});
            key[word] = with_defaults(word, json::parse(text.str(), nullptr, false)["value"]);
        }
        try {
            const interaction::KeyFrame shown =
                interaction::commands_from({{"keys", json::array({key})}}, "panel").keys->front();
            merge(panel.key, shown);
        } catch (const interaction::Error& error) {
            throw ConfigError("{}:{}: {}", name_.string(), panel.line, error.what());
        }
    }

    static bool is_own(const std::string& word) {
        constexpr std::array kOwn{"index",  "title",     "aspect", "turn",    "tilt", "zoom",
                                  "legend", "scale_bar", "axes",   "session", "keys", "key"};
        return std::ranges::find(kOwn, word) != kOwn.end();
    }

    /// What `later` holds.
    static void merge(interaction::KeyFrame& into, const interaction::KeyFrame& later) {
        interaction::each_field(
            [](const interaction::Field&, auto& member, const auto& other) {
                if constexpr (requires { other.has_value(); })
                    if (other)
                        member = other;
            },
            into, later);
        if (later.step)
            into.fraction = later.fraction;
        if (later.isovalue && !later.isosurfaces && into.isosurfaces && !into.picked)
            into.picked = 0;
    }

    std::string in_folder(const std::string& file) const {
        return (name_.parent_path() / file).string();
    }
    const std::string& text_of_file(const std::string& file) {
        const auto [at, is_new] = figure_.texts.try_emplace(file);
        if (is_new)
            at->second = index::read_text(in_folder(file), kMostReferred);
        return at->second;
    }

    FigureFile& figure_;
    const fs::path name_;
};

} // namespace

FigureFile parse_figure(const std::string& text, const fs::path& name,
                        std::map<std::string, std::string> texts) {
    toml::table parsed;
    try {
        parsed = toml::parse(text);
    } catch (const toml::parse_error& mistake) {
        throw ConfigError("{}:{}: {}", name.string(), mistake.source().begin.line,
                          mistake.description());
    }
    FigureFile figure;
    figure.text = text;
    figure.texts = std::move(texts);
    TomlTable table(parsed, name.string(), "");
    whole_in(table, "version", 1, 1);
    figure.width = number_in(table, "width", figure.width, 20, 1200);
    figure.dpi = number_in(table, "dpi", figure.dpi, 30, 2400);
    figure.font_size = number_in(table, "font_size", figure.font_size, 3, 72);
    figure.margin = number_in(table, "margin", figure.margin, 0, 50);
    figure.gap = number_in(table, "gap", figure.gap, 0, 50);
    figure.letters = text_in(table, "letters").value_or(figure.letters);
    if (figure.letters != "a" && figure.letters != "A" && figure.letters != "(a)" &&
        figure.letters != "none")
        table.fail("letters",
                   fmt::format("expected one of a, A, (a), none, got {}", figure.letters));
    figure.caption = text_in(table, "caption").value_or("");
    if (table.has("columns"))
        figure.columns = whole_in(table, "columns", 1, kMostPanels);
    const toml::node* const panels = table.take("panels");
    const toml::array* const list = panels ? panels->as_array() : nullptr;
    if (!list || list->empty() || list->size() > kMostPanels)
        table.fail("panels", fmt::format("expected 1 to {} tables [[panels]], got {}", kMostPanels,
                                         list ? std::to_string(list->size()) : "none"));
    PanelReader reader(figure, name);
    for (const toml::node& node : *list) {
        TomlTable panel = table.item("panels", node);
        figure.panels.push_back(reader.read(panel, *node.as_table()));
    }
    table.finish();
    if (figure.columns == 0)
        figure.columns = figure.panels.size() == 1 ? 1 : 2;
    return figure;
}

FigureFile read_figure(const fs::path& file) {
    return parse_figure(index::read_text(file, kMostFigureBytes), file);
}

} // namespace isochron::app
