// Slices, what cuts the surfaces, and ghosts in links.
#pragma once

#include "app/explore/link_words.h"
#include "app/frame/explorer_state.h"

#include <string>

namespace isochron::app {

/// Settings of a link in a state; what is not in it, or is none, stays.
void tools_as_linked(ExplorerState& state, const LinkWords& settings, const index::IndexFile& file);
/// The settings of what is shown, each behind a `&`.
std::string tool_words(const ExplorerState& state, const index::IndexFile& file);
/// What of a link `tools_as_linked` has no setting for, in a line; empty: nothing.
std::string lost_of_link(const LinkWords& settings, const index::IndexFile& file);

} // namespace isochron::app
