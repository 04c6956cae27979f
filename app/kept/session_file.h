// A session saved in a file, from which it can be resumed.
//
//     save_session(path, {"isochron", data, hash, session.state().as_commands(), head});
//     const SavedSession saved = read_session(path);   // throws where it is none
//     session.set_state(state_of(saved, session.state(), hash, steps, "the session"));
#pragma once

#include "app/frame/explorer_state.h"
#include "interaction/controls/desktop_emulation.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct SavedSession {
    std::string program;         ///< program that wrote it
    std::string data;            ///< path of the index
    std::string data_hash;       ///< 16 hexadecimal digits
    interaction::Commands state; ///< sets all settings
    /// Where the head of the emulation by mouse and keyboard stands.
    interaction::StandingPlace head;
    /// How arrays of the surfaces that are not shown were left: each sets `array`, `isosurfaces`,
    /// `picked` and `coloring`.
    std::vector<interaction::Commands> arrays = {};
    /// Nothing was made in it, nor in the one that it goes on with: only view and time differ from
    /// the first look at the data.
    bool only_looked = false;
    std::uint32_t reading = 0; ///< `index::Metadata::reading_number` of the data; 0: not said
    std::string name{};        ///< given by the user; empty: none
    std::string opened{};      ///< path of the data as the user opened them; empty: unknown
    std::string picture{};     ///< bytes of a small PNG of what was seen last; empty: none
};

/// Whether a session is kept for ever: it has a name, or somebody has put marks into it (the mark, the
/// ruler, bookmarks or key frames).
bool is_lasting(const SavedSession& session);

/// Writes readable JSON. The file appears under its name when complete, or not at all.
/// @throws index::Error when it cannot be written
void save_session(const std::filesystem::path& path, const SavedSession& session);

/// Whether a text begins as a session's file may: its format is one.
bool is_session_text(const std::string& text);

/// @param name for messages
/// @throws interaction::Error naming it: not a session, a newer version, ...
SavedSession session_in(const std::string& text, const std::string& name);
/// @throws index::Error when the file cannot be read; interaction::Error as `session_in`
SavedSession read_session(const std::filesystem::path& path);

/// The state of a saved session; what it does not hold is taken from `fallback`.
/// @param data_hash of the open data
/// @param steps number of steps of the open data
/// @param name of the session, for messages
/// @throws interaction::Error when it was saved on other data, or does not fit them
ExplorerState state_of(const SavedSession& saved, const ExplorerState& fallback,
                       const std::string& data_hash, std::size_t steps, const std::string& name);

/// The default file for sessions on these data: in the user's folder for state of programs
/// ($XDG_STATE_HOME, else ~/.local/state), named after the data's name and hash. Empty if there is
/// no home folder.
std::optional<std::filesystem::path> session_path(const std::filesystem::path& data,
                                                  const std::string& data_hash);

} // namespace isochron::app
