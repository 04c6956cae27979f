// A volume in an HDF5 file, found by any convention: its description and its reading.
#pragma once

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/decoders/hdf5/hdf5_arrays.h"
#include "index/readers/decoders/hdf5/hdf5_values.h"
#include "index/readers/formats/stated/array_places.h"

#include <memory>
#include <vector>

namespace isochron::index {

/// The volume to read. The convention has set grid, times and units of `info`.
struct Hdf5Volume {
    SeriesInfo info;
    std::vector<Hdf5Dataset> datasets; ///< one, or one for each step
    ArrayLayout layout;
    bool on_cells = false;
    std::size_t member = 0; ///< the run of an ensemble that is read
    /// Indices of the steps along time; empty: 0, 1, 2, ...
    std::vector<std::uint64_t> places = {};
};

/// Sets the number of vertices of the grid from the layout. @throws Error naming the file: too few
/// or too many
void size_grid(const Hdf5File& file, Hdf5Volume& volume);

/// Chooses the component, sets array, type, scaling, unit of values and notes, and makes the
/// reader. Values equal to `_FillValue` or `missing_value` become NaN.
/// @param name of the array
/// @throws Error naming the file
std::unique_ptr<DecodedFile> open_volume(std::unique_ptr<Hdf5File> file, const std::string& name,
                                         Hdf5Volume volume, const ReadOptions& options);

} // namespace isochron::index
