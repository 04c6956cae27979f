// The sections that end a state of an index.
#pragma once

#include "index/file/index_file.h"
#include "index/system/byte_sink.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace isochron::index {

/// Writes them one behind the other, and their places and checksums to the header: behind the end of
/// the file; of an index that grows in place of those of the state before the one that counts, where
/// there is room. So two places are enough for ever: each is left with half as much room again as it
/// needs, and grows with the index.
/// @param held what grows, if anything @param end of the file, a multiple of 64
/// @return where the file ends then
std::uint64_t
write_sections(const std::vector<std::pair<SectionKind, std::span<const std::byte>>>& sections,
               const IndexFile* held, std::uint64_t end, FileHeader& header, ByteSink& file);

} // namespace isochron::index
