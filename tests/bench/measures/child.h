// Runs work in a child process, for settings that a process can make only once.
#pragma once

#include "app/command_line/cancel.h"

#include <functional>
#include <string>

namespace isochron::bench {

/// Forks, runs the work in the child, and waits for its result. The parent must have no other
/// threads. The child's output on stderr appears at once. If the user cancels, the child gets the
/// signal too, and is waited for.
/// @throws app::Canceled, or index::Error with the child's own message
std::string in_child(const std::function<std::string()>& work, const app::CancelOnSignal& signals);

} // namespace isochron::bench
