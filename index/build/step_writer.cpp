// Packing of a step and of its levels of detail.
#include "index/build/step_writer.h"

#include "index/build/level_choice.h"
#include "index/file/detail_levels.h"
#include "index/file/step_levels.h"
#include "index/scan/bricks.h"

namespace isochron::index {

StepWriter::StepWriter(const SeriesInfo& info, const ChunkContents& contents, unsigned threads)
    : type_(info.type), contents_(contents), threads_(threads), grids_(detail_grids(info.grid)) {
    for (const Grid& grid : grids_) {
        packers_.emplace_back(grid, type_, contents.codec, threads);
        const std::size_t bytes = grid.vertex_count() * size_of(type_);
        coarse_.emplace_back(&grid == grids_.data() ? 0 : (bytes + 7) / 8);
    }
}

void StepWriter::write(std::span<const std::byte> stored, PartWriter& parts,
                       std::vector<StepEntry>& entries) {
    write_level(0, stored, parts, entries);
    for (std::size_t level = 1; level < grids_.size(); ++level) {
        const auto coarse = std::as_writable_bytes(std::span(coarse_[level]))
                                .first(grids_[level].vertex_count() * size_of(type_));
        coarsen(type_, grids_[level - 1], stored, coarse, threads_);
        write_level(level, coarse, parts, entries);
        stored = coarse;
    }
}

void StepWriter::write_level(std::size_t level, std::span<const std::byte> stored,
                             PartWriter& parts, std::vector<StepEntry>& entries) {
    const auto append = [&](std::span<const std::byte> bytes) { parts.append(bytes); };
    std::vector<std::byte> levels;
    if (contents_.bricks) {
        const StepValues values{.grid = grids_[level],
                                .type = type_,
                                .scaling = {},
                                .steps = 1,
                                .first = stored.data(),
                                .stride = stored.size()};
        const LevelMap map = levels_of_step(type_, stored);
        bricks_.resize(BrickGrid(values.grid).bytes_per_step());
        build_bricks(values, map, 0, bricks_);
        if (has_step_levels(type_))
            levels = bytes_of(map);
    }
    const bool carries = contents_.values || level > 0;
    const std::uint64_t begin = parts.align(kPartAlignment);
    StepEntry entry =
        packers_[level].pack(carries ? stored : std::span<const std::byte>(), bricks_, append);
    append(levels);
    entry.offset = begin;
    entry.bytes += levels.size();
    entries.push_back(entry);
}

std::vector<StepEntry> by_level(std::span<const StepEntry> by_step, std::size_t levels) {
    std::vector<StepEntry> entries;
    for (std::size_t level = 0; level < levels; ++level)
        for (std::size_t i = level; i < by_step.size(); i += levels)
            entries.push_back(by_step[i]);
    return entries;
}

} // namespace isochron::index
