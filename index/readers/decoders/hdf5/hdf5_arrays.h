// Finds the datasets of an HDF5 file that are volumes, and the roles of their dimensions.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_file.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// One dataset, or several whose paths differ only in the number of one group: one for each step.
/// @see grouped_arrays
struct Hdf5Array {
    std::string name;               ///< its path; `/data/*/rho` where there are several
    std::vector<Hdf5Dataset> steps; ///< in the order of their numbers
    /// Where there are several: what `*` stands for, with all before it.
    std::vector<std::string> groups;
    std::vector<std::string> offered = {}; ///< what it was chosen from, with types
    std::optional<std::string> note = {};  ///< how the numbers of the groups are read
    std::optional<std::string> open = {};  ///< that other numbers may count its steps
};

/// Picks the array that `options` name: by a path, the end of one, or a path with `*`; without a
/// name, the only volume. In openPMD's files of one iteration each, `*` stands for its number, so
/// that the array has the same name in all.
/// @throws Error listing the arrays, with type and shape, when the choice is ambiguous or wrong, or with
/// the options where names leave open which numbers count the steps
Hdf5Array choose_array(const Hdf5File& file, const ReadOptions& options);

} // namespace isochron::index
