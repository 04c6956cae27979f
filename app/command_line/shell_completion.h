// Completions of commands, options and their words for bash, zsh and fish.
#pragma once

#include "app/command_line/command_reference.h"

#include <string>
#include <vector>

namespace isochron::app {

/// The shells that have completions: bash, zsh, fish.
const std::vector<std::string>& completed_shells();

/// The completion script for a shell; it offers files for options without a list of words.
/// @param shell one of completed_shells()
std::string shell_completion(const CommandReference& program, const std::string& shell);

} // namespace isochron::app
