// The help of commands, and commands as data: what else needs the parser's library.
#pragma once

#include "app/command_line/command_reference.h"

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace isochron::app {

/// What stands before the form of an accepted value in the parser's descriptions: no name has it.
inline const std::string kFormBegins = "\x1f";

/// Lets `help_text` write the help of the program, and of the commands that are added to it from now on.
void write_help(CLI::App& program);

/// The command's help ends with these lines. After `write_help` of its program.
void add_examples(CLI::App& command, std::vector<std::string> lines);

/// What an exit status of the command says. After `write_help` of its program.
void add_exit_status(CLI::App& command, int status, const std::string& meaning);

/// Help lists the first `count` commands under a heading of their own.
void begin_with_first(CLI::App& program, std::size_t count);

CommandReference reference_of(const CLI::App& command);

} // namespace isochron::app
