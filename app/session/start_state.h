// What a session starts with: the configuration's wishes, and the data's first isovalue and place.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "index/file/index_file.h"

namespace isochron::app {

/// Where the configuration leaves an isovalue open, it is a quantile of all values.
ExplorerState start_state(const Config& config, const index::IndexFile& file);

} // namespace isochron::app
