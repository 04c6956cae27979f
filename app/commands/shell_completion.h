// Completions of commands, options and their words for bash, zsh and fish.
#pragma once

#include "app/commands/command_reference.h"

#include <string>
#include <vector>

namespace isochron::app {

/// The shells there are completions for: bash, zsh, fish.
const std::vector<std::string>& completed_shells();

/// The script that the shell reads; where an option takes no listed words, files are offered.
/// @param shell one of completed_shells()
std::string shell_completion(const CommandReference& program, const std::string& shell);

} // namespace isochron::app
