// Everything that a user can set while exploring; commands change it, recordings start from it.
#pragma once

#include "index/file/index_file.h"
#include "interaction/commands.h"
#include "stereo/stereo_mode.h"

#include <algorithm>

namespace isochron::app {

struct ExplorerState {
    std::string array; ///< of the surfaces; empty: the first of the index
    std::vector<interaction::Isosurface> isosurfaces{{}}; ///< 1 to kMostIsosurfaces
    std::uint32_t picked = 0;                             ///< surface whose isovalue is moved
    interaction::Coloring coloring;
    interaction::Look look;
    bool bounding_box = true; ///< the box with its ticks and numbers
    std::uint32_t steps = 0;  ///< number that the session shows; 0: all steps of the index
    std::uint32_t step = 0;
    bool follow = false; ///< show a new step when it comes
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

    /// Sets the values that the commands hold. An invalid value (a step beyond the series, an
    /// unknown stereo mode, a number that is not finite) is refused and changes nothing.
    /// @param held number of steps of the index
    /// @return false when a value was refused
    bool apply(const interaction::Commands& commands, std::size_t held);

    /// As `apply`, for a whole state from a recording, a session or a picture. Earlier versions did
    /// not store the look: their states are drawn without occlusion, as those versions drew them.
    bool resume(const interaction::Commands& kept, std::size_t held);

    /// Number of steps that the user can choose from. @param held number of steps of the index
    std::size_t known_steps(std::size_t held) const {
        return steps == 0 ? held : std::min<std::size_t>(steps, held);
    }

    /// Commands that set every field.
    interaction::Commands as_commands() const;

    /// Commands that lead to `target`: they set the fields that differ and can be undone.
    interaction::Commands commands_to(const ExplorerState& target) const;

    /// The query for the cells: step, isovalues in the order of `isosurfaces`, and coloring.
    index::SurfacesQuery surfaces() const;
    bool operator==(const ExplorerState&) const = default;
};

/// The quantile of all values, to within a bin of the histogram: `share` of them are at most this.
/// @param share 0 to 1
double quantile(const index::IndexStats& stats, double share);

} // namespace isochron::app
