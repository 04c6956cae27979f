// Saving and resuming of the session of `explore`.
#pragma once

#include "app/explore/explore_options.h"
#include "app/kept/earlier_sessions.h"
#include "app/kept/session_file.h"
#include "app/loop/live_loop.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// The content hash by which recordings and sessions name data: 16 hexadecimal digits.
std::string data_hash_of(const index::IndexFile& file);
/// `hash` if the data have it, or had it when they had fewer steps; else the data's hash now.
std::string held_hash(const index::IndexFile& file, const std::string& hash);
/// What to say where something made on data is shown on these, whose files were understood in another
/// way; empty: nothing, also where it does not say its reading. @param name of what was made
std::string other_reading(const std::string& name, std::uint32_t reading,
                          const index::IndexFile& file);

/// `path` if it exists; else the newest session file in its folder that was saved when these data
/// had fewer steps; `path` again if there is none.
/// @param path of the session on the data as they are now, see `session_path`
std::filesystem::path kept_on_fewer_steps(const std::filesystem::path& path,
                                          const index::IndexFile& file);

/// Where the session on the data of the options is saved; empty: there is no place for it.
std::optional<std::filesystem::path> kept_in(const ExploreOptions& options,
                                             const index::IndexFile& file);
/// Where the earlier session lies. If the data have grown since, its name has their earlier hash.
std::optional<std::filesystem::path> earlier_kept_in(const ExploreOptions& options,
                                                     const index::IndexFile& file);

/// All sessions on these data that were kept in the same folder, newest first, but the one that
/// `--resume` goes on with before all others.
std::vector<EarlierSession> earlier_sessions(const ExploreOptions& options,
                                             const index::IndexFile& file);

/// The session to resume. Without `resume` it is empty, and stderr tells of an existing session.
/// @param path of the saved session; empty if there is no place for it
/// @throws interaction::Error when `resume` is set and there is no session
std::optional<SavedSession> earlier_session(const std::optional<std::filesystem::path>& path,
                                            bool resume);

/// Why a session cannot be kept in this file, in one line; empty: it can.
/// @param path empty: there is no folder for it
std::string why_not_kept(const std::optional<std::filesystem::path>& path);

/// Makes the loop save the session to `path`, and start with the head of the earlier session.
/// @param resumed that session lies in the same file
/// @param drops files of sessions that go once this one is saved
void keep_session(LiveLoop& live, const std::optional<std::filesystem::path>& path,
                  const ExploreOptions& options, const index::IndexFile& file,
                  const Session& session, const std::optional<SavedSession>& earlier, bool resumed,
                  std::vector<std::filesystem::path> drops);

} // namespace isochron::app
