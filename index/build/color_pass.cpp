// The pass of a build that reads the array to color by.
#include "index/build/color_pass.h"

#include "index/build/value_stats.h"
#include "index/error.h"
#include "index/file/color_array.h"
#include "index/file/file_layout.h"
#include "index/file/metadata.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {

void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume) {
    if (colors.grid.vertices != volume.grid.vertices || colors.times != volume.times)
        throw Error(fmt::format("array {}: {} vertices and {} steps, array {} has {} and {}",
                                colors.array, colors.grid.vertex_count(), colors.steps(),
                                volume.array, volume.grid.vertex_count(), volume.steps()));
}

ColorArray read_colors(VolumeSeries& series, NewFile& file, std::uint64_t offset, bool with_values,
                       Team& team, const Progress& progress, std::uint64_t& table_checksum) {
    const SeriesInfo& info = series.info();
    const std::size_t stride = step_stride(info.step_bytes());
    const std::uint64_t values = offset + ColorSection::table_bytes(info.steps());
    ValueRange range;
    std::vector<std::uint64_t> checksums;
    team.together([&] {
        const auto [first, last] = team.share(info.steps());
        std::vector<std::byte> step(stride); // its padding stays zero
        const auto stored = std::span(step).first(info.step_bytes());
        for (std::size_t t = first; t < last; ++t) {
            if (progress)
                progress("reading colors",
                         static_cast<double>(t - first) / static_cast<double>(last - first));
            series.read(t, stored);
            add_range(info.type, info.scaling, stored, range.low, range.high, range.nan_values);
            checksums.push_back(checksum_of(stored));
            if (with_values)
                file.write_at(values + t * stride, step);
        }
    });
    const ValueRange all = agreed_range(range, team);
    std::vector<std::uint64_t> table = team.gather_items(checksums);
    table_checksum = checksum_of(std::as_bytes(std::span(table)));
    table.resize(ColorSection::table_bytes(info.steps()) / sizeof(std::uint64_t));
    team.together([&] {
        if (team.rank() == 0)
            file.write_at(offset, std::as_bytes(std::span(table)));
    });
    return {.array = info.array,
            .value_unit = info.value_unit,
            .type = info.type,
            .scaling = info.scaling,
            .low = all.low,
            .high = all.high,
            .nan_values = all.nan_values};
}

} // namespace isochron::index
