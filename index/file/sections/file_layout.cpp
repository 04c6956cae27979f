// Header and section table of the .isochron file.
#include "index/file/sections/file_layout.h"

#include "index/error.h"
#include "index/shell_word.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <optional>

namespace isochron::index {

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

HeaderSlot header_bytes(FileHeader header) {
    HeaderSlot bytes{};
    header.checksum = 0;
    std::memcpy(bytes.data(), &header, sizeof header);
    header.checksum = checksum_of(bytes);
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

namespace {

/// Checks magic, byte order and version. @param there bytes of the slot that the file has
void check_kind(const std::string& name, const HeaderSlot& slot, std::size_t there) {
    const FileHeader expected;
    const std::size_t known = std::min(there, expected.magic.size());
    if (there == 0 || std::memcmp(slot.data(), expected.magic.data(), known) != 0)
        throw Error("{}: not an isochron index", name);
    FileHeader header;
    std::memcpy(&header, slot.data(), sizeof header);
    if (there < kHeaderBytes)
        throw Error("{}: truncated: {} bytes, the headers alone have {}", name, there, kDataBegin);
    if (header.byte_order != expected.byte_order)
        throw Error("{}: byte order mark {:08x}, expected {:08x}", name, header.byte_order,
                    expected.byte_order);
    if (header.version >= kVersionWithoutSince && header.version <= kFileVersion)
        return;
    const std::string what = fmt::format("{}: file version {}, this program reads versions {} to "
                                         "{}",
                                         name, header.version, kVersionWithoutSince, kFileVersion);
    if (header.version + 1 == kVersionWithoutSince)
        throw Error("{}; isochron build {} -o NEW.isochron converts it", what, shell_word(name));
    throw Error(what);
}

/// Whether the slot holds an intact header of this slot. Compares with the rebuilt slot, so that
/// bytes other than zeros after the header are noticed, too.
bool is_sound(const FileHeader& header, const HeaderSlot& slot, std::uint64_t at) {
    return header_bytes(header) == slot && slot_of(header) == at;
}

} // namespace

OtherSlot other_slot(const ByteSource& file, const FileHeader& counting) {
    HeaderSlot slot{};
    const std::uint64_t at = kDataBegin - kHeaderBytes - slot_of(counting);
    file.read(at, slot);
    OtherSlot other;
    std::memcpy(&other.header, slot.data(), sizeof other.header);
    other.sound = is_sound(other.header, slot, at);
    other.blank = std::ranges::all_of(slot, [](std::byte byte) { return byte == std::byte{0}; });
    return other;
}

FileHeader checked_header(const ByteSource& file) {
    const std::string& name = file.name();
    std::optional<FileHeader> newest;
    for (std::uint64_t number = 0; number < kHeaderSlots; ++number) {
        HeaderSlot slot{};
        const std::uint64_t at = number * kHeaderBytes;
        const std::size_t there = std::min(file.size() - std::min(file.size(), at), kHeaderBytes);
        file.read(at, std::span(slot).first(there));
        if (number == 0)
            check_kind(name, slot, there);
        FileHeader header;
        std::memcpy(&header, slot.data(), sizeof header);
        if (is_sound(header, slot, at) && (!newest || header.sequence > newest->sequence))
            newest = header;
    }
    if (!newest)
        throw Error("{}: damaged header: its checksum does not match", name);
    if (newest->file_bytes > file.size())
        throw Error("{}: truncated: {} bytes, the header says {}", name, file.size(),
                    newest->file_bytes);
    check_sections(file, *newest, "header");
    return *newest;
}

void check_sections(const ByteSource& file, const FileHeader& header, const char* called) {
    for (std::size_t i = 0; i < header.sections.size(); ++i)
        if (const Section& section = header.sections[i];
            section.offset % kPartAlignment || section.offset < kDataBegin ||
            section.offset > header.file_bytes ||
            section.bytes > header.file_bytes - section.offset)
            throw Error("{}: damaged {}: section {} lies outside the file", file.name(), called,
                        kSectionNames[i]);
}

} // namespace isochron::index
