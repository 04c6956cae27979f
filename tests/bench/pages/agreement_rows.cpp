// Rows of agreement as JSON and as a table.
#include "tests/bench/pages/agreement_rows.h"

#include "tests/bench/pages/record_json.h"

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

AgreementResults agreement_results_from_json(const std::string& text, const std::string& name) {
    return results_from_text<AgreementResults>(text, name,
                                               "isochron-bench render --agreement-only");
}

std::string agreement_section(const AgreementResults& results, const std::string& source) {
    std::string page = fmt::format(
        "\n# Footprints beside the exact surface\n\n"
        "From `{}`, measured on {} with commit {} on {}. Quads and splats of both shapes, *plane* "
        "(flat pieces and ellipses on the surface, the default) and *voxel* (the paper's spheres), "
        "beside the "
        "exact surface in the same view: perspective, alone on black. *Extra* and *missed* are "
        "pixels that one lights and the other does not, of those of the exact surface; a pixel is "
        "lit where half of the light behind it is stopped. *Offset* is the area between the two "
        "silhouettes over the length of the exact one, in voxels. *Luminance* is the mean "
        "difference where both light, in percent of the exact surface's mean, in linear light; "
        "*display* the same of display values, in percent of white. *Draw* is processor time of "
        "all threads.\n\n"
        "| series | isovalue | cells | pixels a voxel | footprint | shape | extra % | missed % | "
        "offset | luminance % | display % | draw ms |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        source, results.header.date, results.header.commit, results.header.processor);
    for (const AgreementRow& row : results.rows)
        page +=
            fmt::format("| {} | {:.5g} | {:.0f} | {:.3g} | {} | {} | {:.1f} | {:.2f} | {:.2f} | "
                        "{:.1f} | {:.1f} | {:.1f} |\n",
                        row.data, row.isovalue, row.cells, row.pixels_per_voxel, row.footprint,
                        row.shape, row.extra_percent, row.missed_percent, row.offset,
                        row.luminance_percent, row.display_percent, row.draw_ms);
    return page;
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
