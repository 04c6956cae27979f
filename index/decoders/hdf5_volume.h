// A volume in an HDF5 file, whatever convention says where it is: what is known of it, and reading.
#pragma once

#include "index/decoders/decoded_file.h"
#include "index/decoders/hdf5_arrays.h"
#include "index/decoders/hdf5_values.h"

#include <memory>
#include <optional>
#include <vector>

namespace isochron::index {

/// What there is to read. Grid, times and units of `info` are of the convention.
struct Hdf5Volume {
    SeriesInfo info;
    std::vector<Hdf5Dataset> datasets; ///< one, or one for each step
    Hdf5Layout layout;
    bool on_cells = false;
    std::vector<std::uint64_t> places = {}; ///< of the steps along time; empty: one after the other
};

/// Sets the grid's vertices from the layout. @throws Error naming the file: too few or too many
void size_grid(const Hdf5File& file, Hdf5Volume& volume);

/// Chooses the component, sets array, type, scaling, unit of values and notes, and makes what reads.
/// Values that `_FillValue` or `missing_value` names become NaN.
/// @param name of the array
/// @throws Error naming the file
std::unique_ptr<DecodedFile> open_volume(std::unique_ptr<Hdf5File> file, const std::string& name,
                                         Hdf5Volume volume, const ReadOptions& options);

} // namespace isochron::index
