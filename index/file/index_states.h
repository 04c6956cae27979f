// The states of an index that grows: the newest one, what it has been, and what a state leaves.
#pragma once

#include "index/file/index_file.h"
#include "index/system/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace isochron::index {

/// Opens the newest state. If the file grows meanwhile, so that the parts that were read belong to
/// different states, starts again. @throws Error as `IndexFile::open` does
using OpenBytes = std::function<std::unique_ptr<ByteSource>()>;
std::shared_ptr<const IndexFile> open_newest(const OpenBytes& open, std::uint64_t cache_bytes = 0);

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
