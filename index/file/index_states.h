// The states of an index that grows: the newest one, what it has been, and what a state leaves.
#pragma once

#include "index/file/index_file.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace isochron::index {

/// Whether this is the hash of the data, or was when the series had fewer steps. Knows every state
/// from which the index has grown, and any number of first steps up to 16,384.
bool has_had(const IndexFile& file, std::uint64_t content_hash);
/// Whether this is the hash of the first `steps` steps.
bool has_had(const IndexFile& file, std::uint64_t content_hash, std::size_t steps);

/// A message if the other header is of a newer state and is damaged, though its sections are whole.
std::optional<std::string> lost_state(const IndexFile& file);

/// The place of the previous state's sections, of all arrays, which the next state may overwrite.
struct FreeRoom {
    std::uint64_t offset = 0, bytes = 0;
};
FreeRoom free_room(const IndexFile& file);

} // namespace isochron::index
