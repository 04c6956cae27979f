// Rows of rendering figures as JSON and as a table.
#include "tests/bench/rows/render_rows.h"

#include "tests/bench/rows/record_json.h"

#include <cmath>

namespace isochron::bench {
namespace {

/// Three digits, or all before the point: `0.0123`, `126`, `1034`; a dash without a value.
std::string short_number(const std::optional<double>& value) {
    return !value                     ? "-"
           : std::abs(*value) < 999.5 ? fmt::format("{:.3g}", *value)
                                      : fmt::format("{:.0f}", *value);
}

/// `1024^2`, `2 x 1024^2`.
std::string picture_name(const RenderRow& row) {
    return fmt::format("{}{}^2", row.eyes == 2 ? "2 x " : "", row.size);
}

} // namespace

/// Calls `field(key, member)` for all figures of a row, in the order of the keys.
template <class AnyRow, class Field>
void each_field(AnyRow& row, Field&& field)
    requires std::is_same_v<std::remove_const_t<AnyRow>, RenderRow>
{
    field("data", row.data);
    field("footprint", row.footprint);
    field("size", row.size);
    field("eyes", row.eyes);
    field("threads", row.threads);
    field("context", row.context);
    field("cells", row.cells);
    field("fps", row.fps);
    field("vtk_fps", row.vtk_fps);
    field("bare_fps", row.bare_fps);
    field("p99_over_static", row.p99_over_static);
    field("extract_ms", row.extract_ms);
    field("order_ms", row.order_ms);
    field("upload_ms", row.upload_ms);
    field("draw_ms", row.draw_ms);
    field("quads_ms", row.quads_ms);
    field("frame_cpu_ms", row.frame_cpu_ms);
    field("draw_cpu_ms", row.draw_cpu_ms);
    field("quads_cpu_ms", row.quads_cpu_ms);
    field("bare_cpu_ms", row.bare_cpu_ms);
    field("vtk_cpu_ms", row.vtk_cpu_ms);
    field("worst_over_static", row.worst_over_static);
    field("static_p99_over_static", row.static_p99_over_static);
    field("sent_ids_percent", row.sent_ids_percent);
}

std::string to_json_text(const RenderResults& results) {
    return results_text(results);
}

RenderResults render_results_from_json(const std::string& text, const std::string& name) {
    return results_from_text<RenderResults>(text, name, "isochron-bench render");
}

std::string table_of(const std::vector<RenderRow>& rows) {
    std::string text =
        fmt::format("{:<12} {:<9} {:<10} {:>7} {:<7} {:>6} {:>6} {:>6} {:>6} {:>5} "
                    "{:>8} {:>8} {:>8} {:>8}\n",
                    "series", "footprint", "picture", "threads", "context", "cells", "fps", "vtk",
                    "bare", "p99", "extract", "order", "upload", "draw ms");
    for (const RenderRow& row : rows)
        text += fmt::format("{:<12} {:<9} {:<10} {:>7} {:<7} {:>6.0f} {:>6} {:>6} {:>6} {:>5.3g} "
                            "{:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f}\n",
                            row.data, row.footprint, picture_name(row), row.threads, row.context,
                            row.cells, short_number(row.fps), short_number(row.vtk_fps),
                            short_number(row.bare_fps), row.p99_over_static, row.extract_ms,
                            row.order_ms, row.upload_ms, row.draw_ms);
    return text;
}

} // namespace isochron::bench
