// Plain arrays whose steps or components are in another order than `open_stored` reads.
#pragma once

#include "index/readers/formats/stored_file.h"

namespace isochron::index {

/// Interleaved steps: the values of all steps at a vertex are together, as in a list of 3D Slicer's
/// MultiVolume. @param layout with the number of steps; one component
std::unique_ptr<VolumeFile> open_interleaved_steps(const std::filesystem::path& header,
                                                   SeriesInfo info, const StoredLayout& layout,
                                                   const ReadOptions& options);

/// Stacked components: all steps of the first component, then all steps of the next; or, in each
/// step, the whole of the first component, then that of the next.
/// @param layout with the number of components, and of steps of each
/// @param in_each_step which of both
/// @throws Error as `choose_scalar` when `options` do not say which component is wanted
std::unique_ptr<VolumeFile> open_stacked_components(const std::filesystem::path& header,
                                                    SeriesInfo info, const StoredLayout& layout,
                                                    bool in_each_step, const ReadOptions& options);

/// Steps, or components, along an axis between those of space. Each step reads all values.
/// @param layout with the number of steps or of components, not both
/// @param below number of axes of space that run faster than that axis: 1 or 2
/// @throws Error as `choose_scalar`
std::unique_ptr<VolumeFile> open_axis_between(const std::filesystem::path& header, SeriesInfo info,
                                              const StoredLayout& layout, int below,
                                              const ReadOptions& options);

} // namespace isochron::index
