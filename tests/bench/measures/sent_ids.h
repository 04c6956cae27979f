// How many ids a GPU is sent from step to step.
#pragma once

#include "index/file/index_file.h"
#include "render/gl/gl.h"

#include <memory>
#include <optional>

namespace isochron::bench {

/// Ids that go to the GPU as differences, in percent of all ids of the sets, over all steps after
/// the first. Sets without normals are asked for, which a GPU makes itself: those that come with
/// their normals, where the processor draws, are always sent whole.
/// @return nothing where there is only one step, or no cell
std::optional<double> sent_ids_percent(const render::Gl& gl,
                                       const std::shared_ptr<const index::IndexFile>& file,
                                       double isovalue);

} // namespace isochron::bench
