// Passes on since when chunks have stayed.
#include "index/indexing/chunk_history.h"

#include "index/file/chunks/chunk_table.h"

#include <cstring>

namespace isochron::index {
namespace {

/// What a member that begins in the middle says of chunks that have stayed since before its steps.
std::uint32_t unknown_of(std::size_t begin) {
    return static_cast<std::uint32_t>(begin - 1);
}

/// History of the step before a member's first one. @param told by each member: where it begins,
/// then StepWriter::since
std::vector<std::uint32_t> since_before(const std::vector<std::vector<std::uint32_t>>& told,
                                        std::size_t fresh, unsigned rank) {
    std::vector<std::uint32_t> since;
    for (unsigned member = 0; member < rank; ++member) {
        if (told[member].size() <= 1) // it had no steps
            continue;
        const std::uint32_t begin = told[member].front();
        const std::span<const std::uint32_t> own = std::span(told[member]).subspan(1);
        since.resize(own.size());
        for (std::size_t i = 0; i < own.size(); ++i)
            if (begin == fresh || own[i] != unknown_of(begin))
                since[i] = own[i];
    }
    return since;
}

/// Puts the right step into the entries of a table. @return whether it had some to correct
bool correct(std::span<std::byte> table, std::uint32_t unknown,
             std::span<const std::uint32_t> since) {
    bool corrected = false;
    for (std::size_t place = 0; place < since.size(); ++place) {
        std::byte* const at = table.data() + sizeof(LayerHead) + place * sizeof(ChunkEntry);
        ChunkEntry entry;
        std::memcpy(&entry, at, sizeof entry);
        if (entry.since != unknown)
            continue;
        corrected = true;
        entry.since = since[place];
        std::memcpy(at, &entry, sizeof entry);
    }
    LayerHead head;
    std::memcpy(&head, table.data(), sizeof head);
    head.checksum = checksum_of(table.subspan(sizeof head.checksum));
    std::memcpy(table.data(), &head, sizeof head);
    return corrected;
}

} // namespace

std::vector<std::uint32_t> held_since(const IndexFile& held, bool colors) {
    std::vector<std::uint32_t> since;
    const auto last = static_cast<std::uint32_t>(held.info().steps() - 1);
    for (std::size_t level = 0; level < held.detail_levels(); ++level) {
        const ChunkStore& store = colors ? *held.color_chunks(level) : held.chunks(level);
        for (std::uint32_t layer = 0; layer < store.grid().layers(); ++layer) {
            const ChunkLayerPtr table = store.layer(last, layer);
            since.insert(since.end(), table->since.begin(), table->since.end());
        }
    }
    return since;
}

void settle_since(const StepWriter& writer, std::span<const StepEntry> entries,
                  const MemberSteps& steps, PartWriter& parts, Team& team) {
    if (team.size() == 1)
        return;
    std::vector<std::uint32_t> mine{static_cast<std::uint32_t>(steps.begin)};
    if (steps.begin < steps.end) {
        const std::vector<std::uint32_t> own = writer.since();
        mine.insert(mine.end(), own.begin(), own.end());
    }
    std::vector<std::vector<std::uint32_t>> told;
    for (const std::vector<std::byte>& bytes : team.gather(std::as_bytes(std::span(mine)))) {
        told.emplace_back(bytes.size() / sizeof(std::uint32_t));
        std::memcpy(told.back().data(), bytes.data(), bytes.size());
    }
    const std::vector<std::uint32_t> before = since_before(told, steps.fresh, team.rank());
    if (before.empty() || steps.begin == steps.fresh || steps.begin >= steps.end)
        return;
    std::vector<std::byte> table;
    for (std::size_t level = 0; level < writer.levels(); ++level) {
        bool more = true; // chunks that stay until this step
        for (std::size_t i = level; more && i < entries.size(); i += writer.levels()) {
            more = false;
            writer.for_each_table(
                level, entries[i],
                [&](std::uint64_t begin, std::uint32_t chunks, std::size_t first) {
                    const std::uint64_t at = entries[i].offset + begin;
                    table.resize(layer_table_bytes(chunks));
                    parts.read(at, table);
                    if (!correct(table, unknown_of(steps.begin),
                                 std::span(before).subspan(first, chunks)))
                        return;
                    parts.replace(at, table);
                    more = true;
                });
        }
    }
}

} // namespace isochron::index
