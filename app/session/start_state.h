// The start state of a session, from the configuration and the data.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "index/file/index_file.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::app {

/// The surfaces at the first look at an array. An isovalue that the configuration does not give is
/// a quantile of the values of all steps or, if the step has no active cell there, of the values of
/// the step. Reads the step: do not call it while frames are drawn.
/// @param step that is shown first
std::vector<interaction::Isosurface>
first_surfaces(const Config& config, const std::shared_ptr<const index::IndexFile>& array,
               std::uint32_t step);

/// The state at the first step, with the first array.
ExplorerState start_state(const Config& config,
                          const std::shared_ptr<const index::IndexFile>& file);

} // namespace isochron::app
