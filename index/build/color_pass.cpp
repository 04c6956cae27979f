// The pass of a build that reads the array to color by.
#include "index/build/color_pass.h"

#include "index/build/value_stats.h"
#include "index/error.h"
#include "index/file/detail_levels.h"
#include "index/file/file_layout.h"

#include <fmt/format.h>

#include <optional>

namespace isochron::index {

void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume) {
    if (colors.grid.vertices != volume.grid.vertices || colors.times != volume.times)
        throw Error(fmt::format("array {}: {} vertices and {} steps, array {} has {} and {}",
                                colors.array, colors.grid.vertex_count(), colors.steps(),
                                volume.array, volume.grid.vertex_count(), volume.steps()));
}

ColorFindings read_colors(VolumeSeries& series, std::size_t first, const ColorArray* held,
                          const ChunkContents& contents, ByteSink& file, std::uint64_t& end,
                          const std::filesystem::path& spill, unsigned threads, Team& team,
                          const Progress& progress) {
    const SeriesInfo& info = series.info();
    ValueRange range;
    if (held && team.rank() == 0) {
        range.nan_values = held->nan_values;
        if (held->nan_values < first * info.grid.vertex_count()) {
            range.low = held->low;
            range.high = held->high;
        }
    }
    std::vector<std::uint64_t> checksums;
    std::optional<PartWriter> parts;
    std::vector<StepEntry> steps;
    team.together([&] {
        parts.emplace(file, end, spill, team);
        StepWriter writer(info, {false, contents.values, contents.codec}, threads);
        const auto [mine, mine_end] = team.share(info.steps() - first);
        std::vector<std::uint64_t> words((info.step_bytes() + 7) / 8); // aligned for every type
        const auto stored = std::as_writable_bytes(std::span(words)).first(info.step_bytes());
        for (std::size_t i = mine; i < mine_end; ++i) {
            if (progress)
                progress("reading colors",
                         static_cast<double>(i - mine) / static_cast<double>(mine_end - mine));
            series.read(first + i, stored);
            add_range(info.type, info.scaling, stored, range.low, range.high, range.nan_values);
            checksums.push_back(checksum_of(stored));
            writer.write(stored, *parts, steps);
        }
    });
    const ValueRange all = agreed_range(range, team);
    return {{.array = info.array,
             .value_unit = info.value_unit,
             .type = info.type,
             .scaling = info.scaling,
             .low = all.low,
             .high = all.high,
             .nan_values = all.nan_values},
            placed_steps(*parts, std::move(steps), detail_grids(info.grid).size(), end, team),
            team.gather_items(checksums)};
}

} // namespace isochron::index
