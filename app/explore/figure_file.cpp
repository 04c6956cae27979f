// Reads the description of a figure.
#include "app/explore/figure_file.h"

#include "app/config/table_reader.h"
#include "app/explore/story_file.h"
#include "app/kept/session_file.h"
#include "index/system/input_file.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>
#include <utility>

namespace isochron::app {

template <class Visit, Of<FigurePanel>... P>
void each_field(Visit&& visit, P&... p) {
    visit(Field{"index"}, p.index...);
    visit(Field{"title"}, p.title...);
    visit(Field{"aspect", 0.1, 10}, p.aspect...);
    visit(in_degrees("turn", -360, 360), p.turn...);
    visit(in_degrees("tilt", -90, 90), p.tilt...);
    visit(Field{"zoom", 0.01, 100}, p.zoom...);
    visit(Field{"legend"}, p.legend...);
    visit(Field{"scale_bar"}, p.scale_bar...);
    visit(Field{"axes"}, p.axes...);
}

template <class Visit, Of<FigureFile>... F>
void each_field(Visit&& visit, F&... f) {
    visit(Field{"version", 1, 1}, f.version...);
    visit(Field{"width", 20, 1200}, f.width...);
    visit(Field{"dpi", 30, 2400}, f.dpi...);
    visit(Field{"font_size", 3, 72}, f.font_size...);
    visit(Field{"margin", 0, 50}, f.margin...);
    visit(Field{"gap", 0, 50}, f.gap...);
    visit(Field{"columns", 1, kMostPanels}, f.columns...);
    visit(Field{"letters"}, f.letters...);
    visit(Field{"caption"}, f.caption...);
}

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint64_t kMostFigureBytes = 1 << 20, kMostReferred = 1 << 26;

/// What a panel begins with: a session, a file of keys, and the number of a key in either.
struct Referred {
    std::optional<std::string> session, keys;
    std::optional<unsigned> key;
};

template <class Visit, Of<Referred>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"session"}, r.session...);
    visit(Field{"keys"}, r.keys...);
    visit(Field{"key", 1, interaction::kMostKeyFrames}, r.key...);
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
    PanelReader(TableReader& reader, FigureFile& figure, fs::path name)
        : reader_(reader), figure_(figure), name_(std::move(name)) {}

    FigurePanel read(TomlTable& table, const toml::table& plain) {
        FigurePanel panel;
        Referred referred;
        reader_.read(table, panel);
        reader_.read(table, referred);
        if (panel.index.empty())
            table.fail("index", "a panel needs an index: index = \"run42.isochron\"");
        refer(table, referred, panel);
        settings(table, plain, panel);
        table.finish();
        return panel;
    }

  private:
    /// The session, and the key of it or of a file of keys.
    void refer(const TomlTable& table, const Referred& referred, FigurePanel& panel) {
        const auto& [session, keys, number] = referred;
        if (session)
            panel.state = session_in(text_of_file(*session), in_folder(*session)).state;
        if (!keys && !(number && session)) {
            if (number)
                table.fail("key", "a key of what? expected keys = \"keys.json\", or a session");
            return;
        }
        const std::string& from = keys ? *keys : *session;
        const auto all = keys_in(text_of_file(from), in_folder(from));
        const std::size_t key = number.value_or(1);
        if (key > all.size())
            table.fail("key", fmt::format("expected 1 to {}, got {}", all.size(), key));
        panel.key = all[key - 1];
    }

    void settings(TomlTable& table, const toml::table& plain, FigurePanel& panel) {
        json key{{"time", 0}};
        for (const auto& [name, node] : plain) {
            const std::string word(name.str());
            if (table.knows(word))
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

    TableReader& reader_;
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
    const Config no_viewers;
    TableReader reader(no_viewers);
    reader.read(table, figure);
    if (figure.letters != "a" && figure.letters != "A" && figure.letters != "(a)" &&
        figure.letters != "none")
        table.fail("letters",
                   fmt::format("expected one of a, A, (a), none, got {}", figure.letters));
    const toml::node* const panels = table.take("panels");
    const toml::array* const list = panels ? panels->as_array() : nullptr;
    if (!list || list->empty() || list->size() > kMostPanels)
        table.fail("panels", fmt::format("expected 1 to {} tables [[panels]], got {}", kMostPanels,
                                         list ? std::to_string(list->size()) : "none"));
    PanelReader panel_reader(reader, figure, name);
    for (const toml::node& node : *list) {
        TomlTable panel = table.item("panels", node);
        figure.panels.push_back(panel_reader.read(panel, *node.as_table()));
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
