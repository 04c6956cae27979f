// How well the blend of two steps stands for what lies between them, measured on the series itself.
#pragma once

#include "index/file/index_file.h"
#include "index/file/sections/blend_quality.h"

#include <optional>
#include <stop_token>

namespace isochron::index {

/// Compares at three isovalues, in at most 64 chunks, of steps that are spread over the series, and
/// reads these chunks alone, and those around one where a part of a surface seems to have no partner. The same for any number of threads.
/// @param store of the volume itself @param stats of its values
/// @return none with fewer than three steps, where no cell is active, in an index that refers to its
///         sources, or without bricks
/// @throws Error as ChunkStore does, Stopped
std::optional<BlendQuality> measure_blends(const ChunkStore& store, const IndexStats& stats,
                                           const std::stop_token& stop = {});

/// What was measured when the index was built, or is measured now where older programs built it.
std::optional<BlendQuality> blend_quality(const IndexFile& file, const std::stop_token& stop = {});

} // namespace isochron::index
