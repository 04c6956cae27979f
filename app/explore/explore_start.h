// How a session of `explore` begins: its configuration, checks, windows.
#pragma once

#include "app/explore/cluster_job.h"
#include "app/explore/explore_options.h"
#include "app/session/session.h"
#include "index/file/index_file.h"
#include "stereo/windows.h"

#include <cstddef>

namespace isochron::app {

/// The configuration with what the command line says. @throws UsageError
Config configure(const ExploreOptions& options);

/// Warns of what is wrong with a configuration, or missing for it.
void warn(const Config& config);

/// Warns if the data lack the array that the configuration colors by.
void warn_of_colors(const Config& config, const index::IndexFile& file);

/// @param steps of the whole series; the file may have only the first of them
/// @throws UsageError when the session cannot start as it was asked to
void check_start(const ExploreOptions& options, const index::IndexFile& file, std::size_t steps);

/// Checks the paths of outputs, so that a wrong one does not show, or destroy a file, only at the
/// end of the session.
/// @param file that is explored
void check_outputs(const ExploreOptions& options, const ClusterJob& job,
                   const index::IndexFile& file);

/// The session's start, with the data filling the window, seen from a corner, where mouse and
/// keyboard play the head and the configuration asks for that.
ExplorerState filling_window(Session& session, const Config& config, const index::SeriesInfo& info);

/// The number of the array to begin with where nobody names one: the first that has surfaces.
std::size_t first_array(const index::IndexFile& file);
/// The number of the array to begin with: the one that the options name, else the first that has
/// surfaces.
std::size_t first_array(const ExploreOptions& options, const index::IndexFile& file);
/// Why the first array is not the one to begin with; empty: it is, or the options name one.
std::string passed_over(const ExploreOptions& options, const index::IndexFile& file);

/// The session's state as the options ask for it: showing the array that they name, if any, with
/// first surfaces that suit the step that they name.
/// @throws index::Error when the index lacks the array
ExplorerState first_look(const Session& session, const ExploreOptions& options,
                         const Config& config, const std::shared_ptr<const index::IndexFile>& file);

/// The state to begin with. @param steps that the data have now
ExplorerState start_from(ExplorerState state, const ExploreOptions& options, std::size_t steps);
/// What is shown between two steps where the options do not say it: what `isochron info
/// --measure-time` advises. Where the index cannot be read, the first search will tell.
interaction::BetweenSteps advised_between(const index::IndexFile& file);

/// @param headset mirrored by the first window; it paces the frames, not that window's display
stereo::Windows open_windows(const ExploreOptions& options, const Config& config,
                             const ClusterJob& job, const stereo::Headset* headset);

} // namespace isochron::app
