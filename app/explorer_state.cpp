// Everything a user can set while exploring.
#include "app/explorer_state.h"

#include <cmath>
#include <numeric>

namespace isochron::app {

bool ExplorerState::apply(const interaction::Commands& commands, std::size_t steps) {
    bool taken = true;
    const auto set = [&](auto& field, const auto& value, bool valid) {
        if (valid)
            field = value;
        else
            taken = false;
    };
    if (commands.isovalue)
        set(isovalue, *commands.isovalue, std::isfinite(*commands.isovalue));
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
    if (commands.views)
        set(views, *commands.views, commands.views->size() <= interaction::kMostViews);
    return taken;
}

interaction::Commands ExplorerState::as_commands() const {
    interaction::Commands all;
    all.isovalue = isovalue;
    all.step = step;
    all.playback = playback;
    all.room_from_physical = room_from_physical;
    all.quality = quality;
    all.eye_separation = eye_separation;
    all.stereo = std::string(stereo::name_of(stereo));
    all.panel = panel;
    all.grid = grid;
    all.views = views;
    return all;
}

double first_isovalue(const index::IndexStats& stats) {
    const auto& bins = stats.histogram;
    const auto total = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        below += bins[bin];
        if (static_cast<double>(below) >= 0.95 * static_cast<double>(total))
            return std::lerp(stats.low, stats.high,
                             (static_cast<double>(bin) + 0.5) / static_cast<double>(bins.size()));
    }
    return std::midpoint(stats.low, stats.high);
}

} // namespace isochron::app
