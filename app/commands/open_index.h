// Opens the index that a command is given; helps if the file is something else.
#pragma once

#include "index/file/index_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// @param cache_bytes as IndexFile::open
/// @throws index::Error as IndexFile::open; if the file exists but is no .isochron, the message
/// says how to build an index of it
std::shared_ptr<const index::IndexFile> open_index(const std::filesystem::path& path,
                                                   std::uint64_t cache_bytes = 0);
/// The same for commands whose cell ids have 32 bits.
/// @throws index::Error also if the grid has 2^32 cells or more
std::shared_ptr<const index::IndexFile> open_index_to_show(const std::filesystem::path& path,
                                                           std::uint64_t cache_bytes = 0);

/// One of the arrays of an index. @param name none: the first
/// @throws index::Error naming its arrays when there is no such array
std::shared_ptr<const index::IndexFile>
array_called(const std::shared_ptr<const index::IndexFile>& file,
             const std::optional<std::string>& name);

/// The number of an array. @throws index::Error as `array_called`
std::size_t array_number(const index::IndexFile& file, const std::string& name);

/// The names of its arrays.
std::vector<std::string> array_names(const index::IndexFile& file);

/// Warns on stderr if an isovalue lies outside the range of the data, where no surface is.
void warn_beyond(double isovalue, const index::IndexFile& file);

} // namespace isochron::app
