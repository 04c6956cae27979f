// Examples in the help of commands, and commands as data: what else needs the parser's library.
#pragma once

#include "app/command_line/command_reference.h"

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace isochron::app {

/// Help of the program, and of the commands that are added to it from now on, shows examples.
void show_examples(CLI::App& program);

/// The command's help begins with these lines. After `show_examples` of its program.
void add_examples(CLI::App& command, std::vector<std::string> lines);

/// Help lists the first `count` commands under a heading of their own.
void begin_with_first(CLI::App& program, std::size_t count);

CommandReference reference_of(const CLI::App& command);

} // namespace isochron::app
