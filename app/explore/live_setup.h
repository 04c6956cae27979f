// What a live session is given to work with: its options, its recording's header, its movies.
#pragma once

#include "app/explore/explore_options.h"
#include "app/frame/background_work.h"
#include "app/kept/user_memory.h"
#include "app/loop/live_loop.h"
#include "app/loop/movie_maker.h"

#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <vector>

namespace isochron::app {

/// Why data cannot be shown at all, in one line; empty: they can. Files of values can be shown if
/// they can be opened without options.
std::string why_not_open(const std::filesystem::path& data);

/// The options of the live loop: when it ends, and whether it emulates an installation.
LiveOptions live_options(const ExploreOptions& options);

/// Tells on stderr what the loop has to say at its end. @param words what `LiveLoop::finish` returned
void print_status(const LiveLoop& live, const std::vector<std::string>& words = {});

/// The header of a recording that begins now. @param path of the data
interaction::RecordingHeader header_of(const Session& session, const Config& config,
                                       const index::IndexFile& file, const std::string& path);

/// Options for movies that the panel asks for: they are drawn as this session draws.
MovieOrders movie_orders(const ExploreOptions& options, interaction::RecordingHeader header);

/// The demo, which `why_not_open` makes when somebody opens it, and the pictures of recent data.
/// @param reading reads them in the background; outlives what is returned
FileWindow::Offers offers_beside_files(BackgroundWork& reading);

/// The small picture of a session, read in the background, which is woken then; an empty one where it
/// cannot be read. @param png gives its bytes there @param reading outlives the task
std::shared_future<render::Image> picture_read(BackgroundWork& reading,
                                               std::function<std::string()> png);

/// Remembers the data as recently opened, and shows the introduction if the user is new.
/// @param data their name; empty: they are not remembered
/// @param memory outlives the session's frames
/// @param writing writes to `memory` in the background
void greet(Session& session, UserMemory& memory, BackgroundWork& writing,
           const std::optional<std::string>& data);

} // namespace isochron::app
