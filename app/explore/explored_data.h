// Data to explore: an index, or files of values that are indexed while they are shown.
#pragma once

#include "app/explore/cluster_job.h"
#include "app/explore/explore_options.h"
#include "app/indexing/indexing.h"
#include "app/panel/panel_model.h"
#include "stereo/windows.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Whether these name one index, to be shown as it is. A file called `.isochron` counts as one, as
/// it may be a damaged index.
bool is_index_name(const std::vector<std::string>& files);

/// The options, with `data` set if an index was given.
/// @throws index::Error, UsageError
ExploreOptions with_index(ExploreOptions options);

/// If files of values were given: starts to make or complete their index in the user's cache
/// folder; else returns null.
/// @param asks there is a window in which a user can choose an array
/// @throws index::Error, UsageError when that cannot be, or the files cannot be opened
std::unique_ptr<Indexing> begin_indexing(const ExploreOptions& options, const ClusterJob& job,
                                         bool asks);

/// Waits in the first window until the step to start at can be shown; where the files have arrays of
/// several shapes, the user chooses one there.
/// @param canceled set when Escape ended the wait
/// @return the index; nothing: the user does not want to wait @throws index::Error when indexing has failed
std::optional<std::string> wait_for_index(Indexing& indexing, const stereo::Windows& windows,
                                          const ExploreOptions& options, const Config& config,
                                          bool& canceled);

/// The name to offer later among recent data; empty if it would not do: reading the data takes
/// options, or several names.
std::optional<std::string> name_to_remember(const ExploreOptions& options);

/// Arrays as the panel lists them.
std::vector<ListedArray> listed(const std::vector<ArrayOffer>& offers);

/// The options for other data, without those that were meant for the first data only.
/// @param data a file, a folder, or a pattern
ExploreOptions with_data(ExploreOptions options, const std::string& data);
/// The options for another array of the data, without those that were meant for the first array
/// only.
ExploreOptions with_other_array(ExploreOptions options, const std::string& array);

} // namespace isochron::app
