// Measures how many ids are sent to a GPU from step to step.
#pragma once

#include "index/file/index_file.h"
#include "render/gl/gl.h"

#include <memory>
#include <optional>

namespace isochron::bench {

/// Ids that are sent to the GPU as differences, in percent of all ids of the sets, over all steps
/// after the first. Uses sets without normals, as for a GPU, which computes them itself: sets with
/// normals, for software GL, are always sent whole.
/// @return empty if there is only one step, or no cell
std::optional<double> sent_ids_percent(const render::Gl& gl,
                                       const std::shared_ptr<const index::IndexFile>& file,
                                       double isovalue);

} // namespace isochron::bench
