// Reads values from JSON and checks each.
#include "interaction/recording/json_values.h"

#include "interaction/error.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace isochron::interaction {

using nlohmann::json;

std::string excerpt(const json& value) {
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > 40)
        text = text.substr(0, 37) + "...";
    return text;
}

void fail(std::string_view where, std::string_view expected, const json& got) {
    throw Error("{}: expected {}, got {}", where, expected, excerpt(got));
}

Members::Members(const json& object, std::string_view where) : object_(object), where_(where) {
    if (!object.is_object())
        fail(where, "an object", object);
}

const json* Members::find(const char* key) {
    const auto found = object_.find(key);
    if (found == object_.end())
        return nullptr;
    ++used_;
    return &*found;
}

const json& Members::at(const char* key) {
    if (const json* found = find(key))
        return *found;
    throw Error("{}: \"{}\" is missing", where_, key);
}

void Members::done(std::span<const std::string_view> known) const {
    if (used_ == object_.size())
        return;
    for (const auto& [key, value] : object_.items())
        if (std::ranges::find(known, key) == known.end())
            throw Error("{}: unknown key {}", where_, excerpt(json(key)));
}

double number(const json& value, std::string_view where) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
        fail(where, "a finite number", value);
    return value.get<double>();
}

double number(const json& value, std::string_view where, double low, double high) {
    const double result = number(value, where);
    if (result < low || result > high)
        fail(where, fmt::format("a number from {} to {}", low, high), value);
    return result;
}

float small_number(const json& value, std::string_view where) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return static_cast<float>(number(value, where, -kLargest, kLargest));
}

std::uint64_t natural(const json& value, std::string_view where, std::uint64_t most) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
        fail(where, fmt::format("an integer from 0 to {}", most), value);
    return value.get<std::uint64_t>();
}

bool boolean(const json& value, std::string_view where) {
    if (!value.is_boolean())
        fail(where, "true or false", value);
    return value.get<bool>();
}

std::string text(const json& value, std::string_view where, std::size_t longest) {
    if (!value.is_string() || value.get_ref<const std::string&>().size() > longest)
        fail(where, "a text of sensible length", value);
    return value.get<std::string>();
}

const json& list(const json& value, std::string_view where, std::size_t least, std::size_t most) {
    if (!value.is_array() || value.size() < least || value.size() > most)
        fail(where,
             least == most ? fmt::format("a list of {}", most)
                           : fmt::format("a list of {} to {}", least, most),
             value);
    return value;
}

json pose_json(const Pose& pose) {
    const glm::vec3& p = pose.position;
    const glm::quat& q = pose.orientation;
    return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

Pose pose_from(const json& value) {
    list(value, "pose", 7, 7);
    std::array<float, 7> v;
    for (std::size_t i = 0; i < v.size(); ++i)
        v[i] = small_number(value[i], "pose");
    const Pose pose{{v[0], v[1], v[2]}, glm::quat(v[6], v[3], v[4], v[5])};
    require_unit(pose.orientation, "pose", value);
    return pose;
}

} // namespace isochron::interaction
