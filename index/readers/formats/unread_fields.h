// The note for users about fields that a file states and the program does not use.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// One sentence; empty without any. Fields that only name or describe the data are left out.
/// @param fields as the file has them, with their values where short
std::optional<std::string> note_on_unread(const std::vector<std::string>& fields);

/// The fields of a header that none of these keys are, as `note_on_unread` takes them.
std::vector<std::string> fields_besides(const std::set<std::string_view>& keys,
                                        const std::map<std::string, std::string>& fields);

} // namespace isochron::index
