// How many cells fit into the memory that the program may use.
#pragma once

#include "app/quality/detail_chooser.h"
#include "index/file/index_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Cells of a set that is extracted, sent and drawn, where the drawing takes memory of the process.
/// @param memory [bytes] that the process may use (index::memory_limit) @param cache [bytes] of the index
std::uint64_t cells_in_memory(std::uint64_t memory, std::uint64_t cache);

/// Limits a choice to the cells that fit. @param cells of the volume @param memory, cache as above
/// @return a line that says so; none if all that may be shown fit
std::optional<std::string> limit_to_memory(DetailChooser& details, std::uint64_t cells,
                                           std::uint64_t memory, std::uint64_t cache);

/// Limits cells by what the process may use and the index keeps. @return at most one line
std::vector<std::string> limit_to_memory(DetailChooser& details, const index::IndexFile& file);

} // namespace isochron::app
