// Writes the sections of an index, the last parts of each of its states.
#pragma once

#include "index/file/index_file.h"
#include "index/system/byte_sink.h"

#include <cstdint>
#include <vector>

namespace isochron::index {

/// The contents of an array's sections.
struct ArraySections {
    std::uint64_t content_hash = 0;
    Section tree; ///< the tree's section, which is in the file already
    std::vector<StepEntry> steps;
    std::vector<std::uint64_t> checksums;
    Metadata metadata; ///< its list of further arrays is filled in here
};

/// Writes the sections one after the other, and sets content hash, offsets and checksums in the
/// header. They go after the end of the file, or, in an index that grows, over the sections of the
/// state before the present one if these leave enough room. Sections at the end of an index that
/// grows get half as much room again, so that later states mostly use two places in turn.
/// @param arrays at least one @param held the index that grows; null for a new one
/// @param end of the file, a multiple of 64
/// @return the new end of the file
std::uint64_t write_sections(std::vector<ArraySections>& arrays, const IndexFile* held,
                             std::uint64_t end, FileHeader& header, ByteSink& file);

} // namespace isochron::index
