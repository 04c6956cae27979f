// Meshes packed for EXT_meshopt_compression, by meshoptimizer.
#pragma once

#include "index/export/exported_step.h"

namespace isochron::app {

/// Null: this build is without the library.
const index::MeshPacking* mesh_packing();

} // namespace isochron::app
