// The goals of rendering, compared with the measured figures.
#include "tests/bench/pages/render_goals.h"

#include "tests/bench/pages/goal.h"

#include <algorithm>

namespace isochron::bench {

namespace {

using RenderFigure = std::function<std::optional<double>(const RenderRow&)>;

constexpr unsigned kThreads = 2; // for which all goals are given

/// The figure for rows of one footprint (empty: any), series (empty: any) and size of picture.
RenderFigure of(const std::string& footprint, const std::string& data, int size,
                const RenderFigure& figure, int eyes = 1) {
    return [=](const RenderRow& row) -> std::optional<double> {
        if ((!footprint.empty() && row.footprint != footprint) ||
            (!data.empty() && row.data != data) || row.size != size || row.eyes != eyes ||
            row.threads != kThreads)
            return std::nullopt;
        return figure(row);
    };
}

std::optional<double> fps(const RenderRow& row) {
    return row.fps;
}

std::optional<double> over_vtk(const RenderRow& row) {
    return row.vtk_fps ? std::optional(row.fps / *row.vtk_fps) : std::nullopt;
}

std::optional<double> drawn_over_bare(const RenderRow& row) {
    return row.bare_fps ? std::optional(1e-3 * row.draw_ms * *row.bare_fps) : std::nullopt;
}

std::optional<double> quads_over_bare(const RenderRow& row) {
    return row.bare_fps && row.quads_ms ? std::optional(1e-3 * *row.quads_ms * *row.bare_fps)
                                        : std::nullopt;
}

std::optional<double> p99(const RenderRow& row) {
    return row.threads == kThreads ? std::optional(row.p99_over_static) : std::nullopt;
}

std::optional<double> sent_ids(const RenderRow& row) {
    return row.sent_ids_percent;
}

/// A row's rate relative to that of splats in the same picture.
RenderFigure over_splats(const std::vector<RenderRow>& rows) {
    return [&rows](const RenderRow& row) -> std::optional<double> {
        const auto splats = std::find_if(rows.begin(), rows.end(), [&](const RenderRow& other) {
            return other.footprint == "gaussian" && other.data == row.data &&
                   other.size == row.size && other.eyes == row.eyes &&
                   other.threads == row.threads && other.context == row.context;
        });
        return splats == rows.end() ? std::nullopt : std::optional(row.draw_ms / splats->draw_ms);
    };
}

std::vector<Goal<RenderRow>> all_goals(const std::vector<RenderRow>& rows) {
    return {
        {"fast quads, sphere, 512^2", " fps", 600, 250, true, of("quad", "sphere", 512, fps)},
        {"ShellSplatting, sphere, 512^2", " fps", 150, 50, true,
         of("gaussian", "sphere", 512, fps)},
        {"fast quads, vorticity 64^3, 512^2", " fps", 600, 284, true,
         of("quad", "vorticity64", 512, fps)},
        {"ShellSplatting, vorticity 64^3, 512^2", " fps", 150, 46, true,
         of("gaussian", "vorticity64", 512, fps)},
        {"whole time-scrub frame of fast quads against VTK, 1024^2", "x", 4, 2, true,
         of("quad", "", 1024, over_vtk)},
        {"the same of meshes", "x", 2, 1.4, true, of("mesh", "", 1024, over_vtk)},
        {"the same of meshes, both eyes", "x", 2, 1.3, true, of("mesh", "", 1024, over_vtk, 2)},
        {"fast quads, those that are seen, against all bare quads, 512^2", "x", 1.1, 1.3, false,
         of("quad", "", 512, drawn_over_bare)},
        {"fast quads, all of them, against bare quads, 512^2", "x", 1.1, 1.3, false,
         of("quad", "", 512, quads_over_bare)},
        {"99th percentile of frame over static draw", "x", 1.3, 2, false, p99},
        {"ids that a GPU is sent from step to step, of all, sphere", " %", 20, 40, false,
         of("", "sphere", 512, sent_ids)},
        {"surface against ShellSplatting, 1024^2", "x", 0.7, 1.3, false,
         of("surface", "", 1024, over_splats(rows))},
    };
}

} // namespace

std::string render_goals_table(const std::vector<RenderRow>& rows) {
    return table_of(all_goals(rows), rows);
}

} // namespace isochron::bench
