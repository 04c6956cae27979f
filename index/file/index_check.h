// Checks an index as a whole.
#pragma once

#include "index/file/index_file.h"
#include "index/progress.h"

namespace isochron::index {

/// Checks every checksum of all arrays: reads the whole file, and the sources that it refers to.
/// @throws Error naming the damaged section
void check_index(const IndexFile& file, const Progress& progress = {});

} // namespace isochron::index
