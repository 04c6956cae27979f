// Earlier states of an index: hashes, a damaged newer header, and the room that a state leaves.
#include "index/file/index_states.h"

#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/series_content.h"
#include "index/system/links/link_source.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

/// Most numbers of first steps whose hashes are tried, which takes some tenths of a second.
constexpr std::size_t kHashedSteps = 1 << 14;

bool is_whole(const ByteSource& file, const Section& section) {
    if (section.bytes == 0 || section.offset > file.size() ||
        section.bytes > file.size() - section.offset)
        return false;
    std::vector<std::byte> bytes(section.bytes);
    file.read(section.offset, bytes);
    return checksum_of(bytes) == section.checksum;
}

/// A number that changes with every state of a file that grows, and with the size that was found when it
/// was opened, perhaps in an earlier state.
std::uint64_t newest_state(const ByteSource& bytes) {
    std::uint64_t state = bytes.size();
    for (std::uint64_t slot = 0; slot < kHeaderSlots; ++slot) {
        HeaderSlot stored{};
        const std::uint64_t at = slot * kHeaderBytes;
        const std::uint64_t there =
            std::min(bytes.size() - std::min(bytes.size(), at), kHeaderBytes);
        bytes.read(at, std::span(stored).first(there));
        state = state * 31 + checksum_of(stored);
    }
    return state;
}

} // namespace

std::shared_ptr<const IndexFile> open_newest(const OpenBytes& open, std::uint64_t cache_bytes) {
    constexpr int kMostTimes = 8;
    for (int time = 1;; ++time) {
        std::unique_ptr<ByteSource> bytes = open();
        const std::uint64_t state = newest_state(*bytes);
        try {
            return IndexFile::open(std::move(bytes), cache_bytes);
        } catch (const Error&) {
            if (time == kMostTimes || newest_state(*open()) == state)
                throw;
        }
    }
}

std::shared_ptr<const IndexFile> IndexFile::open(const std::filesystem::path& path,
                                                 std::uint64_t cache_bytes) {
    const auto file = open_newest([&] { return open_bytes(path); }, cache_bytes);
    // The file of another machine that grows goes on: its chunks stay where they are.
    if (const auto* const remote = remote_of(file->bytes()))
        remote->accept_where([hash = file->content_hash(), steps = file->info().steps()](auto now) {
            return has_had(*IndexFile::open(std::move(now)), hash, steps);
        });
    return file;
}

bool has_had(const IndexFile& file, std::uint64_t content_hash, std::size_t steps) {
    return content_hash_of(file.info(), file.checksums().first(steps)) == content_hash;
}

bool has_had(const IndexFile& file, std::uint64_t content_hash) {
    const auto& earlier = file.metadata().earlier;
    if (content_hash == file.content_hash() ||
        std::ranges::find(earlier, content_hash) != earlier.end())
        return true;
    for (std::size_t steps = std::min(file.info().steps() - 1, kHashedSteps); steps > 0; --steps)
        if (has_had(file, content_hash, steps))
            return true;
    return false;
}

std::optional<std::string> lost_state(const IndexFile& file) {
    const OtherSlot other = other_slot(file.bytes(), file.header());
    if (other.sound || other.blank)
        return std::nullopt;
    // A header fits in one sector of any disk, so a power failure leaves it either whole or
    // unwritten; a broken one has been damaged later. Sections only grow, so a larger section is
    // newer; but the first state after that of an earlier program names its unused parts no longer,
    // and may have a larger section `steps` alone.
    const bool unused = other.header.section(SectionKind::directory).bytes >
                        file.header().section(SectionKind::directory).bytes;
    for (std::size_t i = 0; i < kSectionNames.size(); ++i)
        if (const Section& section = other.header.sections[i];
            (!unused || i == static_cast<std::size_t>(SectionKind::steps)) &&
            section.bytes > file.header().sections[i].bytes && is_whole(file.bytes(), section))
            return fmt::format(
                "{}: the header of a newer state is damaged, though what it names is "
                "whole: its first {} steps are what is left; isochron build makes "
                "it anew",
                file.name(), file.info().steps());
    return std::nullopt;
}

FreeRoom free_room(const IndexFile& file) {
    const FileHeader& header = file.header();
    const OtherSlot other = other_slot(file.bytes(), header);
    if (!other.sound || other.header.section(SectionKind::tree).bytes > 0)
        return {};
    FreeRoom room{header.file_bytes, 0};
    for (const Section& section : other.header.sections)
        if (section.bytes > 0)
            room.offset = std::min(room.offset, section.offset);
    std::uint64_t end = header.file_bytes;
    for (const auto& [offset, bytes] : file.parts())
        if (bytes > 0 && offset + bytes > room.offset)
            end = std::min(end, std::max(offset, room.offset));
    room.bytes = end - room.offset;
    return room;
}

} // namespace isochron::index
