// What the command line offers, as data: manual pages and shells' completions are made from it.
#pragma once

#include <string>
#include <vector>

namespace isochron::app {

/// One option, or one argument that is known by its place.
struct OptionReference {
    std::vector<std::string> names; ///< with their dashes; empty for an argument known by its place
    std::string value;              ///< what help shows for the value; empty for a flag
    std::vector<std::string>
        words; ///< the values that are accepted; empty where they are not listed
    std::string help;
    std::string heading; ///< under which help lists it
    bool required = false;
};

/// The program or one of its commands.
struct CommandReference {
    std::string name; ///< the last word of how it is called
    std::string help;
    std::string footer; ///< plain text below the options
    std::vector<OptionReference> options;
    std::vector<CommandReference> commands;
};

/// A command with the words that lead to it: {"isochron", "generate", "sphere"}.
struct CommandPath {
    std::vector<std::string> words;
    const CommandReference* command;
};

/// The program and all its commands, each before those below it.
std::vector<CommandPath> all_commands(const CommandReference& program);

} // namespace isochron::app
