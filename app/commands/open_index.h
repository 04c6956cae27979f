// An index that a command is given, and what is said when something else was meant.
#pragma once

#include "index/file/index_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace isochron::app {

/// @param cache_bytes as IndexFile::open
/// @throws index::Error as IndexFile::open; where the file is there and has another suffix, with
/// how an index is made of it
std::shared_ptr<const index::IndexFile> open_index(const std::filesystem::path& path,
                                                   std::uint64_t cache_bytes = 0);
/// The same for work that tells cells apart by 32 bits.
/// @throws index::Error also where a step has more cells than that
std::shared_ptr<const index::IndexFile> open_index_to_show(const std::filesystem::path& path,
                                                           std::uint64_t cache_bytes = 0);

/// Says on stderr when an isovalue lies beyond the data, where no surface is; the range is told.
void warn_beyond(double isovalue, const index::IndexFile& file);

} // namespace isochron::app
