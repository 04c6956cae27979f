// Models that VTK reads.
#pragma once

#include "index/readers/decoders/model/model.h"

namespace isochron::index {

/// VTP; and glTF in both forms, whose y becomes z, and whose places are in meters.
/// @throws Error as `decode_model`
TriangleMesh decode_vtk_model(const std::filesystem::path& path);

} // namespace isochron::index
