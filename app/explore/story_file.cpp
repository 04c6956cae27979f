// Reads the files of stories.
#include "app/explore/story_file.h"

#include "app/kept/session_file.h"
#include "app/loop/movie_maker.h"
#include "app/telling.h"
#include "index/file/index_series.h"
#include "index/shell_word.h"
#include "index/system/byte_source.h"
#include "index/system/input_file.h"
#include "index/system/links/link.h"
#include "interaction/error.h"
#include "interaction/navigation/story.h"
#include "interaction/recording/key_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <span>
#include <string_view>

#include <unistd.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Whether whoever sits at the terminal says yes; nobody does where there is none.
bool agrees(const std::string& question) {
    if (!isatty(STDIN_FILENO) || !isatty(STDERR_FILENO))
        return false;
    print_note("{} [y/N]", question);
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "yes";
}

/// A name without any folder.
bool is_plain(std::string_view name) {
    return !name.empty() && name != "." && name != ".." &&
           name.find_first_of(std::string_view("/\\\0", 3)) == name.npos;
}

} // namespace

std::vector<interaction::KeyFrame> keys_in(const std::string& text, const std::string& name) {
    if (!is_session_text(text))
        return interaction::keys_from(text, name);
    auto keys = session_in(text, name).state.keys.value_or(std::vector<interaction::KeyFrame>());
    if (keys.empty())
        throw interaction::Error("{}: a session without keys: Ctrl + M in `explore` makes them",
                                 name);
    return interaction::keys_from(interaction::keys_text(keys), name); // in order
}

StoryFile story_in(const std::string& text, const std::string& name) {
    StoryFile story;
    if (is_session_text(text))
        story.keys = keys_in(text, name);
    else
        story.keys = interaction::keys_from(text, name, &story.data);
    if (interaction::story_step(story.keys, 0).of == 0)
        throw interaction::Error("{}: no story: expected a key with a \"text\", got {} without any",
                                 name, story.keys.size());
    for (std::size_t i = 0; i < story.keys.size(); ++i)
        if (const auto& models = story.keys[i].models; models && !models->empty())
            throw interaction::Error(
                "{}: key {}: models: a story opens no other files: expected none, got {}", name,
                i + 1, models->size());
    return story;
}

StoryFile read_story(const fs::path& file) {
    const std::string& name = file.native();
    if (!index::is_link(name))
        return story_in(index::read_text(file, kLargestStory), name);
    const auto bytes = index::open_bytes(file);
    if (bytes->size() > kLargestStory)
        throw interaction::Error("{}: no story: expected at most {} bytes, got {}", name,
                                 kLargestStory, bytes->size());
    std::string text(bytes->size(), '\0');
    bytes->read(0, std::as_writable_bytes(std::span(text)));
    return story_in(text, name);
}

bool is_story_name(const std::string& file) {
    return fs::path(file).extension() == kStoryEnding;
}

std::string data_of_story(const fs::path& file) {
    const std::string name = file.string();
    const std::string data = read_story(file).data;
    const std::string by_hand =
        fmt::format("isochron explore INDEX --story {}", index::shell_word(name));
    if (data.empty())
        throw interaction::Error("{}: it names no data: expected \"data\": \"NAME.isochron\"; {} "
                                 "shows it on an index of yours",
                                 name, by_hand);
    if (index::is_link(data)) {
        if (agrees(fmt::format("{} is about data at {}: open them?", name, data)))
            return data;
        throw interaction::Error("{}: its data are behind an address, which nobody has agreed to: "
                                 "isochron explore {} --story {} opens them",
                                 name, index::shell_word(data), index::shell_word(name));
    }
    if (!is_plain(data))
        throw interaction::Error("{}: data: expected the name of an index in the same folder, got "
                                 "{}; {} shows the story on any index",
                                 name, data, by_hand);
    const fs::path beside = file.parent_path() / data;
    std::error_code ignored;
    if (!fs::exists(beside, ignored) || !index::is_index(beside))
        throw interaction::Error("{}: data: expected an index in the same folder, got {}, which is "
                                 "{}; {} shows the story on any index",
                                 name, data, fs::exists(beside, ignored) ? "none" : "not there",
                                 by_hand);
    return beside.string();
}

} // namespace isochron::app
