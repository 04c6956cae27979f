// The start state of a session.
#include "app/session/start_state.h"

#include <vector>

namespace isochron::app {

std::vector<interaction::Isosurface> first_surfaces(const Config& config,
                                                    const index::IndexStats& stats) {
    std::vector<interaction::Isosurface> surfaces;
    for (const ConfiguredSurface& surface : config.surfaces)
        surfaces.push_back({surface.isovalue.value_or(quantile(stats, surface.quantile)),
                            surface.color, surface.opacity});
    if (surfaces.empty())
        surfaces.push_back({quantile(stats, kFirstQuantile), config.surface_color, 1.0f});
    return surfaces;
}

ExplorerState start_state(const Config& config, const index::IndexFile& file) {
    ExplorerState state;
    if (file.arrays() > 1)
        state.array = file.info().array;
    state.room_from_physical = place(file.info(), config.placement);
    state.quality = config.quality;
    state.grid = config.grid;
    state.steps = static_cast<std::uint32_t>(file.info().steps());
    state.eye_separation = config.installation.viewers.front().eye_separation;
    state.isosurfaces = first_surfaces(config, file.stats());
    state.coloring = config.coloring;
    state.look = config.look;
    state.bounding_box = config.bounding_box;
    const interaction::Pose eyes{config.installation.viewers.front().position, {1, 0, 0, 0}};
    state.room_panel = {config.panel.room, interaction::ahead_of(eyes, config.panel.distance)};
    state.stereo = config.installation.windows.front().stereo;
    return state;
}

} // namespace isochron::app
