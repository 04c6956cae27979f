// The JSON schema of a configuration.
#include "app/config/table_schema.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace isochron::app {
namespace {

using nlohmann::ordered_json;

template <class T>
ordered_json limited(const char* type, T low, T high) {
    ordered_json schema{{"type", type}};
    if (std::abs(static_cast<double>(low)) < std::numeric_limits<double>::max())
        schema["minimum"] = low;
    if (std::abs(static_cast<double>(high)) < std::numeric_limits<double>::max())
        schema["maximum"] = high;
    return schema;
}

/// @param most 0: no limit
ordered_json array_of(ordered_json items, std::size_t least, std::size_t most = 0) {
    ordered_json schema{{"type", "array"}};
    if (least > 0)
        schema["minItems"] = least;
    if (most > 0)
        schema["maxItems"] = most;
    schema["items"] = std::move(items);
    return schema;
}

ordered_json object_of(const ordered_json& properties) {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

} // namespace

struct TableSchema::Properties {
    ordered_json by_key = ordered_json::object();
    /// Schemas of tables that may also be arrays.
    ordered_json definitions = ordered_json::object();
    void note(std::string_view key, ordered_json schema) {
        by_key[std::string(key)] = std::move(schema);
    }
};

TableSchema::TableSchema() : properties_(std::make_unique<Properties>()) {}
TableSchema::~TableSchema() = default;
TableSchema::TableSchema(TableSchema&&) noexcept = default;
TableSchema& TableSchema::operator=(TableSchema&&) noexcept = default;

void TableSchema::number(std::string_view key, double low, double high) {
    properties_->note(key, limited("number", low, high));
}

void TableSchema::integer(std::string_view key, int low, int high) {
    properties_->note(key, limited("integer", low, high));
}

void TableSchema::flag(std::string_view key) {
    properties_->note(key, {{"type", "boolean"}});
}

void TableSchema::text(std::string_view key) {
    properties_->note(key, {{"type", "string"}});
}

void TableSchema::word(std::string_view key, const std::vector<std::string>& words) {
    properties_->note(key, {{"type", "string"}, {"enum", words}});
}

void TableSchema::numbers(std::string_view key, std::size_t least, std::size_t most, double low,
                          double high) {
    properties_->note(key, array_of(limited("number", low, high), least, most));
}

void TableSchema::integers(std::string_view key, std::size_t count, int low, int high) {
    properties_->note(key, array_of(limited("integer", low, high), count, count));
}

void TableSchema::table(std::string_view key, const TableSchema& inner, Times times) {
    ordered_json object = object_of(inner.properties_->by_key);
    properties_->definitions.update(inner.properties_->definitions);
    switch (times) {
    case Times::once: properties_->note(key, std::move(object)); break;
    case Times::array: properties_->note(key, array_of(std::move(object), 1)); break;
    case Times::either: {
        properties_->definitions[std::string(key)] = std::move(object);
        const ordered_json one{{"$ref", "#/definitions/" + std::string(key)}};
        properties_->note(key, {{"anyOf", {one, array_of(one, 1)}}});
        break;
    }
    }
}

std::string TableSchema::text() const {
    ordered_json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                        {"title", "Configuration of Isochron"}};
    schema.update(object_of(properties_->by_key));
    schema["definitions"] = properties_->definitions;
    return schema.dump(2) + '\n';
}

} // namespace isochron::app
