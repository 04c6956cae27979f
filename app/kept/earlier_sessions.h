// The sessions on the same data before the last one, each in a file with its date.
#pragma once

#include "app/kept/session_file.h"

#include <cstddef>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Most sessions that are kept beside the last one: enough for weeks of work on the same data, and
/// a MiB or two. Beyond it the oldest goes of those in which somebody only looked, and only if there
/// is none, the oldest of all: what somebody made is never dropped for a look.
inline constexpr std::size_t kMostEarlierSessions = 20;

struct EarlierSession {
    std::filesystem::path path;
    std::time_t saved = 0;
    SavedSession session;
};

/// `2026-11-28 00:45:10`, in local time, and whether somebody only looked.
std::string words_of(const EarlierSession& earlier);

/// Whether this is the name of a session that belongs to `path`: it has that name, or the one of a
/// second window, or one of these with a date, or with the `.before` of version 0.2 behind it.
bool is_session_of(std::string_view name, const std::filesystem::path& path);

/// The sessions in a folder, newest first, whose names `wanted` accepts. What is none is left out.
std::vector<EarlierSession> sessions_in(const std::filesystem::path& folder,
                                        const std::function<bool(const std::string& name)>& wanted);

/// Gives the session in `path` a name with the date at which it was saved, for another one that is
/// to be saved there. @throws index::Error when it stays where it is
void keep_earlier(const std::filesystem::path& path);

} // namespace isochron::app
