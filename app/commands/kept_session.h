// The session that `explore` keeps, and the one that it goes on with.
#pragma once

#include "app/session/live_loop.h"
#include "app/session/session_file.h"

#include <filesystem>
#include <optional>
#include <string>

namespace isochron::app {

/// As recordings and sessions name data: 16 hexadecimal digits.
std::string data_hash_of(const index::IndexFile& file);
/// The same of the steps that the data had when they were named `hash`, if they ever were; else of
/// all.
std::string held_hash(const index::IndexFile& file, const std::string& hash);

/// Where the newest session lies that was kept, in the same folder, on these data when they had
/// fewer steps; `path` itself where one is there, or there is none.
/// @param path for the data as they are, see `session_path`
std::filesystem::path kept_on_fewer_steps(const std::filesystem::path& path,
                                          const index::IndexFile& file);

/// The session to go on with; where `resume` does not say so, only that there is one is said.
/// @param path where it is kept; nothing where nobody can say
/// @throws interaction::Error where `resume` asks for what is not there
std::optional<SavedSession> earlier_session(const std::optional<std::filesystem::path>& path,
                                            bool resume);

/// Lets the loop keep the session, and begin where the earlier one ended.
void keep_session(LiveLoop& live, const std::optional<std::filesystem::path>& path,
                  const std::string& data, const index::IndexFile& file, const Session& session,
                  const std::optional<SavedSession>& earlier);

} // namespace isochron::app
