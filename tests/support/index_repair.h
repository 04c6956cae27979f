// Checksums of an index that has been tampered with, made to match again at every depth.
#pragma once

#include <cstddef>
#include <span>

namespace isochron::index {

/// Of chunks, tables of layers, levels of bricks, tables and heads of units, sections and header, as
/// far as what the bytes say of themselves leads there. Those of whole steps stay: only `verify`
/// compares them.
/// @param file an index, or any other bytes
void repair_checksums(std::span<std::byte> file);

} // namespace isochron::index
