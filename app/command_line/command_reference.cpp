// The tree of commands, flattened into a list; what surrounds them.
#include "app/command_line/command_reference.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace isochron::app {
namespace {

void add_commands(const CommandReference& command, std::vector<std::string> words,
                  std::vector<CommandPath>& into) {
    words.push_back(command.name);
    into.push_back({words, &command});
    for (const CommandReference& below : command.commands)
        add_commands(below, words, into);
}

/// A row of the tables below.
struct Surroundings {
    const char* name;
    const char* help;
    std::string_view commands; ///< with a space around each; empty: all of them
};

constexpr std::string_view kWithWindows = " explore replay movie reproduce ";

constexpr std::array kFiles{
    Surroundings{"NAME.isochron",
                 "An index: the values of all steps, and what finds cells in them.", ""},
    Surroundings{"~/.cache/isochron/",
                 "Indexes that `explore` made of files of values. The least recently used ones are "
                 "removed when they take too much space.",
                 " explore "},
    Surroundings{
        "~/.local/state/isochron/",
        "Saved sessions (NAME.isochron-session), the list of recent data and the size of the "
        "window.",
        " explore "},
    Surroundings{
        "~/.local/state/isochron/unfinished/",
        "Notes on files that are being written, so that leftovers of a killed process can be "
        "removed.",
        ""},
    Surroundings{"$XDG_RUNTIME_DIR/isochron/control.sock",
                 "The socket that `explore --control` opens and `tell` uses.",
                 " explore replay tell "},
};

constexpr std::string_view kByLinks = " explore query info export measure change verify ";
constexpr std::array kEnvironment{
    Surroundings{"XDG_STATE_HOME", "Folder that takes the place of ~/.local/state.", ""},
    Surroundings{"XDG_CACHE_HOME", "Folder that takes the place of ~/.cache.", " explore "},
    Surroundings{"XDG_RUNTIME_DIR", "Folder for the control socket; without it the state folder.",
                 " explore replay tell "},
    Surroundings{"ISOCHRON_AUTHORIZATION",
                 "`HOST VALUE`: what is sent as the header Authorization to this host, where an "
                 "index is opened by a link.",
                 kByLinks},
    Surroundings{"ISOCHRON_LINK_CACHE",
                 "MiB that are kept of indices that are opened by links; without it 4096.",
                 kByLinks},
    Surroundings{"ISOCHRON_LINK_PATIENCE",
                 "Seconds for which the server of a link may send nothing; without it 60.",
                 kByLinks},
    Surroundings{"DISPLAY", "X display on which windows are opened.", " explore replay "},
    Surroundings{"XR_RUNTIME_JSON", "File that names the OpenXR runtime of a headset.",
                 " explore "},
    Surroundings{"LP_NUM_THREADS", "Number of threads that draw where there is no GPU.",
                 kWithWindows},
    Surroundings{"HDF5_PLUGIN_PATH", "Folder with further filters of HDF5.",
                 " build explore info "},
};

std::vector<Surrounding> of_command(std::span<const Surroundings> rows,
                                    const CommandPath& command) {
    std::vector<Surrounding> found;
    const std::string word = command.words.size() > 1 ? " " + command.words[1] + " " : "";
    for (const Surroundings& row : rows)
        if (row.commands.empty() || word.empty() || row.commands.find(word) != row.commands.npos)
            found.push_back({row.name, row.help});
    return found;
}

} // namespace

std::vector<CommandPath> all_commands(const CommandReference& program) {
    std::vector<CommandPath> all;
    add_commands(program, {}, all);
    return all;
}

std::vector<std::string> headings_of(const CommandReference& command) {
    const std::string first = "Arguments", last = "Output";
    std::vector<std::string> found;
    for (const OptionReference& option : command.options)
        if (std::ranges::find(found, option.heading) == found.end())
            found.push_back(option.heading);
    const auto place = [&](const std::string& heading) {
        return heading == first ? 0 : heading == last ? 2 : 1;
    };
    std::ranges::stable_sort(found, {}, place);
    return found;
}

std::vector<Surrounding> files_of(const CommandPath& command) {
    return of_command(kFiles, command);
}

std::vector<Surrounding> environment_of(const CommandPath& command) {
    return of_command(kEnvironment, command);
}

} // namespace isochron::app
