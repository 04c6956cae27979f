// Divides the memory by what a cell was measured to take.
#include "app/quality/cell_room.h"

#include "app/telling.h"
#include "index/system/memory_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

/// What a cell takes while its set is made and sent, with its share of the volume around it; measured
/// in replays of 0.04 and 2.9 million cells.
constexpr std::uint64_t kBytesOfCell = 300;
constexpr std::uint64_t kProgram =
    400 << 20; ///< [bytes] of all but cells and cache, libraries included
constexpr std::uint64_t kFewest = 1 << 16;

} // namespace

std::uint64_t cells_in_memory(std::uint64_t memory, std::uint64_t cache) {
    const std::uint64_t others = cache + kProgram;
    return std::max(kFewest, (memory - std::min(memory, others)) / kBytesOfCell);
}

std::optional<std::string> limit_to_memory(DetailChooser& details, std::uint64_t cells,
                                           std::uint64_t memory, std::uint64_t cache) {
    const std::uint64_t room = cells_in_memory(memory, cache);
    if (room >= std::min(details.most(), cells))
        return std::nullopt;
    details.limit(room);
    return fmt::format("surfaces of more than {} cells are shown at a coarser level of detail: the "
                       "program may use {} MiB of memory",
                       room, memory >> 20);
}

std::vector<std::string> limit_to_memory(DetailChooser& details, const index::IndexFile& file) {
    std::vector<std::string> lines;
    if (auto line = limit_to_memory(details, file.info().grid.cell_count(), index::memory_limit(),
                                    file.cache_bytes()))
        lines.push_back(std::move(*line));
    for (const std::string& line : lines) // nobody sees the panel of a replay
        print_note("{}", line);
    return lines;
}

} // namespace isochron::app
