// The start state of a session, from the configuration and the data.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "index/file/index_file.h"

namespace isochron::app {

/// An isovalue that the configuration does not give is a quantile of all values.
ExplorerState start_state(const Config& config, const index::IndexFile& file);

} // namespace isochron::app
