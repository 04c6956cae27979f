// The pass of a build that packs the steps into chunks.
#include "index/build/chunk_pass.h"

#include "index/build/level_choice.h"
#include "index/file/step_levels.h"
#include "index/file/step_packer.h"
#include "index/scan/bricks.h"

#include <optional>

namespace isochron::index {

std::vector<StepEntry> placed_steps(PartWriter& parts, std::vector<StepEntry> mine,
                                    std::uint64_t& end, Team& team) {
    const PartWriter::Placed placed = parts.place(team);
    for (StepEntry& step : mine)
        step.offset += end + placed.start;
    end += placed.bytes;
    return team.gather_items(mine);
}

std::vector<StepEntry> write_chunks(const StepValues& values, std::size_t first,
                                    const MappedFile& volume, const ChunkContents& contents,
                                    ByteSink& file, std::uint64_t& end,
                                    const std::filesystem::path& spill, unsigned threads,
                                    Team& team, const Progress& progress) {
    const auto [mine, mine_end] = team.share(values.steps - first);
    std::optional<PartWriter> parts;
    std::vector<StepEntry> steps;
    team.together([&] {
        parts.emplace(file, end, spill, team);
        StepPacker packer(values.grid, values.type, contents.codec, threads);
        const auto append = [&](std::span<const std::byte> bytes) { parts->append(bytes); };
        std::vector<std::uint8_t> bricks;
        for (std::size_t i = mine; i < mine_end; ++i) {
            const std::size_t step = first + i;
            if (progress)
                progress("packing",
                         static_cast<double>(i - mine) / static_cast<double>(mine_end - mine));
            const auto stored = values.step_bytes(step);
            std::vector<std::byte> levels;
            if (contents.bricks) {
                const LevelMap map = levels_of_step(values.type, stored);
                bricks.resize(BrickGrid(values.grid).bytes_per_step());
                build_bricks(values, map, step, bricks);
                if (has_step_levels(values.type))
                    levels = bytes_of(map);
            }
            const std::uint64_t begin = parts->align(kPartAlignment);
            StepEntry entry = packer.pack(contents.values ? stored : std::span<const std::byte>(),
                                          bricks, append);
            append(levels);
            entry.offset = begin;
            entry.bytes += levels.size();
            steps.push_back(entry);
            volume.let_go(stored);
        }
    });
    return placed_steps(*parts, std::move(steps), end, team);
}

} // namespace isochron::index
