// The start state of a session, from the configuration and the data.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "index/file/index_file.h"

#include <vector>

namespace isochron::app {

/// The surfaces at the first look at an array. An isovalue that the configuration does not give is
/// a quantile of all values.
std::vector<interaction::Isosurface> first_surfaces(const Config& config,
                                                    const index::IndexStats& stats);

ExplorerState start_state(const Config& config, const index::IndexFile& file);

} // namespace isochron::app
