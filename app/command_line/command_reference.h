// Commands and options as data, from which manual pages and shell completions are made.
#pragma once

#include <string>
#include <vector>

namespace isochron::app {

/// One option, or one positional argument.
struct OptionReference {
    std::vector<std::string> names; ///< with their dashes; empty for a positional argument
    std::string value;              ///< what help shows for the value; empty for a flag
    std::vector<std::string> words; ///< the accepted values; empty if they are not listed
    std::string help;
    std::string heading; ///< heading under which help lists it
    bool required = false;
};

/// The program or one of its commands.
struct CommandReference {
    std::string name; ///< its last word: `sphere` of `isochron generate sphere`
    std::string help;
    std::vector<std::string> examples; ///< commands as a user types them
    std::string footer;                ///< plain text below the options
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
