// Data to explore: an index, or files of values that are indexed while they are shown.
#pragma once

#include "app/commands/cluster_job.h"
#include "app/commands/explore_options.h"
#include "app/commands/indexing.h"
#include "stereo/windows.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Whether these are the name of one index, which is shown as it is. What is no index may still be
/// a damaged one.
bool is_index_name(const std::vector<std::string>& files);

/// With the index to show, if one was given.
/// @throws index::Error, UsageError
ExploreOptions with_index(ExploreOptions options);

/// Where files of values were given: makes their index, or goes on with one, in the user's cache
/// folder; else null.
/// @throws index::Error, UsageError when that cannot be, or the files cannot be opened
std::unique_ptr<Indexing> begin_indexing(const ExploreOptions& options, const ClusterJob& job);

/// Waits in the first window until the step to start at can be shown.
/// @return the index; nothing: the user leaves @throws index::Error when indexing has failed
std::optional<std::string> wait_for_index(const Indexing& indexing, const stereo::Windows& windows,
                                          const ExploreOptions& options, const Config& config);

/// What the user can be offered later to open these data; nothing: it takes options to read them,
/// or they have no one name.
std::optional<std::string> name_to_remember(const ExploreOptions& options);

/// The options for other data, without those that were meant for the first data only.
/// @param data a file, a folder, or a pattern
ExploreOptions with_data(ExploreOptions options, const std::string& data);

} // namespace isochron::app
