// Header and section table of the .isochron file: where everything lies, and whether it is intact.
//
// Version 1, little-endian, offsets from the start of the file:
//     0     header, 4096 bytes: FileHeader, then zeros
//     4096  sections, each at a multiple of 4096, the gaps zero:
//           volume    stored values, step after step, each step padded with zeros to 64 bytes
//           tree      the THI tree's block (thi_tree.h); empty when there is none
//           metadata  JSON (metadata.h)
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
constexpr std::uint32_t kFileVersion = 1;

enum class SectionKind : std::uint32_t { volume, tree, metadata };
constexpr std::array<const char*, 3> kSectionNames{"volume", "tree", "metadata"};

struct Section {
    std::uint64_t offset = 0, bytes = 0;
    std::uint64_t checksum = 0; ///< XXH3, 64 bits, of the section's bytes
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
static_assert(sizeof(FileHeader) == 32 + 3 * 24 + 8);

constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// The 4096 header bytes, with the checksum filled in.
std::array<std::byte, kSectionAlignment> header_bytes(FileHeader header);

/// Checks the header of a file and that every section lies within it.
/// @param name of the file, for the message  @param file all of its bytes; only the header is read
/// @throws Error: foreign, other byte order, newer version, damaged header, truncated
FileHeader checked_header(const std::string& name, std::span<const std::byte> file);

std::uint64_t checksum_of(std::span<const std::byte> bytes);

} // namespace isochron::index
