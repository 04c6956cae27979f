// The pass of a build that reads and packs the array to color by.
#include "index/build/color_pass.h"

#include "index/build/value_stats.h"
#include "index/error.h"
#include "index/file/detail_levels.h"
#include "index/system/running_checksum.h"

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
                          const PassTarget& target, Team& team, const Progress& progress) {
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
    RunningChecksum checksum;
    std::optional<PartWriter> parts;
    std::vector<StepEntry> steps;
    team.together([&] {
        parts.emplace(target.file, target.end, target.means.beside, team);
        StepWriter writer(info, target.contents, target.means);
        const auto [mine, mine_end] = team.share(info.steps() - first);
        stream_layers(
            series, first + mine, first + mine_end, target.means.threads,
            [&](std::size_t, const LayerView& layer) {
                const auto stored = layer.own();
                add_range(info.type, info.scaling, stored, range.low, range.high, range.nan_values);
                checksum.add(stored);
                writer.take(layer, *parts, steps);
                if (layer.end == info.grid.vertices[2])
                    checksums.push_back(checksum.take());
            },
            [&](double done) {
                if (progress)
                    progress("reading colors", done);
            });
    });
    const ValueRange all = agreed_range(range, team);
    return {
        {.array = info.array,
         .value_unit = info.value_unit,
         .type = info.type,
         .scaling = info.scaling,
         .low = all.low,
         .high = all.high,
         .nan_values = all.nan_values},
        placed_steps(*parts, std::move(steps), detail_grids(info.grid).size(), target.end, team),
        team.gather_items(checksums)};
}

} // namespace isochron::index
