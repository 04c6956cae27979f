// Commands and options as data, from which help, manual pages and shell completions are made.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace isochron::app {

/// One option, or one positional argument.
struct OptionReference {
    std::vector<std::string> names; ///< with their dashes; empty for a positional argument
    std::string value;              ///< what help shows for the value; empty for a flag
    std::vector<std::string> words; ///< the accepted values; empty if they are not listed
    std::string help;               ///< ends with what is accepted, and with the default
    std::string heading;            ///< heading under which help lists it
    bool required = false;
};

/// The program or one of its commands.
struct CommandReference {
    std::string name; ///< its last word: `sphere` of `isochron generate sphere`
    std::string help;
    std::string heading;               ///< heading under which the help of its parent lists it
    std::vector<std::string> examples; ///< commands as a user types them
    std::string footer;                ///< plain text below the options, see `Command::footer`
    std::map<int, std::string> exits;  ///< what its exit status says
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

/// The headings of a command's options in the order in which help lists them: arguments first, what all
/// commands have last.
std::vector<std::string> headings_of(const CommandReference& command);

/// What surrounds a command: a file that it reads or writes by itself, or a variable of the environment.
struct Surrounding {
    std::string name, help;
};
std::vector<Surrounding> files_of(const CommandPath& command);
std::vector<Surrounding> environment_of(const CommandPath& command);

} // namespace isochron::app
