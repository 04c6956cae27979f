// Checked reading of a TOML table.
#include "app/config/toml_reader.h"

#include "app/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

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

/// Empty if there was no other spelling.
std::string_view old_spelling(std::string_view now) {
    for (const auto& [old, current] : kSpellings)
        if (current == now)
            return old;
    return {};
}

std::string_view new_spelling(std::string_view word) {
    for (const auto& [old, current] : kSpellings)
        if (old == word)
            return current;
    return word;
}

constexpr double kFar = 1e6; ///< meters or pixels: beyond any installation

/// The empty table of a reader that describes.
const toml::table& nothing() {
    static const toml::table kNothing;
    return kNothing;
}

} // namespace

TomlReader::TomlReader(const toml::table& table, std::string file, std::string where)
    : table_(table), file_(std::move(file)), where_(std::move(where)) {}

TomlReader::TomlReader(TableSchema& schema) : schema_(&schema), table_(nothing()) {}

const toml::node* TomlReader::find(std::string_view key) const {
    if (const toml::node* node = table_.get(key))
        return node;
    const std::string_view old = old_spelling(key);
    return old.empty() ? nullptr : table_.get(old);
}

const toml::node* TomlReader::get(std::string_view key) {
    known_.emplace_back(key);
    return find(key);
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
    if (!schema_)
        refuse(key, message);
}

void TomlReader::refuse(std::string_view key, const std::string& message) const {
    const toml::node* node = find(key);
    const auto line = (node ? node->source() : table_.source()).begin.line;
    const std::string place = where_.empty() ? std::string(key) : where_ + "." + std::string(key);
    throw ConfigError(one_line(fmt::format("{}:{}: {}: {}", file_, line, place, message)));
}

double TomlReader::finite_number(std::string_view key, const toml::node& node, double low,
                                 double high) const {
    const auto value = node.value<double>();
    if (!value || node.is_boolean())
        refuse(key, fmt::format("expected a number, got {}", type_name(node)));
    if (!std::isfinite(*value) || *value < low || *value > high)
        refuse(key, fmt::format("expected a number from {} to {}, got {}", low, high, *value));
    return *value;
}

void TomlReader::number(std::string_view key, double low, double high, double& into) {
    if (schema_)
        schema_->number(key, low, high);
    if (const toml::node* node = get(key))
        into = finite_number(key, *node, low, high);
}

void TomlReader::number(std::string_view key, double low, double high, float& into) {
    double value = into;
    number(key, low, high, value);
    into = static_cast<float>(value);
}

void TomlReader::integer(std::string_view key, int low, int high, int& into) {
    if (schema_)
        schema_->integer(key, low, high);
    const toml::node* node = get(key);
    if (!node)
        return;
    const auto value = node->value_exact<std::int64_t>();
    if (!value)
        refuse(key, fmt::format("expected an integer, got {}", type_name(*node)));
    if (*value < low || *value > high)
        refuse(key, fmt::format("expected an integer from {} to {}, got {}", low, high, *value));
    into = static_cast<int>(*value);
}

void TomlReader::flag(std::string_view key, bool& into) {
    if (schema_)
        schema_->flag(key);
    const toml::node* node = get(key);
    if (!node)
        return;
    const auto value = node->value_exact<bool>();
    if (!value)
        refuse(key, fmt::format("expected true or false, got {}", type_name(*node)));
    into = *value;
}

void TomlReader::text(std::string_view key, std::string& into) {
    if (schema_)
        schema_->text(key);
    const toml::node* node = get(key);
    if (!node)
        return;
    const auto value = node->value_exact<std::string>();
    if (!value)
        refuse(key, fmt::format("expected a string, got {}", type_name(*node)));
    into = *value;
}

std::vector<double> TomlReader::numbers(std::string_view key, const toml::node& node,
                                        std::size_t count) const {
    const toml::array* array = node.as_array();
    if (!array || array->size() != count)
        refuse(key, fmt::format("expected an array of {} numbers, got {}", count,
                                array ? fmt::format("one of {}", array->size()) : type_name(node)));
    std::vector<double> values;
    for (const toml::node& element : *array)
        values.push_back(finite_number(key, element, -kFar, kFar));
    return values;
}

void TomlReader::vector(std::string_view key, glm::dvec2& into) {
    if (schema_)
        schema_->numbers(key, 2, 2, -kFar, kFar);
    if (const toml::node* node = get(key)) {
        const auto v = numbers(key, *node, 2);
        into = {v[0], v[1]};
    }
}

void TomlReader::vector(std::string_view key, glm::vec2& into) {
    glm::dvec2 wide(into);
    vector(key, wide);
    into = glm::vec2(wide);
}

void TomlReader::vector(std::string_view key, glm::vec3& into) {
    if (schema_)
        schema_->numbers(key, 3, 3, -kFar, kFar);
    if (const toml::node* node = get(key)) {
        const auto v = numbers(key, *node, 3);
        into = glm::vec3(v[0], v[1], v[2]);
    }
}

