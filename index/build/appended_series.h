// A series of which an index already holds the first steps.
#pragma once

#include "index/file/index_file.h"

namespace isochron::index {

/// Takes the steps that the index holds from there, and reads the others from their files: what
/// `build --append` builds from.
/// @param all the whole series, those steps included
/// @return null when the index holds all steps already
/// @throws Error naming the index when the series does not begin with its steps, or when a source
///         has been written to since and no longer holds what was indexed
std::unique_ptr<VolumeSeries> append_to(std::shared_ptr<const IndexFile> index,
                                        const std::string& name, std::unique_ptr<VolumeSeries> all);

/// Likewise for the array to color by. @param all null when none is asked for
/// @throws Error naming the index when it holds another one, one holds it and the other does not,
///         or a source has changed
std::unique_ptr<VolumeSeries> append_colors_to(std::shared_ptr<const IndexFile> index,
                                               const std::string& name,
                                               std::unique_ptr<VolumeSeries> all);

} // namespace isochron::index
