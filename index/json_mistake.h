// What is wrong with a text as JSON, in words of this program.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

namespace isochron::index {

/// `not JSON at byte 7`, `expected number, got string`, `no shape`: what the library found, without
/// its own names of errors.
inline std::string json_mistake(const nlohmann::json::exception& error) {
    if (const auto* const parse = dynamic_cast<const nlohmann::json::parse_error*>(&error))
        return fmt::format("not JSON at byte {}", parse->byte);
    constexpr int kWrongType = 302, kNoMembers = 304, kNoElements = 305, kNoObject = 306;
    constexpr int kUtf8 = 316, kTooShort = 401, kNoKey = 403, kTooLarge = 406;
    std::string_view what = error.what();
    if (what.starts_with('['))
        what.remove_prefix(std::min(what.size(), what.find(' ') + 1));
    const auto between = [&](std::string_view start, std::string_view end) {
        const std::size_t from = what.find(start);
        if (from == what.npos)
            return std::string_view();
        const std::string_view rest = what.substr(from + start.size());
        return rest.substr(0, rest.rfind(end));
    };
    const std::string_view got = what.substr(what.rfind(' ') + 1);
    switch (error.id) {
    case kWrongType:
        return fmt::format("expected {}, got {}", between("must be ", ", but is"), got);
    case kNoMembers:
    case kNoElements: return fmt::format("expected an object or a list, got {}", got);
    case kNoObject: return fmt::format("expected an object, got {}", got);
    case kUtf8: return "a text is no UTF-8";
    case kTooShort: return "a list is too short";
    case kNoKey: return fmt::format("no {}", between("key '", "' not found"));
    case kTooLarge: return "a number is out of range";
    default: return std::string(what);
    }
}

} // namespace isochron::index
