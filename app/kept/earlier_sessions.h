// The sessions on the same data before the last one, each in a file with its date.
#pragma once

#include "app/kept/session_file.h"

#include <cstddef>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Most sessions that are kept on the same data, unless more of them last: months of work, and some
/// MiB.
inline constexpr std::size_t kMostSessions = 50;

struct EarlierSession {
    std::filesystem::path path;
    std::time_t saved = 0;
    SavedSession session;
};

/// `draft, 2026-11-28 00:45:10`: its name, when it was saved in local time, and whether somebody only
/// looked.
std::string words_of(const EarlierSession& earlier);

/// Whether this is the name of a session that belongs to `path`: it has that name, or the one of a
/// second window, or one of these with a date, or with the `.before` of version 0.2 behind it.
bool is_session_of(std::string_view name, const std::filesystem::path& path);

/// The sessions in a folder, newest first, whose names `wanted` accepts. What is none is left out.
std::vector<EarlierSession> sessions_in(const std::filesystem::path& folder,
                                        const std::function<bool(const std::string& name)>& wanted);

/// The sessions that make room for one more: the oldest of those in which somebody only looked, then
/// the oldest of all. Those that last (`is_lasting`), the last one, and those of other windows stay,
/// so there may be more than `kMostSessions`.
/// @param all sessions on the data @param last file of the last one
std::vector<EarlierSession> sessions_to_drop(std::vector<EarlierSession> all,
                                             const std::filesystem::path& last);
/// Removes these files, but not those of sessions that last since.
void drop_sessions(const std::vector<std::filesystem::path>& files);

/// The small pictures of the newest sessions on data, by the path that the user opened, or that of
/// the index. @param folder of sessions; one that is not there has none
std::map<std::filesystem::path, std::string> newest_pictures(const std::filesystem::path& folder);

/// Gives the session in `path` a name with the date at which it was saved, for another one that is
/// to be saved there. @return that name @throws index::Error when it stays where it is
std::filesystem::path keep_earlier(const std::filesystem::path& path);

} // namespace isochron::app
