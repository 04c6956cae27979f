// Which datasets of an HDF5 file are volumes, and which of their dimensions are what.
#pragma once

#include "index/decoders/hdf5_file.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// One dataset, or several whose paths differ in the number of one group: a step each.
struct Hdf5Array {
    std::string name;                      ///< its path; `/data/*/rho` where there are several
    std::vector<Hdf5Dataset> steps;        ///< in the order of their numbers
    std::vector<std::string> groups;       ///< of several: what `*` stands for, with all before it
    std::vector<std::string> offered = {}; ///< what it was chosen from, with types
};

/// Dimensions of a dataset, counted from the slowest.
struct Hdf5Layout {
    std::array<std::size_t, 3> space{}; ///< of the index axes, fastest first
    std::optional<std::size_t> time, component;
};

/// Of a dataset with these dimensions, of which those of length 1 count for nothing. Of four, time
/// is the first unless the first or the last may as well be components: at most four long.
/// @param options whether a component is asked for, or the extra axis is said to be time
/// @param why what is wrong with it, where it has no layout
std::optional<Hdf5Layout> layout_of(const Hdf5Dataset& dataset, const ReadOptions& options,
                                    std::string* why = nullptr);

/// Picks what `options` ask for: a path, the end of one, or a path with `*`; or the only volume.
/// @throws Error listing the arrays, with type and shape, when the choice is open or wrong
Hdf5Array choose_array(const Hdf5File& file, const ReadOptions& options);

} // namespace isochron::index
