// How much a search at a step has to read from the file, by cells and by bricks.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/query.h"

#include <cstdint>

namespace isochron::index {

/// Bytes that are not in memory yet. For cells an estimate from a few stretches; for bricks
/// exact, but without the chunks next to the candidates.
struct MissingBytes {
    std::uint64_t cells = 0, bricks = 0;
};

/// @param shaded the values around the cells are needed, too, for normals: that counts for cells
///        only, since a search by bricks reads them anyway
/// The index must have both tiers. @throws Error as ChunkStore does
MissingBytes missing_bytes(const IndexFile& file, const Query& query, bool shaded);

} // namespace isochron::index
