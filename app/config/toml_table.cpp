// A table of a TOML file while it is read.
#include "app/config/toml_table.h"

#include "app/config/config_problem.h"
#include "app/safe_text.h"
#include "app/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::app {
namespace {

/// Keys and words that were spelled in another way up to version 0.1, and how they are now.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kSpellings{{
    {"colour", "color"},
    {"surface_colour", "surface_color"},
    {"colouring", "coloring"},
    {"footprint", "shape"},
    {"grey", "gray"},
    {"lagoon", "viridis"},
    {"dusk", "inferno"},
    {"polar", "coolwarm"},
}};

/// The value of a key under its name, or under its spelling in older files.
const toml::node* value_in(const toml::table& table, std::string_view key) {
    if (const toml::node* node = table.get(key))
        return node;
    for (const auto& [old, current] : kSpellings)
        if (current == key)
            return table.get(old);
    return nullptr;
}

/// Follows a path as far as it leads. @return the last value, and what is left of the path
std::pair<const toml::node*, std::string_view> follow(const toml::table& table,
                                                      std::string_view path) {
    const toml::node* at = &table;
    while (!path.empty() && at->is_table()) {
        const std::size_t end = std::min(path.find('.'), path.size());
        const toml::node* next = value_in(*at->as_table(), path.substr(0, end));
        if (!next)
            break;
        at = next;
        path.remove_prefix(std::min(end + 1, path.size()));
    }
    return {at, path};
}

std::string joined(const std::string& where, std::string_view key) {
    return where.empty() || key.empty() ? where + std::string(key)
                                        : fmt::format("{}.{}", where, key);
}

} // namespace

std::string type_name(const toml::node& node) {
    switch (node.type()) {
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a string";
    case toml::node_type::integer: return "an integer";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    default: return "a date or time";
    }
}

std::string_view new_spelling(std::string_view word) {
    for (const auto& [old, current] : kSpellings)
        if (old == word)
            return current;
    return word;
}

TomlTable::TomlTable(const toml::table& table, std::string file, std::string where)
    : table_(&table), file_(std::move(file)), where_(std::move(where)),
      known_(std::make_shared<std::vector<std::string>>()) {}

TomlTable TomlTable::within(std::string_view key) const {
    TomlTable inner = *this;
    inner.prefix_ += std::string(key) + ".";
    return inner;
}

TomlTable TomlTable::item(std::string_view key, const toml::node& table) const {
    if (!table.is_table())
        fail(key, fmt::format("expected a table, got {}", type_name(table)));
    return {*table.as_table(), file_, joined(where_, prefix_ + std::string(key))};
}

const toml::table* TomlTable::here() const {
    const std::string_view path = std::string_view(prefix_).substr(0, prefix_.size() - 1);
    const auto [node, rest] = follow(*table_, prefix_.empty() ? prefix_ : path);
    return rest.empty() ? node->as_table() : nullptr;
}

int TomlTable::line() const {
    const toml::table* table = here();
    return table ? static_cast<int>(table->source().begin.line) : 0;
}

const toml::node* TomlTable::find(std::string_view key) const {
    const std::string path = prefix_ + std::string(key);
    const auto [node, rest] = follow(*table_, path);
    if (rest.empty())
        return node;
    if (!node->is_table())
        TomlTable(*table_, file_, where_)
            .fail(path.substr(0, path.size() - rest.size() - 1),
                  fmt::format("expected a table, got {}", type_name(*node)));
    return nullptr;
}

const toml::node* TomlTable::take(std::string_view key) {
    known_->push_back(prefix_ + std::string(key));
    return find(key);
}

bool TomlTable::knows(std::string_view key) const {
    return std::ranges::find(*known_, prefix_ + std::string(key)) != known_->end();
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
    const std::string path = prefix_ + std::string(key);
    const auto line = follow(*table_, path).first->source().begin.line;
    throw ConfigError(
        one_line(fmt::format("{}:{}: {}: {}", file_, line, joined(where_, path), message)));
}

void TomlTable::finish() const {
    finish(*table_, "");
}

void TomlTable::finish(const toml::table& table, const std::string& prefix) const {
    std::vector<std::string> known; // keys of this table, each once
    for (const std::string& path : *known_) {
        if (!path.starts_with(prefix))
            continue;
        const std::string key =
            path.substr(prefix.size(), path.find('.', prefix.size()) - prefix.size());
        if (std::ranges::find(known, key) == known.end())
            known.push_back(key);
    }
    const auto knows = [&](std::string_view word) {
        return std::ranges::find(known, word) != known.end();
    };
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        // Accept the old spelling only without the new one: else it would be ignored silently.
        const std::string_view now =
            knows(name) || table.contains(new_spelling(name)) ? name : new_spelling(name);
        if (!knows(now)) {
            const std::string near = nearest_word(name, known);
            const std::string where = joined(where_, prefix.substr(0, prefix.rfind('.')));
            throw ConfigError(one_line(
                fmt::format("{}:{}: unknown key '{}'{}{}", file_, key.source().begin.line, name,
                            where.empty() ? "" : fmt::format(" in [{}]", where),
                            near.empty() ? fmt::format("; known: {}", fmt::join(known, ", "))
                                         : fmt::format("; did you mean '{}'?", near))));
        }
        const std::string inner = fmt::format("{}{}.", prefix, now);
        if (node.is_table() && std::ranges::any_of(*known_, [&](const std::string& path) {
                return path.starts_with(inner);
            }))
            finish(*node.as_table(), inner);
    }
}

} // namespace isochron::app
