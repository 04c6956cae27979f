// Commands to JSON and back: one rule for each type of value, the fields from command_fields.h.
#include "interaction/recording/commands_json.h"

#include "interaction/command_fields.h"
#include "interaction/navigation/navigation.h"
#include "interaction/recording/json_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace isochron::interaction {
namespace {

using nlohmann::json;

/// A structure of fields. A recording must have all of them, except optional ones.
template <class T>
concept Part = requires(T& part) { each_field([](const Field&, auto&) {}, part); };

// Declared before parts, since parts hold lists of parts.
template <class T>
json to_json(const std::vector<T>& list);
template <class T>
void from_json(const json& value, const Field& field, std::vector<T>& into);
json to_json(const Mark& mark);
void from_json(const json& value, const Field& field, Mark& into);
void from_json(const json& value, const Field& field, Rulers& into);

// Numbers, words and texts.

template <class T>
    requires std::integral<T> || std::floating_point<T>
json to_json(T value) {
    return value;
}
json to_json(const std::string& text) {
    return text;
}
template <Named Enum>
json to_json(Enum value) {
    return name_of(value);
}

/// The fraction stands beside it, among the fields of commands.
json to_json(Instant instant) {
    return instant.step;
}

void from_json(const json& value, const Field& field, bool& into) {
    into = boolean(value, field.key);
}
void from_json(const json& value, const Field& field, std::uint32_t& into) {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    into = static_cast<std::uint32_t>(
        natural(value, field.key, static_cast<std::uint64_t>(std::min(field.high, kMost))));
}
void from_json(const json& value, const Field& field, Instant& into) {
    from_json(value, field, into.step);
}
template <std::floating_point T>
void from_json(const json& value, const Field& field, T& into) {
    const bool limited = field.high < kAnyNumber;
    into = static_cast<T>(limited ? number(value, field.key, field.low, field.high)
                                  : number(value, field.key));
}
void from_json(const json& value, const Field& field, std::string& into) {
    into = text(value, field.key, std::max(field.most, kLongestText)); // `most` counts items of a list
}
template <Named Enum>
void from_json(const json& value, const Field& field, Enum& into) {
    const auto named = value_named<Enum>(text(value, field.key));
    if (!named)
        fail(field.key,
             fmt::format("{} or {}", fmt::join(kNames<Enum>.begin(), kNames<Enum>.end() - 1, ", "),
                         kNames<Enum>.back()),
             value);
    into = *named;
}

// Places and ranges.

template <class T>
json to_json(const glm::vec<3, T>& v) {
    return {v.x, v.y, v.z};
}
json to_json(const std::array<double, 2>& range) {
    return range;
}
json to_json(const Pose& pose) {
    return pose_json(pose);
}
json to_json(const Similarity& similarity) {
    const glm::dquat& r = similarity.rotation;
    json result = {{"translation", to_json(similarity.translation)},
                   {"rotation", {r.x, r.y, r.z, r.w}},
                   {"scale", similarity.scale}};
    if (similarity.exaggeration != 1)
        result["exaggeration"] = similarity.exaggeration;
    return result;
}

template <class T>
void from_json(const json& value, const Field& field, glm::vec<3, T>& into) {
    list(value, field.key, 3, 3);
    for (int i = 0; i < 3; ++i)
        from_json(value[i], field, into[i]);
}
void from_json(const json& value, const Field& field, std::array<double, 2>& into) {
    list(value, field.key, 2, 2);
    into = {number(value[0], field.key), number(value[1], field.key)};
    if (!field.any_order && !(into[0] < into[1]))
        fail(field.key, "two ascending numbers", value);
}
void from_json(const json& value, const Field&, Pose& into) {
    into = pose_from(value);
}
void from_json(const json& value, const Field& field, Similarity& into) {
    Members members(value, field.key);
    from_json(members.at("translation"), Field{"translation"}, into.translation);
    const json& r = list(members.at("rotation"), "rotation", 4, 4);
    into.rotation = glm::dquat(number(r[3], "rotation"), number(r[0], "rotation"),
                               number(r[1], "rotation"), number(r[2], "rotation"));
    require_unit(into.rotation, "rotation", r);
    const json& scale = members.at("scale");
    into.scale = number(scale, "scale");
    if (!(into.scale > 0))
        fail("scale", "a positive number", scale);
    into.exaggeration = 1;
    if (const json* exaggeration = members.find("exaggeration")) {
        into.exaggeration = number(*exaggeration, "exaggeration");
        if (!(into.exaggeration >= kLeastExaggeration && into.exaggeration <= kMostExaggeration))
            fail("exaggeration", "a number from 0.01 to 1000", *exaggeration);
    }
    members.done({"translation", "rotation", "scale", "exaggeration"});
}

// Parts. An optional field that is not set is left out, and so is a text of a key or a surface that is
// empty.

template <Part T>
json to_json(const T& part) {
    json result = json::object();
    const auto write = [&]<class V>(const Field& field, const V& value) {
        if constexpr (requires { value.has_value(); }) {
            if (value)
                result[field.key] = to_json(*value);
        } else if constexpr ((std::same_as<T, KeyFrame> || std::same_as<T, Isosurface>) &&
                             std::same_as<V, std::string>) {
            if (!value.empty())
                result[field.key] = value;
        } else {
            result[field.key] = to_json(value);
        }
    };
    each_field(write, part);
    return result;
}

template <Part T>
void from_json(const json& value, const Field& field, T& into) {
    Members members(value, field.key);
    std::vector<std::string_view> known;
    const auto read = [&]<class V>(const Field& inner, V& member) {
        known.emplace_back(inner.key);
        constexpr bool kOptional = requires { member.has_value(); };
        const json* found =
            kOptional || inner.may_lack ? members.find(inner.key) : &members.at(inner.key);
        if (!found && inner.old_key) {
            known.emplace_back(inner.old_key);
            found = members.find(inner.old_key);
        }
        if constexpr (kOptional) {
            if (found)
                from_json(*found, inner, member.emplace());
        } else if (found) {
            from_json(*found, inner, member);
        }
    };
    each_field(read, into);
    members.done(known);
}

/// A mark without a place is null.
json to_json(const Mark& mark) {
    return mark.point ? to_json(*mark.point) : json();
}
void from_json(const json& value, const Field& field, Mark& into) {
    if (!value.is_null())
        from_json(value, field, into.point.emplace());
}

/// Recordings of older versions have one ruler: its places.
void from_json(const json& value, const Field& field, Rulers& into) {
    if (!value.is_object() || !value.contains("places"))
        return from_json<Rulers>(value, field, into);
    Members members(value, field.key);
    Ruler ruler{.name = "1"};
    from_json(members.at("places"), Field{.key = "places", .most = 2}, ruler.places);
    members.done({"places"});
    if (!ruler.places.empty())
        into.list.push_back(std::move(ruler));
}

template <class T>
json to_json(const std::vector<T>& list) {
    json result = json::array();
    for (const T& one : list)
        result.push_back(to_json(one));
    return result;
}
template <class T>
void from_json(const json& value, const Field& field, std::vector<T>& into) {
    for (const json& one : list(value, field.key, field.least, field.most))
        from_json(one, field, into.emplace_back());
}

// Whether JSON can hold a value: its numbers are finite.

template <class T>
bool writable(const T& value) {
    if constexpr (std::floating_point<T>)
        return std::isfinite(value);
    else if constexpr (std::same_as<T, Pose>)
        return is_finite(value);
    else if constexpr (std::same_as<T, Similarity>)
        return is_valid(value);
    else if constexpr (std::same_as<T, Mark>)
        return !value.point || writable(*value.point);
    else if constexpr (std::same_as<T, glm::vec3> || std::same_as<T, glm::dvec3>)
        return writable(value.x) && writable(value.y) && writable(value.z);
    else if constexpr (requires { value.has_value(); })
        return !value || writable(*value);
    else if constexpr (Part<const T>) {
        bool all = true;
        each_field([&](const Field&, const auto& member) { all = all && writable(member); }, value);
        return all;
    } else if constexpr (requires { value.begin(); } && !std::same_as<T, std::string>)
        return std::ranges::all_of(value, [](const auto& one) { return writable(one); });
    else
        return true;
}

} // namespace

