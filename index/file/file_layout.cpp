// Header and section table of the .isochron file.
#include "index/file/file_layout.h"

#include "index/error.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>

namespace isochron::index {

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::array<std::byte, kSectionAlignment> header_bytes(FileHeader header) {
    std::array<std::byte, kSectionAlignment> bytes{};
    header.checksum = 0;
    std::memcpy(bytes.data(), &header, sizeof header);
    header.checksum = checksum_of(bytes);
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

FileHeader checked_header(const std::string& name, std::span<const std::byte> file) {
    FileHeader header;
    const FileHeader expected;
    const std::size_t known = std::min(file.size(), expected.magic.size());
    if (file.empty() || std::memcmp(file.data(), expected.magic.data(), known) != 0)
        throw Error(fmt::format("{}: not an isochron index", name));
    if (file.size() < kSectionAlignment)
        throw Error(fmt::format("{}: truncated: {} bytes, the header alone has {}", name,
                                file.size(), kSectionAlignment));
    std::memcpy(&header, file.data(), sizeof header);
    if (header.byte_order != expected.byte_order)
        throw Error(fmt::format("{}: byte order mark {:08x}, expected {:08x}", name,
                                header.byte_order, expected.byte_order));
    if (header.version != kFileVersion)
        throw Error(fmt::format("{}: file version {}, this program reads version {}", name,
                                header.version, kFileVersion));
    // Rebuilding the header also notices anything but zeros behind it.
    if (std::memcmp(header_bytes(header).data(), file.data(), kSectionAlignment) != 0)
        throw Error(fmt::format("{}: damaged header: its checksum does not match", name));
    if (header.file_bytes != file.size())
        throw Error(fmt::format("{}: {}: {} bytes, the header says {}", name,
                                file.size() < header.file_bytes ? "truncated" : "wrong size",
                                file.size(), header.file_bytes));
    const auto expect_inside = [&](const Section& section, const char* called) {
        if (section.offset % kPartAlignment || section.offset < kSectionAlignment ||
            section.offset > file.size() || section.bytes > file.size() - section.offset)
            throw Error(
                fmt::format("{}: damaged header: section {} lies outside the file", name, called));
    };
    for (std::size_t i = 0; i < header.sections.size(); ++i)
        expect_inside(header.sections[i], kSectionNames[i]);
    if (header.colors.bytes > 0)
        expect_inside(header.colors, "colors");
    return header;
}

} // namespace isochron::index
