// The JSON schema of configurations, from the keys in config_fields.h.
#include "app/config/config_words.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

using nlohmann::ordered_json;

ordered_json empty_object() {
    return {{"type", "object"},
            {"additionalProperties", false},
            {"properties", ordered_json::object()}};
}

/// Limits that no double reaches are left out.
ordered_json limited(const char* type, const Field& field) {
    ordered_json schema{{"type", type}};
    const auto limit = [&](const char* key, double value) {
        if (std::abs(value) == interaction::kAnyNumber)
            return;
        if (std::string_view(type) == "integer")
            schema[key] = static_cast<std::int64_t>(value);
        else
            schema[key] = value;
    };
    limit("minimum", field.low);
    limit("maximum", field.high);
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

ordered_json words(const std::vector<std::string>& all) {
    ordered_json schema{{"type", "string"}};
    if (!all.empty())
        schema["enum"] = all;
    return schema;
}

template <class T>
ordered_json schema_of(Field field) {
    if constexpr (Worded<T>)
        return words(words_of<T>(field));
    else if constexpr (kIsOptional<T>)
        return schema_of<typename T::value_type>(field);
    else if constexpr (std::same_as<T, bool>)
        return field.words[0] ? words({field.words[0], field.words[1]})
                              : ordered_json{{"type", "boolean"}};
    else if constexpr (std::same_as<T, std::string>)
        return words(words_of_text(field.key));
    else if constexpr (std::same_as<T, std::size_t> || std::same_as<T, interaction::Endpoint>)
        return words({});
    else if constexpr (std::integral<T> || std::same_as<T, NumberInDTrack>)
        return limited("integer", field);
    else if constexpr (std::floating_point<T> || kIsDuration<T>)
        return limited("number", field);
    else if constexpr (std::same_as<T, glm::quat>)
        return schema_of<glm::vec3>(field);
    else if constexpr (std::same_as<T, std::array<double, 2>>)
        return array_of(limited("number", field), 2, 2);
    else if constexpr (kComponents<T> > 0) {
        field = within_reach(field);
        return array_of(
            limited(std::integral<typename T::value_type> ? "integer" : "number", field),
            kComponents<T>, kComponents<T>);
    } else if constexpr (kIsVector<T>)
        return array_of(limited("number", field), 0, field.most);
    else
        return {}; // no file says it
}

class Schema {
  public:
    /// Notes the keys of a table. @param into its schema
    template <Table T>
    void note(ordered_json& into, T& table) {
        each_field([&]<class V>(const Field& field, V&& member) { note(into, field, member); },
                   table);
    }

    ordered_json definitions =
        ordered_json::object(); ///< definitions of tables that may also be arrays

  private:
    template <class V>
    void note(ordered_json& into, const Field& field, V& member) {
        if (!field.in_files)
            return;
        if constexpr (Tables<V>) {
            typename V::value_type item;
            ordered_json table = empty_object();
            note(table, item);
            const bool either = field.one && std::string_view(field.one) == field.key;
            if (field.one && !either)
                at(into, field.one) = table;
            if (either) {
                definitions[field.key] = std::move(table);
                const ordered_json one{{"$ref", std::string("#/definitions/") + field.key}};
                at(into, field.key) = {{"anyOf", {one, array_of(one, 1)}}};
            } else {
                at(into, field.key) = array_of(std::move(table), 1);
            }
        } else if constexpr (Table<V>) {
            ordered_json& table = at(into, field.key);
            if (table.is_null())
                table = empty_object();
            note(table, member);
        } else if constexpr (kIsOptional<V> &&
                             requires { requires Table<typename V::value_type>; }) {
            note(into, field, member.emplace());
        } else {
            at(into, field.key) = schema_of<V>(field);
        }
    }

    /// The schema of a key, which may be a path.
    static ordered_json& at(ordered_json& table, std::string_view path) {
        const std::size_t dot = path.find('.');
        ordered_json& property = table["properties"][std::string(path.substr(0, dot))];
        if (dot == path.npos)
            return property;
        if (property.is_null())
            property = empty_object();
        return at(property, path.substr(dot + 1));
    }
};

} // namespace

std::string config_schema() {
    Config usual;
    Schema schema;
    ordered_json file{{"$schema", "http://json-schema.org/draft-07/schema#"},
                      {"title", "Configuration of Isochron"}};
    file.update(empty_object());
    schema.note(file, usual);
    file["definitions"] = std::move(schema.definitions);
    return file.dump(2) + '\n';
}

} // namespace isochron::app
