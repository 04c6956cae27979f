// The part of the page of results on rendering.
#include "tests/bench/pages/render_page.h"

#include "tests/bench/pages/paper_tables.h"
#include "tests/bench/pages/render_goals.h"
#include "tests/bench/pages/short_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace isochron::bench {

namespace {

constexpr std::string_view kReading =
    "- A *frame* extracts the next step from the index, sends it to GL, sorts it where splats "
    "blend, draws it and waits until it is drawn. Fast quads come without the volume around their "
    "cells, which follows in a session when motion ends. Where the processor draws, splats blend "
    "in display values, as in a session. The camera's angle is 45 degrees, the volume's bounding "
    "sphere touches the picture. Wall-clock medians over all steps and rounds; our frames, VTK's, "
    "bare quads and static draws take turns at every step.\n"
    "- *VTK*: `vtkFlyingEdges3D` with normals and VTK's own renderer, for the same step, in the "
    "same GL context and on as many processors.\n"
    "- *bare*: only the drawing of plain quads, of one flat color, whose corners lie ready: what "
    "this GL can do. Footprints are drawn as points where no footprint crosses an edge of the "
    "picture, and where the processor draws only those that are seen: no quads that are hidden, no "
    "splats that would change a byte by less than its rounding; *as quads* is the time without "
    "either.\n"
    "- *ids that a GPU is sent*: as differences from step to step, in percent of the sets' ids. "
    "Where the processor draws, cells come with their normals, all of them.\n"
    "- *p99*: while time plays and the isovalue is dragged by 10 % to and fro, with the extraction "
    "on its own thread: the time of a frame over the median of three draws of the very cells that "
    "it showed; the 99th percentile over the frames, 500 of them where these take no more than "
    "three seconds. *noise* is the same of those draws themselves.\n\n";

const RenderRow* find(const RenderResults& results, std::string_view data,
                      std::string_view footprint, unsigned threads) {
    constexpr int kSize = 512;
    const auto found =
        std::find_if(results.rows.begin(), results.rows.end(), [&](const RenderRow& row) {
            return row.data == data && row.footprint == footprint && row.threads == threads &&
                   row.size == kSize && row.eyes == 1;
        });
    return found == results.rows.end() ? nullptr : &*found;
}

std::string table3(const RenderResults& results) {
    std::string text = "| mode | | sphere | vorticity |\n|---|---|---|---|\n";
    for (const PublishedRates& published : kTable3) {
        text += fmt::format("| {} | paper, GeForce 4 | {} | {} |\n", published.mode,
                            published.sphere, published.vorticity);
        for (const unsigned threads : {1u, 2u}) {
            const auto rate = [&](std::string_view data) {
                const RenderRow* row = find(results, data, published.footprint, threads);
                return row ? fmt::format("{:.0f}", row->fps) : "-";
            };
            text +=
                fmt::format("| | here, software GL, {} {} | {} | {} |\n", threads,
                            threads == 1 ? "core" : "cores", rate("sphere"), rate("vorticity64"));
        }
    }
    return text;
}

std::string number(const std::optional<double>& value) {
    return value ? short_number(*value) : "-";
}

std::string all_rows(const std::vector<RenderRow>& rows) {
    std::string text =
        "| series | footprint | picture | cores | context | cells | fps | VTK fps | bare fps | "
        "extract ms | order ms | upload ms | draw ms | as quads ms | p99 | worst | noise |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const RenderRow& row : rows)
        text += fmt::format("| {} | {} | {} | {} | {} | {:.0f} | {} | {} | {} | {:.3f} | {:.3f} "
                            "| {:.3f} | {:.3g} | {} | {:.3g} | {:.3g} | {:.3g} |\n",
                            row.data, row.footprint, picture_name(row), row.threads, row.context,
                            row.cells, short_number(row.fps), number(row.vtk_fps),
                            number(row.bare_fps), row.extract_ms, row.order_ms, row.upload_ms,
                            row.draw_ms, number(row.quads_ms), row.p99_over_static,
                            row.worst_over_static, row.static_p99_over_static);
    return text;
}

/// The table of processor times, which do not depend on other work on the machine.
std::string processor_table(const std::vector<RenderRow>& rows) {
    std::string text =
        "| series | footprint | picture | cores | context | frame ms | VTK ms | draw ms | as quads "
        "ms | bare ms |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const RenderRow& row : rows)
        text += fmt::format("| {} | {} | {} | {} | {} | {:.3g} | {} | {:.3g} | {} | {} |\n",
                            row.data, row.footprint, picture_name(row), row.threads, row.context,
                            row.frame_cpu_ms, number(row.vtk_cpu_ms), row.draw_cpu_ms,
                            number(row.quads_cpu_ms), number(row.bare_cpu_ms));
    return text;
}

} // namespace

std::string render_section(const RenderResults& results, const std::string& source) {
    const Header& header = results.header;
    std::string text = fmt::format(
        "\n# Rendering, measured\n\nMade from `{}`. Measured on {} with commit {}, {}, on {}, {} "
        "threads.\n\n",
        source, header.date, header.commit, header.compiler, header.processor, header.threads);
    text += kReading;
    text += "## Goals of rendering\n\nThe worst figure of all rows that a goal speaks of decides; "
            "all on two cores.\n\n" +
            render_goals_table(results.rows) + "\n";
    text += "## Table 3: frames per second, extraction and rendering\n\nAt 512^2.\n\n" +
            table3(results) + "\n";
    text += "![ShellSplatting and fast quads](pictures/vorticity64_quality_fast.png)\n\n"
            "*As the paper's Figure 5: a single step of the vorticity in high quality "
            "(ShellSplatting, left) and fast (quads, right), the same view.*\n\n";
    text += "## Every picture\n\n" + all_rows(results.rows) +
            "\n### Processor time\n\nOf all threads together, medians: others who use the machine "
            "lengthen it less than the times above.\n\n" +
            processor_table(results.rows);
    return text;
}

} // namespace isochron::bench
