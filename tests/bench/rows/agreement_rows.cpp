// Rows of agreement as JSON and as a table.
#include "tests/bench/rows/agreement_rows.h"

#include "tests/bench/rows/record_json.h"

namespace isochron::bench {

template <class AnyRow, class Field>
void each_field(AnyRow& row, Field&& field)
    requires std::is_same_v<std::remove_const_t<AnyRow>, AgreementRow>
{
    field("data", row.data);
    field("footprint", row.footprint);
    field("shape", row.shape);
    field("step", row.step);
    field("isovalue", row.isovalue);
    field("pixels_per_voxel", row.pixels_per_voxel);
    field("cells", row.cells);
    field("exact_percent", row.exact_percent);
    field("extra_percent", row.extra_percent);
    field("missed_percent", row.missed_percent);
    field("offset", row.offset);
    field("luminance_percent", row.luminance_percent);
    field("display_percent", row.display_percent);
    field("draw_ms", row.draw_ms);
}

std::string to_json_text(const AgreementResults& results) {
    return results_text(results);
}

std::string table_of(const std::vector<AgreementRow>& rows) {
    std::string text = fmt::format(
        "{:<12} {:>8} {:>7} {:<9} {:<6} {:>7} {:>8} {:>7} {:>7} {:>7} {:>6} {:>7} {:>8}\n",
        "series", "isovalue", "px/vox", "footprint", "shape", "cells", "extra %", "miss %",
        "offset", "lum %", "disp %", "lit %", "draw ms");
    for (const AgreementRow& row : rows)
        text +=
            fmt::format("{:<12} {:>8.5g} {:>7.3g} {:<9} {:<6} {:>7.0f} {:>8.2f} {:>7.3f} "
                        "{:>7.3f} {:>7.2f} {:>6.2f} {:>7.2f} {:>8.2f}\n",
                        row.data, row.isovalue, row.pixels_per_voxel, row.footprint, row.shape,
                        row.cells, row.extra_percent, row.missed_percent, row.offset,
                        row.luminance_percent, row.display_percent, row.exact_percent, row.draw_ms);
    return text;
}

} // namespace isochron::bench
