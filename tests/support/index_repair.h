// Repairs all checksums of a modified index, so that tests reach the checks behind them.
#pragma once

#include <cstddef>
#include <span>

namespace isochron::index {

/// Repairs the checksums of chunks, tables of layers, levels of bricks, parts that are no longer used,
/// sections and header, as far as they can be found by the file's own contents. Checksums of whole
/// steps stay as they are, because only `verify` compares them.
/// @param file an index, or any other bytes
void repair_checksums(std::span<std::byte> file);

} // namespace isochron::index
