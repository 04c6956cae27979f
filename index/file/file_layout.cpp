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

FileHeader checked_header(const ByteSource& file) {
    const std::string& name = file.name();
    const FileHeader expected;
    std::array<std::byte, kSectionAlignment> start{};
    const std::size_t there = std::min<std::uint64_t>(file.size(), start.size());
    file.read(0, std::span(start).first(there));
    const std::size_t known = std::min(there, expected.magic.size());
    if (there == 0 || std::memcmp(start.data(), expected.magic.data(), known) != 0)
        throw Error(fmt::format("{}: not an isochron index", name));
    if (there < kSectionAlignment)
        throw Error(fmt::format("{}: truncated: {} bytes, the header alone has {}", name,
                                file.size(), kSectionAlignment));
    FileHeader header;
    std::memcpy(&header, start.data(), sizeof header);
    if (header.byte_order != expected.byte_order)
        throw Error(fmt::format("{}: byte order mark {:08x}, expected {:08x}", name,
                                header.byte_order, expected.byte_order));
    if (header.version == kFileVersion - 1)
        throw Error(
            fmt::format("{}: file version {}, this program reads version {}; isochron build "
                        "{} -o NEW.isochron makes one of it",
                        name, header.version, kFileVersion, name));
    if (header.version != kFileVersion)
        throw Error(fmt::format("{}: file version {}, this program reads version {}", name,
                                header.version, kFileVersion));
    // Rebuilding the header also notices anything but zeros behind it.
    if (header_bytes(header) != start)
        throw Error(fmt::format("{}: damaged header: its checksum does not match", name));
    if (header.file_bytes != file.size())
        throw Error(fmt::format("{}: {}: {} bytes, the header says {}", name,
                                file.size() < header.file_bytes ? "truncated" : "wrong size",
                                file.size(), header.file_bytes));
    for (std::size_t i = 0; i < header.sections.size(); ++i)
        if (const Section& section = header.sections[i];
            section.offset % kPartAlignment || section.offset < kSectionAlignment ||
            section.offset > file.size() || section.bytes > file.size() - section.offset)
            throw Error(fmt::format("{}: damaged header: section {} lies outside the file", name,
                                    kSectionNames[i]));
    return header;
}

} // namespace isochron::index