json commands_json(const Commands& commands) {
    json result = json::object();
    const auto write = [&]<class V>(const Field& field, const V& value) {
        if constexpr (std::same_as<V, bool>) {
            if (value)
                result[field.key] = true;
        } else if constexpr (requires { value.has_value(); }) {
            if (value)
                result[field.key] = to_json(*value);
        } else if (!value.empty()) {
            result[field.key] = to_json(value);
        }
    };
    each_field(write, commands);
    if (commands.instant)
        result["fraction"] = commands.instant->fraction;
    return result;
}

Commands commands_from(const json& value, std::string_view where) {
    Members members(value, where);
    Commands commands;
    std::vector<std::string_view> known;
    const auto read = [&]<class V>(const Field& field, V& member) {
        for (const char* key : {field.key, field.old_key}) {
            const json* found = key ? members.find(key) : nullptr;
            if (key)
                known.emplace_back(key);
            if (!found)
                continue;
            if constexpr (requires { member.has_value(); })
                from_json(*found, field, member.emplace());
            else
                from_json(*found, field, member);
        }
    };
    each_field(read, commands);
    members.done(known);
    if (commands.instant)
        commands.instant->fraction = std::exchange(commands.fraction, std::nullopt).value_or(0);
    return commands;
}

const char* unwritable_field(const Commands& commands) {
    const char* key = nullptr;
    each_field(
        [&](const Field& field, const auto& value) {
            if (!key && !writable(value))
                key = field.key;
        },
        commands);
    return key;
}

} // namespace isochron::interaction
