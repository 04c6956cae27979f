// What a live session is given to work with: its options, its recording's header, its movies.
#pragma once

#include "app/commands/explore_options.h"
#include "app/frame/background_work.h"
#include "app/session/live_loop.h"
#include "app/session/movie_maker.h"
#include "app/session/user_memory.h"

#include <filesystem>
#include <string>

namespace isochron::app {

/// What keeps data from being shown at all, in one line; empty: nothing does. Files of values can
/// be shown if they can be opened with no option.
std::string why_not_open(const std::filesystem::path& data);
/// What keeps this session from showing other data; empty: nothing does.
std::string why_not_open(const ExploreOptions& options, const std::filesystem::path& data);

/// How long it goes on.
LiveOptions live_options(const ExploreOptions& options);

/// Of a recording that begins now. @param path of the data
interaction::RecordingHeader header_of(const Session& session, const Config& config,
                                       const index::IndexFile& file, const std::string& path);

/// The panel's movies, as this session draws.
MovieOrders movie_orders(const ExploreOptions& options, interaction::RecordingHeader header);

/// Data, as the user knows them, are remembered; the first lines stand in the picture once.
/// @param data nothing: of what is only kept for a while
/// @param memory outlives the session's frames
/// @param writing remembers while the session begins
void greet(Session& session, UserMemory& memory, BackgroundWork& writing,
           const std::optional<std::string>& data);

} // namespace isochron::app
