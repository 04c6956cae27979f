// The settings of a session; commands change them, recordings start from them.
#pragma once

#include "index/file/index_file.h"
#include "interaction/commands.h"
#include "interaction/step_gaps.h"
#include "stereo/stereo_mode.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace isochron::app {

/// The isovalue, in a query, of a surface that is not one of the query's array: it has no active cells.
inline constexpr double kNoSurface = std::numeric_limits<double>::infinity();

struct ExplorerState : interaction::Settings {
    stereo::StereoMode stereo_mode() const { return *stereo::stereo_mode_from_name(stereo); }
    void set_stereo(stereo::StereoMode mode) { stereo = stereo::name_of(mode); }

    /// Sets the values that the commands hold. An invalid value (a step beyond the series, an
    /// unknown stereo mode, a number that is not finite) is refused and changes nothing.
    /// @param held number of steps of the index
    /// @return false when a value was refused
    bool apply(const interaction::Commands& commands, std::size_t held);

    /// What `apply` would refuse: a line for each setting, with its value and what is expected.
    std::vector<std::string> refusals(const interaction::Commands& commands,
                                      std::size_t held) const;

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
    /// Commands that lead back to the start state, except for displays, viewpoints and tools.
    interaction::Commands way_to_start(const ExplorerState& start) const;

    /// The query for the cells: instant, isovalues in the order of `isosurfaces`, `kNoSurface`
    /// for those of other arrays, and coloring.
    index::SurfacesQuery surfaces() const;
    /// Whether the value there is of the picked surface's array, so that it may be its isovalue.
    bool is_of_picked(const interaction::MarkedPoint& point) const {
        return point.array == isosurfaces[picked].array;
    }
    bool operator==(const ExplorerState&) const = default;
};

/// The number of a surface's array, as `index::IndexFile::array` takes it; where the file lacks it, that
/// of the shown array. @param surface number of the surface @param file all its arrays
std::size_t array_of_surface(const ExplorerState& state, std::size_t surface,
                             const index::IndexFile& file);

/// The settings of pieces as a query has them.
index::PieceFilter filter_of(const interaction::ShownPieces& pieces);

/// When the first steps of a series are, and where it has gaps. @param steps 0: all
interaction::StepTimes known_times(const index::SeriesInfo& info, std::size_t steps);

/// The quantile of all values, to within a bin of the histogram: `share` of them are at most this.
/// @param share 0 to 1
double quantile(const index::IndexStats& stats, double share);

} // namespace isochron::app
