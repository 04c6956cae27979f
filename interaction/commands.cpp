// Emptiness and merging of commands.
#include "interaction/commands.h"

namespace isochron::interaction {
namespace {

template <typename T>
void override_with(std::optional<T>& into, const std::optional<T>& later) {
    if (later)
        into = later;
}

} // namespace

bool Commands::empty() const {
    return *this == Commands{};
}

void merge(Commands& into, const Commands& later) {
    // A list that comes later has its isovalues itself.
    if (later.isosurfaces || later.picked)
        into.isovalue.reset();
    override_with(into.isosurfaces, later.isosurfaces);
    override_with(into.picked, later.picked);
    override_with(into.isovalue, later.isovalue);
    override_with(into.step, later.step);
    override_with(into.playback, later.playback);
    override_with(into.room_from_physical, later.room_from_physical);
    override_with(into.quality, later.quality);
    override_with(into.eye_separation, later.eye_separation);
    override_with(into.stereo, later.stereo);
    override_with(into.panel, later.panel);
    override_with(into.grid, later.grid);
    override_with(into.views, later.views);
    override_with(into.axes, later.axes);
    override_with(into.coloring, later.coloring);
    override_with(into.room_panel, later.room_panel);
    override_with(into.mark, later.mark);
    into.screenshot = into.screenshot || later.screenshot;
    into.quit = into.quit || later.quit;
    into.stamps.insert(into.stamps.end(), later.stamps.begin(), later.stamps.end());
    into.haptics.insert(into.haptics.end(), later.haptics.begin(), later.haptics.end());
}

} // namespace isochron::interaction
