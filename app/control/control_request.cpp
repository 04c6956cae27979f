// Reads requests of the control socket, and writes them.
#include "app/control/control_request.h"

#include "interaction/error.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/json_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace isochron::app {
namespace {

using interaction::Members;
using nlohmann::json;

constexpr std::size_t kLongestId = 64, kLongestToken = 256;

/// Objects and lists inside each other, counted before a parser gets them.
void expect_shallow_json(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (quoted && text[i] == '\\')
            ++i;
        else if (text[i] == '"')
            quoted = !quoted;
        else if (!quoted && (text[i] == '{' || text[i] == '['))
            ++depth;
        else if (!quoted && (text[i] == '}' || text[i] == ']'))
            --depth;
        if (depth > kDeepestRequest)
            throw interaction::Error("request: nested deeper than {} levels", kDeepestRequest);
    }
}

template <std::size_t kCount>
std::size_t number_of(const json& value, std::string_view where,
                      const std::array<std::string_view, kCount>& names) {
    const auto found = std::ranges::find(names, interaction::text(value, where));
    if (found == names.end())
        interaction::fail(where, fmt::format("{}", fmt::join(names, ", ")), value);
    return static_cast<std::size_t>(found - names.begin());
}

std::string id_of(const json& value) {
    if (!value.is_number_integer() && !value.is_string())
        interaction::fail("id", "a whole number or a text", value);
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > kLongestId)
        interaction::fail("id", fmt::format("at most {} bytes", kLongestId), value);
    return text;
}

/// Undo and redo stand for what the session finds in its history, so nothing else may be with them.
interaction::Commands commands_of(const json& value) {
    interaction::Commands commands = interaction::commands_from(value, "commands");
    interaction::Commands alone;
    alone.undo = commands.undo;
    alone.redo = commands.redo;
    if (!alone.empty() && commands != alone)
        throw interaction::Error("commands: undo and redo stand alone");
    if (commands.undo && commands.redo)
        throw interaction::Error("commands: expected undo or redo, got both");
    if (commands.leaving)
        throw interaction::Error(
            "commands: leaving is the window's question; quit ends the session");
    return commands;
}

/// What is searched: at which step of which array.
void take_moment(Members& members, ControlRequest& request) {
    if (const json* step = members.find("step"))
        request.step = static_cast<std::uint32_t>(
            interaction::natural(*step, "step", std::numeric_limits<std::uint32_t>::max()));
    if (const json* array = members.find("array"))
        request.array = interaction::text(*array, "array", interaction::kLongestArrayName);
}

void take_places(Members& members, ControlRequest& request) {
    const json* const places = members.find("places");
    if (!places)
        return;
    for (const json& place : interaction::list(*places, "places", 2, kMostProfilePlaces)) {
        glm::dvec3& at = request.places.emplace_back();
        for (int axis = 0; const json& each : interaction::list(place, "places", 3, 3))
            at[axis++] = interaction::number(each, "places");
    }
}

void say_moment(const ControlRequest& request, json& line) {
    if (request.step)
        line["step"] = *request.step;
    if (request.array)
        line["array"] = *request.array;
}

json as_json(const ControlRequest& request) {
    json line{{"verb", kControlVerbNames[static_cast<std::size_t>(request.verb)]}};
    switch (request.verb) {
    case ControlVerb::hello: line["token"] = request.token; break;
    case ControlVerb::commands:
        line["commands"] = interaction::commands_json(request.commands);
        break;
    case ControlVerb::subscribe:
        line["to"] = json::array();
        for (std::size_t i = 0; i < request.to.size(); ++i)
            if (request.to[i])
                line["to"].push_back(kControlTopicNames[i]);
        line["rate"] = request.rate;
        break;
    case ControlVerb::picture: line["now"] = request.now; break;
    case ControlVerb::cells:
    case ControlVerb::mesh:
        if (request.isovalue)
            line["isovalue"] = *request.isovalue;
        say_moment(request, line);
        break;
    case ControlVerb::profile:
        for (const glm::dvec3& place : request.places)
            line["places"].push_back({place.x, place.y, place.z});
        say_moment(request, line);
        break;
    case ControlVerb::state: break;
    }
    return line;
}

} // namespace

ControlRequest request_from(std::string_view line, std::string& id) {
    id = "null";
    expect_shallow_json(line);
    const json parsed = json::parse(line, nullptr, false);
    if (parsed.is_discarded())
        throw interaction::Error("request: expected an object as JSON in one line");
    Members members(parsed, "request");
    if (const json* found = members.find("id"))
        id = id_of(*found);
    ControlRequest request;
    request.verb =
        static_cast<ControlVerb>(number_of(members.at("verb"), "verb", kControlVerbNames));
    switch (request.verb) {
    case ControlVerb::state: members.done({"id", "verb"}); break;
    case ControlVerb::hello:
        request.token = interaction::text(members.at("token"), "token", kLongestToken);
        members.done({"id", "verb", "token"});
        break;
    case ControlVerb::commands:
        request.commands = commands_of(members.at("commands"));
        members.done({"id", "verb", "commands"});
        break;
    case ControlVerb::subscribe:
        for (const json& topic :
             interaction::list(members.at("to"), "to", 0, kControlTopicNames.size()))
            request.to[number_of(topic, "to", kControlTopicNames)] = true;
        if (const json* rate = members.find("rate"))
            request.rate = interaction::number(*rate, "rate", 0.1, kMostEventsASecond);
        members.done({"id", "verb", "to", "rate"});
        break;
    case ControlVerb::picture:
        if (const json* now = members.find("now"))
            request.now = interaction::boolean(*now, "now");
        members.done({"id", "verb", "now"});
        break;
    case ControlVerb::cells:
    case ControlVerb::mesh:
        if (const json* isovalue = members.find("isovalue"))
            request.isovalue = interaction::number(*isovalue, "isovalue");
        take_moment(members, request);
        members.done({"id", "verb", "isovalue", "step", "array"});
        break;
    case ControlVerb::profile:
        take_places(members, request);
        take_moment(members, request);
        members.done({"id", "verb", "places", "step", "array"});
        break;
    }
    return request;
}

std::string line_of(const ControlRequest& request, const std::string& id) {
    json line = as_json(request);
    if (id != "null")
        line["id"] = json::parse(id);
    return line.dump(-1, ' ', true, json::error_handler_t::replace);
}

} // namespace isochron::app
