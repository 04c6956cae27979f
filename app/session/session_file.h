// A session kept in a file: what its user had come to, to go on from there.
//
//     save_session(path, {"isochron", data, hash, session.state().as_commands(), head});
//     const SavedSession saved = read_session(path);   // throws where it is none
//     session.set_state(state_of(saved, session.state(), hash, steps, "the session"));
#pragma once

#include "app/frame/explorer_state.h"
#include "interaction/desktop_emulation.h"

#include <filesystem>
#include <optional>
#include <string>

namespace isochron::app {

struct SavedSession {
    std::string program;             ///< that wrote it
    std::string data;                ///< path of the index
    std::string data_hash;           ///< 16 hexadecimal digits
    interaction::Commands state;     ///< all settings
    interaction::StandingPlace head; ///< that mouse and keyboard emulate
};

/// JSON, for people to read as well. It appears whole under its name, or not at all.
/// @throws index::Error when it cannot be written
void save_session(const std::filesystem::path& path, const SavedSession& session);

/// @throws index::Error when the file cannot be read
/// @throws interaction::Error naming the file: not a session, a newer version, ...
SavedSession read_session(const std::filesystem::path& path);

/// The state that a session comes back to: what it holds, over `fallback`.
/// @param data_hash of the data that are open
/// @throws interaction::Error when it is of other data, or does not fit them
ExplorerState state_of(const SavedSession& saved, const ExplorerState& fallback,
                       const std::string& data_hash, std::size_t steps, const std::string& name);

/// Where the sessions on these data are kept where nobody says otherwise: in the user's folder for
/// what programs remember ($XDG_STATE_HOME, else ~/.local/state), by the data's name and hash.
/// Nothing where there is no home.
std::optional<std::filesystem::path> session_path(const std::filesystem::path& data,
                                                  const std::string& data_hash);

} // namespace isochron::app
