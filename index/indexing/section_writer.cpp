// Writes the sections of an index, the last parts of each of its states.
#include "index/indexing/section_writer.h"

#include "index/file/index_states.h"

#include <cstddef>
#include <string>

namespace isochron::index {
namespace {

/// All sections as they lie in the file, and where the sections of the first array begin there.
struct SectionBlock {
    std::vector<std::byte> bytes; ///< with the gaps, so that old bytes in them are overwritten
    std::array<Section, kSectionNames.size()> sections{};
};

/// The sections of the first array lie around the sections of the other arrays: the first array's
/// metadata lists the other arrays, and comes last.
/// @param begin offset of the block in the file
SectionBlock block_at(std::uint64_t begin, std::vector<ArraySections>& arrays) {
    SectionBlock block;
    const auto add = [&](std::span<const std::byte> bytes) {
        block.bytes.resize(align_up(block.bytes.size(), kPartAlignment));
        const Section section{begin + block.bytes.size(), bytes.size(), checksum_of(bytes)};
        block.bytes.insert(block.bytes.end(), bytes.begin(), bytes.end());
        return section;
    };
    const auto add_tables = [&](const ArraySections& array,
                                std::array<Section, kSectionNames.size()>& sections) {
        const auto set = [&](SectionKind kind, const Section& section) {
            sections[static_cast<std::size_t>(kind)] = section;
        };
        set(SectionKind::tree, array.tree);
        set(SectionKind::steps, add(std::as_bytes(std::span(array.steps))));
        set(SectionKind::directory, add({})); // empty: no program writes such parts any more
        set(SectionKind::checksums, add(std::as_bytes(std::span(array.checksums))));
    };
    const auto add_metadata = [&](const Metadata& metadata) {
        const std::string text = to_json(metadata);
        return add(std::as_bytes(std::span(text)));
    };
    constexpr auto kMetadata = static_cast<std::size_t>(SectionKind::metadata);
    Metadata& first = arrays.front().metadata;
    first.further.clear();
    add_tables(arrays.front(), block.sections);
    for (const ArraySections& array : std::span(arrays).subspan(1)) {
        ArrayPlace& place = first.further.emplace_back();
        place.content_hash = array.content_hash;
        add_tables(array, place.sections);
        place.sections[kMetadata] = add_metadata(array.metadata);
    }
    block.sections[kMetadata] = add_metadata(first);
    return block;
}

} // namespace

std::uint64_t write_sections(std::vector<ArraySections>& arrays, const IndexFile* held,
                             std::uint64_t end, FileHeader& header, ByteSink& file) {
    const FreeRoom room = held ? free_room(*held) : FreeRoom{};
    const auto padded = [](const SectionBlock& block) {
        return align_up(block.bytes.size(), kPartAlignment);
    };
    std::uint64_t begin = room.bytes > 0 ? room.offset : end;
    SectionBlock block = block_at(begin, arrays);
    if (begin != end && padded(block) > room.bytes) {
        begin = end;
        block = block_at(begin, arrays);
    }
    if (held) {
        const std::uint64_t needed = padded(block);
        block.bytes.resize(needed);
        // Writing the last byte makes the file as long as its header says.
        end += begin == end ? align_up(needed + needed / 2, kPartAlignment) : kPartAlignment;
        file.write_at(end - 1, std::vector<std::byte>(1));
    } else {
        end += block.bytes.size();
    }
    file.write_at(begin, block.bytes);
    header.content_hash = arrays.front().content_hash;
    header.sections = block.sections;
    header.file_bytes = end;
    return end;
}

} // namespace isochron::index
