// Parts of the metadata section, and the checks that all its parts share.
#pragma once

#include "index/error.h"
#include "index/file/sections/blend_quality.h"
#include "index/file/sections/index_contents.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace isochron::index {

using nlohmann::json;
struct ArrayPlace;

/// Reads a whole number with a check, as the JSON library converts any number without an error.
template <class T>
T whole(const json& value) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<T>::max())
        throw Error("expected a whole number up to {}, got {}", std::numeric_limits<T>::max(),
                    value.dump());
    return value.get<T>();
}

template <class Numbers>
void get_whole(const json& values, Numbers& out) {
    if (!values.is_array() || values.size() != out.size())
        throw Error("expected {} whole numbers", out.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = whole<typename Numbers::value_type>(values[i]);
}

/// The name of a file or an array: as text if it is UTF-8, which JSON requires, else as a list of
/// bytes.
inline json exact(const std::string& name) {
    try {
        json text = name;
        text.dump(); // throws if it is not UTF-8
        return text;
    } catch (const json::type_error&) {
        return std::vector<std::uint8_t>(name.begin(), name.end());
    }
}

inline json exact(const std::vector<std::string>& names) {
    json all = json::array();
    for (const std::string& name : names)
        all.push_back(exact(name));
    return all;
}

inline std::string exact_text(const json& value) {
    if (value.is_string())
        return value.get<std::string>();
    if (!value.is_array())
        throw Error("expected a name");
    std::string name;
    for (const json& byte : value)
        name += static_cast<char>(whole<std::uint8_t>(byte));
    return name;
}

template <class T>
void put_optional(json& j, const char* key, const std::optional<T>& value) {
    if constexpr (std::is_same_v<T, std::string>) {
        if (value)
            j[key] = exact(*value);
    } else if (value) {
        j[key] = *value;
    }
}
template <class T>
void get_optional(const json& j, const char* key, std::optional<T>& value) {
    if (!j.contains(key))
        return;
    if constexpr (std::is_same_v<T, std::string>)
        value = exact_text(j.at(key));
    else
        value = j.at(key).get<T>();
}

inline json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
inline glm::dvec3 vector_of(const json& value) {
    const auto v = value.get<std::array<double, 3>>();
    return {v[0], v[1], v[2]};
}

/// How files are read, but not which array and component of them.
json json_of(const ReadOptions& options);
ReadOptions read_options_of(const json& j);

/// The files that an index refers to. Reads only the options that say how to read them: grid, times
/// and units are in the index.
json json_of(const Referral& referral);
Referral referral_of(const json& j);

json json_of(const ColorArray& color);
ColorArray color_of(const json& j);

json json_of(const BlendQuality& blends);
BlendQuality blends_of(const json& j);

/// Where the further arrays have their sections: key `arrays`.
json json_of(const std::vector<ArrayPlace>& further);
std::vector<ArrayPlace> further_of(const json& j);

} // namespace isochron::index