void TomlReader::color(std::string_view key, glm::vec3& into) {
    vector(key, into);
    if (schema_)
        schema_->numbers(key, 3, 3, 0.0, 1.0);
    for (int channel = 0; channel < 3; ++channel)
        if (into[channel] < 0 || into[channel] > 1)
            fail(key, fmt::format("expected sRGB from 0 to 1, got {}", into[channel]));
}

void TomlReader::list(std::string_view key, double low, double high, std::size_t longest,
                      std::vector<double>& into) {
    if (schema_)
        schema_->numbers(key, 0, longest, low, high);
    const toml::node* node = get(key);
    if (!node)
        return;
    const toml::array* array = node->as_array();
    if (!array || array->size() > longest)
        refuse(key,
               fmt::format("expected an array of at most {} numbers, got {}", longest,
                           array ? fmt::format("one of {}", array->size()) : type_name(*node)));
    into.clear();
    for (const toml::node& element : *array)
        into.push_back(finite_number(key, element, low, high));
}

void TomlReader::integers(std::string_view key, int low, int high, glm::ivec2& into) {
    if (schema_)
        schema_->integers(key, 2, low, high);
    const toml::node* node = get(key);
    if (!node)
        return;
    for (double value : numbers(key, *node, 2))
        if (value != std::floor(value) || value < low || value > high)
            refuse(key,
                   fmt::format("expected two integers from {} to {}, got {}", low, high, value));
    const auto v = numbers(key, *node, 2);
    into = glm::ivec2(v[0], v[1]);
}

void TomlReader::word(std::string_view key, const std::vector<std::string>& words,
                      const std::function<void(const std::string&)>& take) {
    given_word(key, words, take);
    if (schema_)
        schema_->word(key, words);
}

void TomlReader::given_word(std::string_view key, const std::vector<std::string>& words,
                            const std::function<void(const std::string&)>& take) {
    std::string value;
    text(key, value);
    if (!has(key))
        return;
    value = new_spelling(value);
    if (std::find(words.begin(), words.end(), value) == words.end()) {
        const std::string near = nearest_word(value, words);
        refuse(key, fmt::format("unknown value '{}', expected one of {}{}", value,
                                fmt::join(words, ", "),
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
    take(value);
}

void TomlReader::describe(std::string_view key, const std::function<void(TomlReader&)>& read,
                          TableSchema::Times times) {
    TableSchema inner;
    TomlReader reader(inner);
    read(reader);
    schema_->table(key, inner, times);
}

bool TomlReader::table(std::string_view key, const std::function<void(TomlReader&)>& read) {
    if (schema_)
        describe(key, read, TableSchema::Times::once);
    const toml::node* node = get(key);
    if (!node)
        return false;
    const toml::table* inner = node->as_table();
    if (!inner)
        refuse(key, fmt::format("expected a table, got {}", type_name(*node)));
    TomlReader reader(*inner, file_,
                      where_.empty() ? std::string(key) : fmt::format("{}.{}", where_, key));
    read(reader);
    reader.finish();
    return true;
}

bool TomlReader::tables(std::string_view key, const std::function<void(TomlReader&)>& read) {
    if (schema_)
        describe(key, read, TableSchema::Times::array);
    const toml::node* node = get(key);
    if (!node)
        return false;
    const toml::array* array = node->as_array();
    if (!array || array->empty() || !array->is_homogeneous(toml::node_type::table))
        refuse(key, fmt::format("expected [[{}]] tables, got {}", key, type_name(*node)));
    for (const toml::node& element : *array) {
        TomlReader reader(*element.as_table(), file_,
                          where_.empty() ? std::string(key) : fmt::format("{}.{}", where_, key));
        read(reader);
        reader.finish();
    }
    return true;
}

bool TomlReader::table_or_tables(std::string_view key,
                                 const std::function<void(TomlReader&)>& read) {
    if (schema_) {
        describe(key, read, TableSchema::Times::either);
        return false;
    }
    const toml::node* node = find(key);
    return node && node->is_array() ? tables(key, read) : table(key, read);
}

void TomlReader::finish() const {
    for (const auto& [key, node] : table_) {
        const std::string name(key.str());
        const auto knows = [&](std::string_view word) {
            return std::find(known_.begin(), known_.end(), word) != known_.end();
        };
        if (knows(name))
            continue;
        // Accept the old spelling only without the new one: else it would be ignored silently.
        const std::string_view now = new_spelling(name);
        if (now != name && knows(now) && !table_.contains(now))
            continue;
        const std::string near = nearest_word(name, known_);
        throw ConfigError(
            one_line(fmt::format("{}:{}: unknown key '{}'{}{}", file_, key.source().begin.line,
                                 name, where_.empty() ? "" : fmt::format(" in [{}]", where_),
                                 near.empty() ? fmt::format("; known: {}", fmt::join(known_, ", "))
                                              : fmt::format("; did you mean '{}'?", near))));
    }
}

} // namespace isochron::app
