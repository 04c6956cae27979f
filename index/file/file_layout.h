// Header and section table of the .isochron file: where everything lies, and whether it is intact.
//
// Version 3, little-endian, offsets from the start of the file. The header has 4096 bytes:
// FileHeader, then zeros. The sections follow from 4096 on, volume and units at multiples of 4096,
// the others of 64, the gaps zero:
// - volume: chunks of values with the extremes of their bricks, and the tables that say where they
//   lie (chunk_table.h), array after array, step after step, each from a multiple of 64
// - units: cells and deltas of every chunk in every epoch (cell_unit.h), each part padded to 64
//   bytes
// - tree: the THI tree's block (thi_tree.h)
// - steps: a StepEntry for each step of the volume, then for each of the array to color by
// - directory: a UnitEntry for each epoch and chunk, chunks faster
// - checksums: XXH3, 64 bits: of the stored values of every step of the volume, of cells and deltas
//   of every unit, of the stored values of every step of the array to color by
// - metadata: JSON (metadata.h)
// A section that the plan does without is empty.
#pragma once

#include "index/system/byte_source.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

constexpr std::uint64_t kSectionAlignment = 4096;
constexpr std::uint64_t kPartAlignment = 64;
constexpr std::uint32_t kFileVersion = 3;

enum class SectionKind : std::uint32_t {
    volume,
    units,
    tree,
    steps,
    directory,
    checksums,
    metadata
};
constexpr std::array<const char*, 7> kSectionNames{"volume",    "units",     "tree",    "steps",
                                                   "directory", "checksums", "metadata"};

struct Section {
    std::uint64_t offset = 0, bytes = 0;
    std::uint64_t checksum = 0; ///< XXH3, 64 bits; 0 for what the checksums section covers
};

/// Where the parts of a unit lie in their section.
struct UnitEntry {
    std::uint64_t cells_offset, cells_bytes;
    std::uint64_t deltas_offset, deltas_bytes;
};

/// Where the chunks of a step lie in their section.
struct StepEntry {
    std::uint64_t offset = 0, bytes = 0;
    std::uint64_t tables = 0; ///< where the tables of the layers begin, from `offset`
};

/// As stored, without padding.
struct FileHeader {
    std::array<char, 8> magic{'I', 'S', 'O', 'C', 'H', 'R', 'O', 'N'};
    std::uint32_t version = kFileVersion;
    std::uint32_t byte_order = 0x01020304;
    std::uint64_t file_bytes = 0;
    std::uint64_t content_hash = 0;
    std::array<Section, kSectionNames.size()> sections{};
    std::uint64_t checksum = 0; ///< XXH3 of the 4096 header bytes with this field 0

    Section& section(SectionKind kind) { return sections[static_cast<std::size_t>(kind)]; }
    const Section& section(SectionKind kind) const {
        return sections[static_cast<std::size_t>(kind)];
    }
};
static_assert(sizeof(FileHeader) == 32 + kSectionNames.size() * 24 + 8);

constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// The 4096 header bytes, with the checksum filled in.
std::array<std::byte, kSectionAlignment> header_bytes(FileHeader header);

/// Checks the header of a file and that every section lies within it.
/// @throws Error: foreign, other byte order, other version, damaged header, truncated
FileHeader checked_header(const ByteSource& file);

std::uint64_t checksum_of(std::span<const std::byte> bytes);

} // namespace isochron::index
