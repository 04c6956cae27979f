// Header and section table of the .isochron file: where everything lies, and whether it is intact.
//
// Version 2, little-endian, offsets from the start of the file. The header has 4096 bytes:
// FileHeader, then zeros. The sections follow from 4096 on, those up to `units` at multiples of
// 4096, the others of 64, the gaps zero:
// - volume: stored values, step after step, each step padded with zeros to 64 bytes; empty when the
//   file refers to its sources
// - bricks: extremes of the bricks (bricks.h), step after step, padded likewise
// - units: cells and deltas of every chunk in every epoch (cell_unit.h), each part padded to 64
//   bytes
// - tree: the THI tree's block (thi_tree.h)
// - directory: a UnitEntry for each epoch and chunk, chunks faster
// - checksums: XXH3, 64 bits: of every step of the volume, of every step of the bricks, of cells
//   and deltas of every unit, all without their padding
// - metadata: JSON (metadata.h)
// A section that the plan does without is empty.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace isochron::index {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

constexpr std::uint64_t kSectionAlignment = 4096;
constexpr std::uint64_t kPartAlignment = 64;
constexpr std::uint32_t kFileVersion = 2;

enum class SectionKind : std::uint32_t {
    volume,
    bricks,
    units,
    tree,
    directory,
    checksums,
    metadata
};
constexpr std::array<const char*, 7> kSectionNames{"volume",    "bricks",    "units",   "tree",
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

/// As stored, without padding.
struct FileHeader {
    std::array<char, 8> magic{'I', 'S', 'O', 'C', 'H', 'R', 'O', 'N'};
    std::uint32_t version = kFileVersion;
    std::uint32_t byte_order = 0x01020304;
    std::uint64_t file_bytes = 0;
    std::uint64_t content_hash = 0;
    std::array<Section, kSectionNames.size()> sections{};
    std::uint64_t checksum = 0; ///< XXH3 of the 4096 header bytes with this field 0
    /// Behind what every index has, since few have it: the array to color by, in an otherwise
    /// empty stretch between sections; all zero when there is none. The checksum is that of its
    /// table of checksums.
    Section colors{};

    Section& section(SectionKind kind) { return sections[static_cast<std::size_t>(kind)]; }
    const Section& section(SectionKind kind) const {
        return sections[static_cast<std::size_t>(kind)];
    }
};
static_assert(sizeof(FileHeader) == 32 + kSectionNames.size() * 24 + 8 + 24);

constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// The 4096 header bytes, with the checksum filled in.
std::array<std::byte, kSectionAlignment> header_bytes(FileHeader header);

/// Checks the header of a file and that every section lies within it.
/// @param name of the file, for the message  @param file all of its bytes; only the header is read
/// @throws Error: foreign, other byte order, other version, damaged header, truncated
FileHeader checked_header(const std::string& name, std::span<const std::byte> file);

std::uint64_t checksum_of(std::span<const std::byte> bytes);

} // namespace isochron::index
