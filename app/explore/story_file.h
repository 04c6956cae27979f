// The file of a story: keys with texts, and the name of the index that they are about. It holds views
// and texts alone.
#pragma once

#include "interaction/setting_values.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

inline constexpr std::uint64_t kLargestStory = 1 << 22; ///< [byte]

/// The keys of a text: a file of keys, or a session. @param name for messages
/// @throws interaction::Error
std::vector<interaction::KeyFrame> keys_in(const std::string& text, const std::string& name);

struct StoryFile {
    std::vector<interaction::KeyFrame> keys;
    std::string data; ///< as the file says it; empty: it names none
};

/// @param text of a file of keys, or of a session, whose data do not count
/// @param name for messages
/// @throws interaction::Error in one line: no keys, none with a text, keys that open other files, ...
StoryFile story_in(const std::string& text, const std::string& name);
/// @param file of this machine, or a link to one
/// @throws as `story_in`; index::Error when the file cannot be read
StoryFile read_story(const std::filesystem::path& file);

/// Whether this is the name of a story's file, which can be opened in the place of data.
bool is_story_name(const std::string& file);
/// The index that a story's file names: in the folder of the file. An address is asked about where a
/// user can answer in a terminal.
/// @throws interaction::Error when the file names none, or an index that it may not open
std::string data_of_story(const std::filesystem::path& file);

} // namespace isochron::app
