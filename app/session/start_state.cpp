// The start state of a session.
#include "app/session/start_state.h"

#include "index/error.h"
#include "index/search/index_search.h"

#include <optional>

namespace isochron::app {
namespace {

using index::IndexFile;

/// Range and histogram of a step at a level of detail. There are no other numbers in it.
index::IndexStats stats_of(const IndexFile& array, std::uint32_t step, std::size_t level) {
    const index::SeriesInfo& info = array.info();
    const index::LoadedStep loaded = level > 0 ? array.chunks(level).whole(step) : array.load(step);
    index::IndexStats stats;
    stats.counts.add(info.type, info.scaling, loaded.values.step_bytes(step));
    stats.low = stats.counts.scaled_low(info.scaling);
    stats.high = stats.counts.scaled_high(info.scaling);
    stats.histogram = stats.counts.histogram(info.type, info.scaling);
    return stats;
}

/// Statistics at the coarsest level of detail where the step is not constant; nothing if no such
/// level is small enough.
std::optional<index::IndexStats> stats_of(const IndexFile& array, std::uint32_t step) {
    constexpr std::uint64_t kMostVertices = std::uint64_t{1} << 24;
    for (std::size_t level = array.detail_levels(); level-- > 0;) {
        if (array.chunks(level).info().grid.vertex_count() > kMostVertices)
            break;
        if (index::IndexStats stats = stats_of(array, step, level); stats.low < stats.high)
            return stats;
    }
    return std::nullopt;
}

double first_isovalue(const std::shared_ptr<const IndexFile>& array, std::uint32_t step,
                      double share) {
    const double of_all = quantile(array->stats(), share);
    if (array->info().steps() == 1)
        return of_all;
    try {
        const std::optional<index::IndexStats> here = stats_of(*array, step);
        // Values of coarser levels are means, so the step itself has such values, too.
        if (!here || (here->low < of_all && of_all <= here->high))
            return of_all;
        const auto found = search_in(array, std::nullopt,
                                     index::Shading::none)({index::Instant(step), of_all}, {});
        return found && !found->ids.empty() ? of_all : quantile(*here, share);
    } catch (const index::Error&) { // the search for the first picture will tell
        return of_all;
    }
}

} // namespace

std::vector<interaction::Isosurface> first_surfaces(const Config& config,
                                                    const std::shared_ptr<const IndexFile>& array,
                                                    std::uint32_t step) {
    std::vector<interaction::Isosurface> surfaces;
    for (const ConfiguredSurface& surface : config.surfaces)
        surfaces.push_back(
            {surface.isovalue ? *surface.isovalue : first_isovalue(array, step, surface.quantile),
             surface.color, surface.opacity});
    if (surfaces.empty())
        surfaces.push_back(
            {first_isovalue(array, step, kFirstQuantile), config.rendering.surface_color, 1.0f});
    return surfaces;
}

ExplorerState start_state(const Config& config, const std::shared_ptr<const IndexFile>& file) {
    ExplorerState state;
    static_cast<interaction::Settings&>(state) = config.start;
    if (file->arrays() > 1)
        state.array = file->info().array;
    state.room_from_physical = place(file->info(), config.placement);
    state.between = config.between.value_or(state.between);
    state.steps = static_cast<std::uint32_t>(file->info().steps());
    state.eye_separation = config.installation.viewers.front().eye_separation;
    state.isosurfaces = first_surfaces(config, file, state.instant.step);
    const interaction::Pose eyes{config.installation.viewers.front().position, {1, 0, 0, 0}};
    state.room_panel.pose = interaction::ahead_of(eyes, config.panel.distance);
    state.set_stereo(config.installation.windows.front().stereo);
    return state;
}

} // namespace isochron::app
