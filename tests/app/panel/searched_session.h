// A session whose search has a line for every control.
#pragma once

#include "app/panel/search_table.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// A session with all that has lines: three arrays, two surfaces, a mark, a ruler and a clip plane.
struct Searched {
    Searched() {
        for (int step = 0; step < 200; ++step)
            info.times.push_back(0.5 * step);
        info.array = "vorticity";
        info.grid.vertices = {64, 64, 64};
        stats.low = 0;
        stats.high = 100;
        stats.histogram.assign(256, 1);
        asked.isosurfaces = {{.isovalue = 40}, {.isovalue = 60}};
        asked.mark.point.emplace();
        asked.rulers.list = {{.name = "1", .places = {glm::dvec3(0.0), glm::dvec3(1.0)}},
                             {.name = "2"}};
        asked.clip.shown = true;
        asked.clip_box.shown = true;
        asked.slices.planes.emplace_back();
        asked.models.push_back({.path = "models/hull.stl"});
        asked.ghosts.earlier = 1;
        asked.pieces.dust = 20;
        asked.look.light = {30.0, 40.0};
        asked.keys.resize(2);
        asked.keys.back().time = 2;
        asked.keys.back().name = "front arrives";
        asked.keys.back().text = "It comes from the left.";
        asked.views = {{"1", {}}, {"2", {}}};
    }
    PanelModel model() {
        PanelModel all{
            .info = info, .stats = stats, .asked = asked, .frame = report, .controls = controls};
        all.arrays.names = names;
        all.arrays.color_names = names;
        all.arrays.way_to = [this](std::size_t i) {
            interaction::Commands commands;
            commands.array = names[i];
            return commands;
        };
        all.colors.range = {0.0, 1.0};
        all.movies = {.offered = true, .recorded = true};
        return all;
    }
    std::vector<SearchLine> lines() { return search_lines(held.emplace(model())); }

    std::array<std::string, 3> names{"vorticity", "temperature", "pressure"};
    index::SeriesInfo info;
    index::IndexStats stats;
    ExplorerState asked;
    FrameReport report;
    std::vector<interaction::ControlGroup> controls;
    std::optional<PanelModel> held; ///< model of the last lines
};

} // namespace isochron::app
