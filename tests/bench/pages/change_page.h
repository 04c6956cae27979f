// The sections of the page of results on building by type, on what stays from set to set, and on what
// lies between two steps.
#pragma once

#include <string>

namespace isochron::bench {

/// @param json what `isochron-bench building --json` wrote @param path its name, for messages
/// @throws Error when it is not that
std::string building_section(const std::string& json, const std::string& path);
/// The same of `isochron-bench change --json`.
std::string change_section(const std::string& json, const std::string& path);
/// The same of `isochron-bench between --json`.
std::string between_section(const std::string& json, const std::string& path);

} // namespace isochron::bench
