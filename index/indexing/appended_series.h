// A series whose first steps come from an index that holds them already.
#pragma once

#include "index/file/index_file.h"

namespace isochron::index {

/// The series from which `build --append` builds: steps that the index holds are read from the
/// index, the others from their files.
/// @param all the whole series, the steps in the index included
/// @return null when the index holds all steps already
/// @throws Error naming the index when the series does not begin with its steps, or when a source
///         has been written to since and no longer holds what was indexed
std::unique_ptr<VolumeSeries> append_to(std::shared_ptr<const IndexFile> index,
                                        const std::string& name, std::unique_ptr<VolumeSeries> all);

/// The series of the array to color by. @param all null when none is asked for
/// @throws Error naming the index when it has another array, only one of index and `all` has one,
///         or a source has changed
std::unique_ptr<VolumeSeries> append_colors_to(std::shared_ptr<const IndexFile> index,
                                               const std::string& name,
                                               std::unique_ptr<VolumeSeries> all);

} // namespace isochron::index
