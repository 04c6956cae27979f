// Plain arrays whose steps or components lie in the other order than open_stored takes them.
#pragma once

#include "index/formats/stored_file.h"

namespace isochron::index {

/// Steps that lie interleaved: of each vertex the values of all steps together, as in a list of
/// 3D Slicer's MultiVolume. @param layout its steps; one component
std::unique_ptr<VolumeFile> open_interleaved_steps(const std::filesystem::path& header,
                                                   SeriesInfo info, const StoredLayout& layout,
                                                   const ReadOptions& options);

/// Components that lie one volume after the other. @param layout its components; one step
/// @throws Error as `choose_scalar` when `options` leave open which is wanted
std::unique_ptr<VolumeFile> open_stacked_components(const std::filesystem::path& header,
                                                    SeriesInfo info, const StoredLayout& layout,
                                                    const ReadOptions& options);

} // namespace isochron::index
