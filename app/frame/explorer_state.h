// Everything a user can set while exploring: what commands change and recordings start from.
#pragma once

#include "index/file/index_file.h"
#include "interaction/commands.h"
#include "stereo/stereo_mode.h"

#include <algorithm>

namespace isochron::app {

struct ExplorerState {
    std::vector<interaction::Isosurface> isosurfaces{{}}; ///< 1 to kMostIsosurfaces
    std::uint32_t picked = 0;                             ///< the one that the isovalue moves
    interaction::Coloring coloring;
    interaction::Look look;
    bool bounding_box = true; ///< the box with its ticks and numbers
    std::uint32_t steps = 0;  ///< of the series, as far as the session knows; 0: all of them
    std::uint32_t step = 0;
    bool follow = false; ///< a new step is shown when it comes
    interaction::PlaybackState playback;
    interaction::Similarity room_from_physical;
    interaction::QualityMode quality = interaction::QualityMode::automatic;
    float eye_separation = 0.063f;
    stereo::StereoMode stereo = stereo::StereoMode::mono;
    bool panel = true;
    interaction::RoomPanel room_panel;
    interaction::Mark mark;
    interaction::Tools tools;
    interaction::ClipPlane clip;
    interaction::Ruler ruler;
    bool orthographic = false; ///< desktop screens show a parallel projection
    bool leaving = false;      ///< the user is asked whether to leave
    bool grid = false;         ///< of the floor
    std::vector<interaction::Viewpoint> views;

    double isovalue() const { return isosurfaces[picked].isovalue; }
    void set_isovalue(double isovalue) { isosurfaces[picked].isovalue = isovalue; }

    /// Sets what the commands carry. A value that cannot be held (a step beyond the series, an
    /// unknown stereo mode, a number that is not finite) leaves the state as it was.
    /// @param held steps of the index
    /// @return false when something was refused
    bool apply(const interaction::Commands& commands, std::size_t held);

    /// How many steps there are to choose from. @param held of the index
    std::size_t known_steps(std::size_t held) const {
        return steps == 0 ? held : std::min<std::size_t>(steps, held);
    }

    /// Commands that set every field.
    interaction::Commands as_commands() const;

    /// Commands that set what differs in `target`, of the fields whose changes can be undone.
    interaction::Commands commands_to(const ExplorerState& target) const;

    /// The step, every surface's isovalue, in the order of `isosurfaces`, and what colors them.
    index::SurfacesQuery surfaces() const;
    bool operator==(const ExplorerState&) const = default;
};

/// The value that this share of all values does not exceed, to the width of a histogram's bin.
/// @param share 0 to 1
double quantile(const index::IndexStats& stats, double share);

} // namespace isochron::app
