// Header and section table of the .isochron file: the offsets and checksums of all its parts.
//
// Version 5, little-endian, offsets from the start of the file. The file begins with two slots for
// a header, of 4096 bytes each: FileHeader, then zeros. The header that counts is the intact one
// with the higher sequence number; a new index has only the first. The parts begin at 8192:
// - for each array and step: the step's chunks, their tables and the levels of their bricks
//   (chunk_table.h, step_levels.h), at a multiple of 64
// - parts that are no longer used, each at a multiple of 64: programs up to version 0.2 could write
//   search structures here that no program searches now
// - the sections, at multiples of 64. tree: the THI tree's block (thi_tree.h). steps: a StepEntry
//   for each step, array after array: the volume and its levels of detail, then the array to color
//   by and its levels. directory: an UnusedParts for each two parts that are no longer used.
//   checksums: XXH3, 64 bits, of the stored values of every step of the volume, of every part that is
//   no longer used, and of the stored values of every step of the array to color by; then for each
//   step the state of its source (VolumeSeries::state), which shows whether it has changed, 0 if
//   unknown.
//   metadata: JSON (metadata.h)
// A section that the plan does not have is empty. Gaps of fewer than 64 bytes are zero; larger gaps
// hold parts of earlier headers.
//
// To append, a writer writes new parts after the end of the file or into gaps, flushes, writes the
// slot of the header that does not count, and flushes again. The parts of the other header stay. The
// new state names no parts that are no longer used.
#pragma once

#include "index/system/byte_source.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

constexpr std::uint64_t kHeaderBytes = 4096;
constexpr std::uint64_t kHeaderSlots = 2;
constexpr std::uint64_t kDataBegin = kHeaderSlots * kHeaderBytes;
constexpr std::uint64_t kPartAlignment = 64;
constexpr std::uint32_t kFileVersion = 5;
/// Up to this version `fitting` packs values of several bytes with Zstandard (chunk_codec.h). What is
/// appended to such a file has its version.
constexpr std::uint32_t kVersionWithoutWideRows = 4;
/// The oldest version that is read: its tables of chunks do not say since when chunks have stayed
/// (chunk_table.h). What is appended to such a file has its version.
constexpr std::uint32_t kVersionWithoutSince = 3;

enum class SectionKind : std::uint32_t { tree, steps, directory, checksums, metadata };
constexpr std::array<const char*, 5> kSectionNames{"tree", "steps", "directory", "checksums",
                                                   "metadata"};

struct Section {
    std::uint64_t offset = 0, bytes = 0;
    std::uint64_t checksum = 0; ///< XXH3, 64 bits
};

/// Two parts that an earlier program wrote and no program uses any more.
struct UnusedParts {
    struct Part {
        std::uint64_t offset = 0, bytes = 0;
    };
    std::array<Part, 2> parts;
    std::uint64_t entries = 0; ///< without a meaning now
};
static_assert(sizeof(UnusedParts) == 40);

/// Offset and size of the chunks of a step of one array.
struct StepEntry {
    std::uint64_t offset = 0, bytes = 0;
    std::uint64_t tables = 0; ///< byte offset of the tables of the layers from `offset`
};

/// As stored, without padding.
struct FileHeader {
    std::array<char, 8> magic{'I', 'S', 'O', 'C', 'H', 'R', 'O', 'N'};
    std::uint32_t version = kFileVersion;
    std::uint32_t byte_order = 0x01020304;
    std::uint64_t sequence = 0;   ///< 0 for a new index, then 1 more each time it has grown
    std::uint64_t file_bytes = 0; ///< size of the file; bytes after it are ignored
    std::uint64_t content_hash = 0;
    std::array<Section, kSectionNames.size()> sections{};
    std::uint64_t checksum = 0; ///< XXH3 of the 4096 header bytes with this field 0

    Section& section(SectionKind kind) { return sections[static_cast<std::size_t>(kind)]; }
    const Section& section(SectionKind kind) const {
        return sections[static_cast<std::size_t>(kind)];
    }
};
static_assert(sizeof(FileHeader) == 40 + kSectionNames.size() * 24 + 8);

constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// The bytes of a header's slot, with the checksum filled in.
using HeaderSlot = std::array<std::byte, kHeaderBytes>;
HeaderSlot header_bytes(FileHeader header);
/// Byte offset of a header's slot.
constexpr std::uint64_t slot_of(const FileHeader& header) {
    return header.sequence % kHeaderSlots * kHeaderBytes;
}

/// Finds the header that counts, and checks that every section lies within the file.
/// @throws Error: foreign, other byte order, other version, damaged header, truncated
FileHeader checked_header(const ByteSource& file);

/// @throws Error when a section lies outside the file @param called the header's name, for this
void check_sections(const ByteSource& file, const FileHeader& header, const char* called);

/// The slot beside the slot of the header that counts.
struct OtherSlot {
    bool sound = false; ///< it holds an older, intact header
    bool blank = false; ///< all zeros: it was never written
    FileHeader header;
};
OtherSlot other_slot(const ByteSource& file, const FileHeader& counting);

std::uint64_t checksum_of(std::span<const std::byte> bytes);

} // namespace isochron::index
