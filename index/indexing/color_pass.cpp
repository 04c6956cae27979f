// Packs the array to color by, while a build reads the steps.
#include "index/indexing/color_pass.h"

#include "index/error.h"
#include "index/file/detail_levels.h"

namespace isochron::index {

void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume) {
    if (colors.grid.vertices != volume.grid.vertices || colors.times != volume.times)
        throw Error("array {}: {} vertices and {} steps, array {} has {} and {}", colors.array,
                    colors.grid.vertex_count(), colors.steps(), volume.array,
                    volume.grid.vertex_count(), volume.steps());
}

ColorPass::ColorPass(VolumeSeries& series, std::size_t first, const ColorArray* held,
                     const ChunkContents& contents, const WriterMeans& means, const Team& team)
    : series_(series), writer_(series.info(), contents, means) {
    if (!held || team.rank() > 0)
        return;
    range_.nan_values = held->nan_values;
    if (held->nan_values < first * series.info().grid.vertex_count()) {
        range_.low = held->low;
        range_.high = held->high;
    }
}

void ColorPass::take(const LayerView& layer, PartWriter& parts) {
    const SeriesInfo& info = series_.info();
    const auto stored = layer.own();
    add_range(info.type, info.scaling, stored, range_.low, range_.high, range_.nan_values);
    checksum_.add(stored);
    writer_.take(layer, parts, steps_);
    if (layer.end == info.grid.vertices[2])
        checksums_.push_back(checksum_.take());
}

ColorFindings ColorPass::agreed(std::uint64_t begin, Team& team) {
    const SeriesInfo& info = series_.info();
    const ValueRange all = agreed_range(range_, team);
    return {{.array = info.array,
             .value_unit = info.value_unit,
             .type = info.type,
             .scaling = info.scaling,
             .low = all.low,
             .high = all.high,
             .nan_values = all.nan_values},
            agreed_steps(std::move(steps_), begin, detail_grids(info.grid).size(), team),
            team.gather_items(checksums_)};
}

} // namespace isochron::index
