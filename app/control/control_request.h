// What a client of the control socket asks for: one line of JSON each.
#pragma once

#include "interaction/commands.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

inline constexpr std::size_t kLongestLine = 64 * 1024; ///< [byte] of a request, without its end
inline constexpr int kDeepestRequest = 16;             ///< levels of objects and lists

enum class ControlVerb { hello, state, commands, subscribe, picture, cells, mesh, profile };
inline constexpr std::array<std::string_view, 8> kControlVerbNames{
    "hello", "state", "commands", "subscribe", "picture", "cells", "mesh", "profile"};

/// Whether a request is answered beside the frames, from the data.
constexpr bool is_search(ControlVerb verb) {
    return verb >= ControlVerb::cells;
}

/// What a client can be told of as it changes.
enum class ControlTopic { state, time, cells, statistics };
inline constexpr std::array<std::string_view, 4> kControlTopicNames{"state", "time", "cells",
                                                                    "statistics"};
inline constexpr double kMostEventsASecond = 120;

inline constexpr std::size_t kMostProfilePlaces = 256;

struct ControlRequest {
    ControlVerb verb = ControlVerb::state;
    std::string token{};              ///< what `hello` shows
    interaction::Commands commands{}; ///< what `commands` brings
    /// Topics of `subscribe`; none: no more events.
    std::array<bool, kControlTopicNames.size()> to{};
    double rate = 30;                    ///< most events a second, for `subscribe`
    bool now = false;                    ///< `picture` does not wait for its cells
    std::optional<double> isovalue{};    ///< isovalue of `cells` and `mesh`; empty: as shown
    std::optional<std::uint32_t> step{}; ///< step of what is searched; empty: as shown
    std::optional<std::string> array{};  ///< array of what is searched; empty: as shown
    /// Places of `profile`, physical space, none or 2 to kMostProfilePlaces; none: the picked ruler's.
    std::vector<glm::dvec3> places{};
    bool operator==(const ControlRequest&) const = default;
};

/// @param line without its end
/// @param id set to the client's own name of the request, as JSON; `null` if it gives none
/// @throws interaction::Error in one line: no JSON, nested deeper than `kDeepestRequest`, an
/// unknown verb or key, a value that a recording would refuse
ControlRequest request_from(std::string_view line, std::string& id);

/// The request as a line, without its end. @param id as JSON
std::string line_of(const ControlRequest& request, const std::string& id = "null");

} // namespace isochron::app
