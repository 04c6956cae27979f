// Everything a user can set while exploring.
#include "app/frame/explorer_state.h"

#include "render/passes/color_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochron::app {
namespace {

bool holds(const std::vector<interaction::Isosurface>& surfaces) {
    return !surfaces.empty() && surfaces.size() <= interaction::kMostIsosurfaces &&
           std::ranges::all_of(surfaces, [](const interaction::Isosurface& surface) {
               return std::isfinite(surface.isovalue) && surface.opacity >= 0 &&
                      surface.opacity <= 1;
           });
}

} // namespace

bool ExplorerState::apply(const interaction::Commands& commands, std::size_t steps) {
    bool taken = true;
    const auto set = [&](auto& field, const auto& value, bool valid) {
        if (valid)
            field = value;
        else
            taken = false;
    };
    if (commands.isosurfaces && holds(*commands.isosurfaces)) {
        isosurfaces = *commands.isosurfaces;
        picked = std::min(picked, static_cast<std::uint32_t>(isosurfaces.size() - 1));
    } else if (commands.isosurfaces) {
        taken = false;
    }
    if (commands.picked)
        set(picked, *commands.picked, *commands.picked < isosurfaces.size());
    if (commands.isovalue)
        set(isosurfaces[picked].isovalue, *commands.isovalue, std::isfinite(*commands.isovalue));
    if (commands.coloring)
        set(coloring, *commands.coloring,
            render::color_map_from_name(commands.coloring->map).has_value());
    if (commands.axes)
        axes = *commands.axes;
    if (commands.step)
        set(step, *commands.step, *commands.step < steps);
    if (commands.playback)
        set(playback, *commands.playback,
            commands.playback->speed >= interaction::kSlowest &&
                commands.playback->speed <= interaction::kFastest);
    if (commands.room_from_physical)
        set(room_from_physical, *commands.room_from_physical,
            std::isfinite(commands.room_from_physical->scale) &&
                commands.room_from_physical->scale > 0);
    if (commands.quality)
        quality = *commands.quality;
    if (commands.eye_separation)
        set(eye_separation, *commands.eye_separation,
            *commands.eye_separation >= 0 && *commands.eye_separation <= interaction::kWidestEyes);
    if (commands.stereo) {
        const auto mode = stereo::stereo_mode_from_name(*commands.stereo);
        set(stereo, mode.value_or(stereo), mode.has_value());
    }
    if (commands.panel)
        panel = *commands.panel;
    if (commands.grid)
        grid = *commands.grid;
    if (commands.room_panel)
        set(room_panel, *commands.room_panel, is_finite(commands.room_panel->pose));
    if (commands.mark)
        set(mark, *commands.mark, !commands.mark->point || commands.mark->point->step < steps);
    if (commands.views)
        set(views, *commands.views, commands.views->size() <= interaction::kMostViews);
    return taken;
}

index::SurfacesQuery ExplorerState::surfaces() const {
    index::SurfacesQuery query{step, {}};
    switch (coloring.by) {
    case interaction::ColorBy::surface: break;
    case interaction::ColorBy::value: query.coloring = index::CellColoring::value; break;
    case interaction::ColorBy::first_crossing:
        query.coloring = index::CellColoring::first_crossing;
        break;
    }
    for (const interaction::Isosurface& surface : isosurfaces)
        query.isovalues.push_back(surface.isovalue);
    return query;
}

interaction::Commands ExplorerState::as_commands() const {
    interaction::Commands all;
    all.isosurfaces = isosurfaces;
    all.picked = picked;
    all.isovalue = isovalue();
    all.coloring = coloring;
    all.axes = axes;
    all.step = step;
    all.playback = playback;
    all.room_from_physical = room_from_physical;
    all.quality = quality;
    all.eye_separation = eye_separation;
    all.stereo = std::string(stereo::name_of(stereo));
    all.panel = panel;
    all.grid = grid;
    all.views = views;
    all.room_panel = room_panel;
    all.mark = mark;
    return all;
}

double quantile(const index::IndexStats& stats, double share) {
    const auto& bins = stats.histogram;
    const auto total = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        below += bins[bin];
        if (static_cast<double>(below) >= share * static_cast<double>(total))
            return std::lerp(stats.low, stats.high,
                             (static_cast<double>(bin) + 0.5) / static_cast<double>(bins.size()));
    }
    return std::midpoint(stats.low, stats.high);
}

} // namespace isochron::app
