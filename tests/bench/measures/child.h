// Work in a process of its own, for what a process can set but once.
#pragma once

#include "app/commands/cancel.h"

#include <functional>
#include <string>

namespace isochron::bench {

/// Forks, runs the work in the child and waits for what it returns. The parent must have no other
/// threads. What the child prints to stderr is seen at once; when the user cancels, the child is
/// told so and waited for.
/// @throws app::Canceled, or index::Error with the child's own message
std::string in_child(const std::function<std::string()>& work, const app::CancelOnSignal& signals);

} // namespace isochron::bench
