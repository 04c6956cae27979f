// The pass of a build that packs the steps into chunks.
#include "index/build/chunk_pass.h"

#include "index/file/detail_levels.h"

#include <optional>

namespace isochron::index {

std::vector<StepEntry> placed_steps(PartWriter& parts, std::vector<StepEntry> mine,
                                    std::size_t levels, std::uint64_t& end, Team& team) {
    const PartWriter::Placed placed = parts.place(team);
    for (StepEntry& step : mine)
        step.offset += end + placed.start;
    end += placed.bytes;
    return by_level(team.gather_items(mine), levels);
}

std::vector<StepEntry> write_chunks(const SeriesInfo& info, const StepValues& values,
                                    std::size_t first, const MappedFile& volume,
                                    const ChunkContents& contents, ByteSink& file,
                                    std::uint64_t& end, const std::filesystem::path& spill,
                                    unsigned threads, Team& team, const Progress& progress) {
    const auto [mine, mine_end] = team.share(values.steps - first);
    std::optional<PartWriter> parts;
    std::vector<StepEntry> steps;
    team.together([&] {
        parts.emplace(file, end, spill, team);
        StepWriter writer(info, contents, threads);
        for (std::size_t i = mine; i < mine_end; ++i) {
            if (progress)
                progress("packing",
                         static_cast<double>(i - mine) / static_cast<double>(mine_end - mine));
            const auto stored = values.step_bytes(first + i);
            writer.write(stored, *parts, steps);
            volume.let_go(stored);
        }
    });
    return placed_steps(*parts, std::move(steps), detail_grids(info.grid).size(), end, team);
}

} // namespace isochron::index
