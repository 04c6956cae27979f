// The help of a command as text for a terminal.
#pragma once

#include "app/command_line/command_reference.h"

#include <cstddef>
#include <string>

namespace isochron::app {

/// Columns of the terminal that stdout is; 80 where it is none.
std::size_t help_width();

/// What the command is for, how it is called, its options, exit status and examples, in lines of at most
/// `width` columns. Only a word that is longer has a longer line.
std::string help_text(const CommandPath& command, std::size_t width);

/// A footer (`Command::footer`) in such lines.
std::string footer_lines(const std::string& footer, std::size_t width);

/// How the command is called: `isochron verify [OPTION...] INDEX`.
std::string usage_of(const CommandPath& command);

} // namespace isochron::app
