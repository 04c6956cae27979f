// Records of figures as JSON objects, by a list of their fields.
//
// A record has a function `each_field(record, field)` that calls `field(key, member)` for all of
// its figures in the order of the keys, for a record and for a const record.
#pragma once

#include "index/error.h"
#include "tests/bench/rows/header.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

namespace isochron::bench {

using nlohmann::json;
using nlohmann::ordered_json;

template <class AnyHeader, class Field>
void each_field(AnyHeader& header, Field&& field)
    requires std::is_same_v<std::remove_const_t<AnyHeader>, Header>
{
    field("commit", header.commit);
    field("processor", header.processor);
    field("threads", header.threads);
    field("compiler", header.compiler);
    field("date", header.date);
}

/// Rounds to five digits, as more would be noise.
inline ordered_json to_number(double value) {
    if (value == 0 || !std::isfinite(value))
        return value;
    const double digits = 4 - std::floor(std::log10(std::abs(value)));
    return digits > 0 ? std::round(value * std::pow(10.0, digits)) / std::pow(10.0, digits)
                      : std::round(value);
}

template <class Value>
ordered_json to_value(const Value& value) {
    if constexpr (std::is_floating_point_v<Value>)
        return to_number(value);
    else
        return value;
}

template <class Value>
ordered_json to_value(const std::optional<Value>& value) {
    return value ? to_value(*value) : ordered_json(nullptr);
}

template <class Value>
void from_value(const json& value, Value& out) {
    value.get_to(out);
}

template <class Value>
void from_value(const json& value, std::optional<Value>& out) {
    out = value.is_null() ? std::nullopt : std::optional<Value>(value.get<Value>());
}

template <class Record>
ordered_json record_to_json(const Record& record) {
    ordered_json j = ordered_json::object();
    each_field(record, [&](const char* key, const auto& value) { j[key] = to_value(value); });
    return j;
}

template <class Record>
Record record_from_json(const json& j) {
    Record record;
    each_field(record, [&](const char* key, auto& value) { from_value(j.at(key), value); });
    return record;
}

/// Parts of results as text, one row per line.
inline std::string json_text(const ordered_json& j) {
    std::string text = "{";
    for (const auto& [part, value] : j.items()) {
        text += fmt::format("{}\n\"{}\": ", text.size() > 1 ? "," : "", part);
        if (!value.is_array()) {
            text += value.dump();
            continue;
        }
        text += "[";
        for (std::size_t i = 0; i < value.size(); ++i)
            text += (i ? ",\n" : "\n") + value[i].dump();
        text += "\n]";
    }
    return text + "\n}\n";
}

/// Results of a header and rows as text.
template <class Results>
std::string results_text(const Results& results) {
    ordered_json j{{"header", record_to_json(results.header)}, {"rows", ordered_json::array()}};
    for (const auto& row : results.rows)
        j["rows"].push_back(record_to_json(row));
    return json_text(j);
}

/// @param name of the file, for errors
/// @param command that wrote the results, for errors
/// @throws index::Error
template <class Results>
Results results_from_text(const std::string& text, const std::string& name, const char* command) {
    using OwnRow = typename decltype(Results::rows)::value_type;
    try {
        const json j = json::parse(text);
        Results results{record_from_json<Header>(j.at("header")), {}};
        for (const json& row : j.at("rows"))
            results.rows.push_back(record_from_json<OwnRow>(row));
        return results;
    } catch (const json::exception& error) {
        throw index::Error("{}: no results of `{}`: {}", name, command, error.what());
    }
}

} // namespace isochron::bench
