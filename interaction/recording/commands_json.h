// Commands to JSON and back, with every value checked on the way in.
#pragma once

#include "interaction/commands.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace isochron::interaction {

/// Only what is set.
nlohmann::json commands_json(const Commands& commands);

/// @param where what they are called in an error
/// @throws Error without file and line: `scale: expected a finite number, got "big"`
Commands commands_from(const nlohmann::json& value, std::string_view where);

/// The key of the first field that holds what JSON cannot, such as a number that is not finite;
/// null when all can be written.
const char* unwritable_field(const Commands& commands);

} // namespace isochron::interaction
