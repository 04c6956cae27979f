// What users are told of fields that a file states and that nothing is done with.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// One sentence; empty without any. @param fields as the file has them, with their values where short
std::optional<std::string> note_on_unread(const std::vector<std::string>& fields);

} // namespace isochron::index
