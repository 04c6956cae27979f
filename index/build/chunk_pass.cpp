// The pass of a build that packs the steps into chunks.
#include "index/build/chunk_pass.h"

#include "index/file/step_packer.h"
#include "index/scan/bricks.h"

#include <optional>

namespace isochron::index {

ChunkFindings placed_steps(PartWriter& parts, std::vector<StepEntry> mine, Team& team) {
    const PartWriter::Placed placed = parts.place(team);
    for (StepEntry& step : mine)
        step.offset += placed.start;
    return {placed.bytes, team.gather_items(mine)};
}

ChunkFindings write_chunks(const StepValues& values, const MappedFile& volume,
                           const LevelMap& levels, const ChunkContents& contents, NewFile& file,
                           std::uint64_t offset, const std::filesystem::path& spill,
                           unsigned threads, Team& team, const Progress& progress) {
    const auto [first, last] = team.share(values.steps);
    std::optional<PartWriter> parts;
    std::vector<StepEntry> steps;
    team.together([&] {
        parts.emplace(file, offset, spill, team);
        StepPacker packer(values.grid, values.type, contents.codec, threads);
        std::vector<std::uint8_t> bricks;
        for (std::size_t step = first; step < last; ++step) {
            if (progress)
                progress("packing",
                         static_cast<double>(step - first) / static_cast<double>(last - first));
            if (contents.bricks) {
                bricks.resize(BrickGrid(values.grid).bytes_per_step());
                build_bricks(values, levels, step, bricks);
            }
            const auto stored = values.step_bytes(step);
            const std::uint64_t begin = parts->align(kPartAlignment);
            StepEntry entry =
                packer.pack(contents.values ? stored : std::span<const std::byte>(), bricks,
                            [&](std::span<const std::byte> bytes) { parts->append(bytes); });
            entry.offset = begin;
            steps.push_back(entry);
            volume.let_go(stored);
        }
    });
    return placed_steps(*parts, std::move(steps), team);
}

} // namespace isochron::index
