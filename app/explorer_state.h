// Everything a user can set while exploring: what commands change and recordings start from.
#pragma once

#include "index/index_file.h"
#include "interaction/commands.h"
#include "stereo/stereo_mode.h"

namespace isochron::app {

struct ExplorerState {
    double isovalue = 0;
    std::uint32_t step = 0;
    interaction::PlaybackState playback;
    interaction::Similarity room_from_physical;
    interaction::QualityMode quality = interaction::QualityMode::automatic;
    float eye_separation = 0.063f;
    stereo::StereoMode stereo = stereo::StereoMode::mono;
    bool panel = true;
    bool grid = false; ///< of the floor
    std::vector<interaction::Viewpoint> views;

    /// Sets what the commands carry. A value that cannot be held (a step beyond the series, an
    /// unknown stereo mode, a number that is not finite) leaves the state as it was.
    /// @return false when something was refused
    bool apply(const interaction::Commands& commands, std::size_t steps);

    /// Commands that set every field.
    interaction::Commands as_commands() const;

    index::SurfacesQuery surfaces() const { return {step, {isovalue}}; }
    bool operator==(const ExplorerState&) const = default;
};

/// A first isovalue: the 95 % quantile of all values, where surfaces of interest tend to enclose a
/// small part of the volume.
double first_isovalue(const index::IndexStats& stats);

} // namespace isochron::app
