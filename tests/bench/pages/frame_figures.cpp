// The figures of the first page on pictures and frames.
#include "tests/bench/pages/figure_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <string_view>
#include <utility>

namespace isochron::bench {
namespace {

/// How far outlines are from the outline of the exact surface: the middle one of the surfaces.
void add_outlines(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    constexpr double kPixels = 4;
    std::vector<AgreementRow> rows;
    if (input.agreement)
        std::ranges::copy_if(
            input.agreement->rows, std::back_inserter(rows),
            [](const AgreementRow& row) { return row.pixels_per_voxel == kPixels; });
    if (rows.empty())
        return;
    std::ranges::stable_sort(rows, {}, &AgreementRow::cells);
    const double middle = rows[rows.size() / 2].cells;
    BarChart chart{.title = "Distance of the outline from the exact surface's, in voxels",
                   .bars = {}};
    std::vector<Bar> ours;
    for (const AgreementRow& row : rows) {
        if (row.cells != middle)
            continue;
        chart.bars.push_back(
            {fmt::format("{}, {}", row.footprint == "quad" ? "quads" : "splats",
                         row.shape == "plane" ? "on the surface" : "as in the paper"),
             row.offset, fmt::format("{:.2f}", row.offset), row.shape == "plane"});
        if (chart.bars.back().ours)
            ours.push_back(chart.bars.back());
    }
    if (!ours.empty())
        figures.push_back(
            {"outlines", "How true are pictures in motion?",
             fmt::format("The outline is {} of a voxel away from the outline of the exact surface, "
                         "on average, where a voxel takes {} pixels. Pictures at rest show the "
                         "exact surface.",
                         range_of(ours), kPixels),
             source_of(input.names.agreement, input.agreement->header), chart});
}

std::string name_of(std::string_view footprint) {
    return footprint == "quad"       ? "quads"
           : footprint == "gaussian" ? "splats"
           : footprint == "mesh"     ? "triangles"
                                     : "exact surface";
}

Bar per_second(std::string label, double value, bool ours) {
    return {std::move(label), value, short_number(value) + " fps", ours};
}

/// Whole frames while time plays, drawn by the processor.
void add_processor_frames(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    if (!input.render)
        return;
    BarChart chart{.title = "Time plays: frames a second, two cores, no GPU, 1024^2", .bars = {}};
    double vtk = 0;
    for (const RenderRow& row : input.render->rows)
        if (row.data == "vorticity64" && row.size == 1024 && row.eyes == 1 && row.threads == 2) {
            chart.bars.push_back(per_second(name_of(row.footprint), row.fps, true));
            vtk = std::max(vtk, row.vtk_fps.value_or(0));
        }
    if (chart.bars.empty())
        return;
    if (vtk > 0)
        chart.bars.push_back(per_second("VTK, flying edges", vtk, false));
    figures.push_back({"frames_processor", "How fast does time play without a GPU?",
                       "Each frame finds the cells of the next step of a 64^3 flow, and draws "
                       "them. While you move, what keeps up is drawn; the exact surface "
                       "follows once nothing moves.",
                       source_of(input.names.render, input.render->header), chart});
}

/// The same on a GPU: the last table of the file that names VTK's pace, too.
void add_gpu_frames(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    BarChart chart{.title = "Time plays: frames a second on a GPU, 1024^2", .bars = {}};
    std::string source;
    double vtk = 0;
    for (const std::string& line : lines_of(input.gpu)) {
        static const std::regex kLine(
            R"(^vorticity64\s+(\w+)\s+1024\^2\s+1 egl\s+\d+\s+(\d+)\s+(\d+)\s)");
        if (line.starts_with("commit "))
            source = fmt::format("`{}`, {}", input.names.gpu, line);
        if (std::smatch match; std::regex_search(line, match, kLine)) {
            chart.bars.push_back(per_second(name_of(match[1].str()), number(match, 2), true));
            vtk = std::max(vtk, number(match, 3));
        }
    }
    if (chart.bars.empty())
        return;
    chart.bars.push_back(per_second("VTK, flying edges", vtk, false));
    figures.push_back(
        {"frames_gpu", "And with a GPU?",
         "The same flow and picture on an NVIDIA H100, with one core for the search. The flow is "
         "small for a GPU.",
         source, chart});
}

/// Frames of a live session on a GPU, of which a display wants one every 11.1 ms.
void add_live_frames(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    BarChart chart{.title = "Live at 90 Hz, both eyes, on a GPU: time of a frame, in ms",
                   .bars = {},
                   .mark = 1000.0 / 90,
                   .mark_text = "a frame of 90 Hz"};
    std::string grid, frames, missed, machine;
    for (const std::string& line : lines_of(input.gpu)) {
        static const std::regex kGrid(R"(\b(\d+\^3) u8, [\d,]+ cells at)");
        static const std::regex kFrames(R"(^(\d+) frames\s+median)");
        static const std::regex kTotal(R"(^\s+total\s+([\d.]+)\s+([\d.]+)\s+([\d.]+))");
        static const std::regex kMissed(R"(^\s+missed\s+(\d+) refreshes)");
        std::smatch match;
        if (std::regex_search(line, match, kGrid))
            grid = match[1].str();
        else if (line.starts_with("EGL, OpenGL"))
            machine = line;
        else if (std::regex_search(line, match, kFrames))
            frames = match[1].str();
        else if (!grid.empty() && std::regex_search(line, match, kTotal)) {
            chart.bars.push_back(
                milliseconds(grid + ": half of the frames", number(match, 1), true));
            chart.bars.push_back(milliseconds("99 of 100", number(match, 2), true));
            chart.bars.push_back(milliseconds("the longest", number(match, 3), true));
        } else if (!grid.empty() && std::regex_search(line, match, kMissed)) {
            missed += fmt::format("{}{} of {} refreshes with {}", missed.empty() ? "" : ", and ",
                                  match[1].str(), frames, grid);
            grid.clear();
        }
    }
    if (!chart.bars.empty())
        figures.push_back(
            {"live_frames", "Does a live session keep its pace?",
             fmt::format("A recording of a head that rests, sways and walks, and of drags of "
                         "isovalue and time, was played live at the pace of a headset. It missed "
                         "{}.",
                         missed),
             fmt::format("`{}`, {}", input.names.gpu, machine), chart});
}

} // namespace

void add_frame_figures(const FirstPageInput& input, std::vector<PageFigure>& figures) {
    add_processor_frames(input, figures);
    add_gpu_frames(input, figures);
    add_live_frames(input, figures);
    add_outlines(input, figures);
}

} // namespace isochron::bench
