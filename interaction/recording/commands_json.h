// Commands to JSON and back, with every value checked on the way in.
#pragma once

#include "interaction/commands.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace isochron::interaction {

/// An object of the fields that are set.
nlohmann::json commands_json(const Commands& commands);

/// @param where name of the commands in an error message
/// @throws Error without file and line: `scale: expected a finite number, got "big"`
Commands commands_from(const nlohmann::json& value, std::string_view where);

/// The key of the first field with a value that JSON cannot hold (a number that is not finite);
/// null if there is none.
const char* unwritable_field(const Commands& commands);

} // namespace isochron::interaction
