// The surface between two steps: its cells beside those of VTK's blend, and its costs.
#pragma once

#include "index/file/index_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace isochron::bench {

/// VTK's blend has the type of the steps, to which it is cut off.
struct Difference {
    /// Cells that only one of both has, in percent of the exact ones; over some moments.
    double mean_percent = 0, most_percent = 0;
    /// Values, of 4,096, that VTK's blend lacks at a step that lacks none, between two that lack 410.
    std::uint64_t spoiled_values = 0;
};
/// @param file of at least two steps @param isovalue of cells at all moments
Difference difference_from_vtk(const std::shared_ptr<const index::IndexFile>& file,
                               double isovalue);

struct BetweenTimes {
    std::size_t cells = 0;
    /// [s] of processor time, medians, of cells with planes and normals.
    double moment = 0, step = 0, vtk = 0;
    double vtk_elapsed = 0;    ///< VTK's elapsed time over that of a moment, median of both
    double step_by_chunks = 0; ///< as a step that is too large to be worked on as a whole
    double drawn_moment = 0, drawn_step = 0; ///< with the volume around the cells
    double cold_bytes = 0;                   ///< read for a moment, over those of a step
};
/// Processor time of building an index that says what blends are worth, over one that does not: the
/// median of so many pairs, in turn. @param file is written and removed
double time_of_measuring(index::VolumeSeries& series, const std::filesystem::path& file,
                         unsigned repeats, const std::function<void()>& check);

/// @param file of at least two steps, without scaling
BetweenTimes time_between(const std::shared_ptr<const index::IndexFile>& file, double isovalue,
                          unsigned repeats);

} // namespace isochron::bench
