// Writes the sections of an index, the last parts of each of its states.
#include "index/build/section_writer.h"

namespace isochron::index {

std::uint64_t
write_sections(const std::vector<std::pair<SectionKind, std::span<const std::byte>>>& sections,
               const IndexFile* held, std::uint64_t end, FileHeader& header, ByteSink& file) {
    std::vector<std::byte> block; // includes the gaps, so that old bytes in them are overwritten
    for (const auto& [kind, bytes] : sections) {
        block.resize(align_up(block.size(), kPartAlignment));
        header.section(kind) = {block.size(), bytes.size(), checksum_of(bytes)};
        block.insert(block.end(), bytes.begin(), bytes.end());
    }
    const IndexFile::Room room = held ? held->free_room() : IndexFile::Room{};
    const std::uint64_t needed = align_up(block.size(), kPartAlignment);
    const std::uint64_t begin = needed <= room.bytes ? room.offset : end;
    for (const auto& [kind, bytes] : sections)
        header.section(kind).offset += begin;
    if (held) {
        block.resize(needed);
        // Writing the last byte makes the file as long as its header says.
        end += begin == end ? align_up(needed + needed / 2, kPartAlignment) : kPartAlignment;
        file.write_at(end - 1, std::vector<std::byte>(1));
    } else {
        end += block.size();
    }
    file.write_at(begin, block);
    return end;
}

} // namespace isochron::index
