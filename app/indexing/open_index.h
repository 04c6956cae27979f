// Opens the index that a command is given; helps if the file is something else.
#pragma once

#include "index/file/index_file.h"
#include "index/file/named_index.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Whether a command says itself what a damaged index has lost.
enum class LostState : std::uint8_t { is_said, is_for_the_caller };

/// Says on stderr what a damaged index has lost, and that one is scanned whose tiers no search uses.
/// @param cache_bytes as IndexFile::open
/// @throws index::Error as index::open_named_index
std::shared_ptr<const index::IndexFile> open_index(const std::filesystem::path& path,
                                                   std::uint64_t cache_bytes = 0,
                                                   LostState lost = LostState::is_said,
                                                   const std::vector<std::string>& arrays = {});
/// Opens an index for commands that show surfaces.
/// @throws index::Error also as `check_can_be_shown`
std::shared_ptr<const index::IndexFile> open_index_to_show(const std::filesystem::path& path,
                                                           std::uint64_t cache_bytes = 0);

/// @param name of the index
/// @throws index::Error if the grid has more than 2^35 vertices: pictures need tables of all bricks
/// of the volume, in memory and on the GPU, which at that size hold 2^26 entries
void check_can_be_shown(const index::Grid& grid, const std::string& name);

/// Opens one of the arrays of an index. @param name none: the first @param color_by another one that is used
/// @throws index::Error as `open_index`, and naming its arrays when there is no such array
std::shared_ptr<const index::IndexFile> open_array(const std::filesystem::path& path,
                                                   const std::optional<std::string>& name,
                                                   std::uint64_t cache_bytes = 0,
                                                   const std::optional<std::string>& color_by = {});

/// The number of an array whose values on a surface are used, as `index::ColorSource` takes it.
/// @param what_for for the message, such as `to color by`
/// @throws index::Error naming the arrays that there are, when there is no such array
std::size_t array_on_surface(const index::IndexFile& file, const std::string& name,
                             std::string_view what_for);

/// Warns on stderr if an isovalue lies outside the range of the data, where no surface is.
void warn_beyond(double isovalue, const index::IndexFile& file);

} // namespace isochron::app
