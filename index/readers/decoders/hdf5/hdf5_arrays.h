// Finds the datasets of an HDF5 file that are volumes, and the roles of their dimensions.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_file.h"
#include "index/readers/formats/series/numbered_groups.h"

#include <array>
#include <cstddef>
#include <initializer_list>
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
    std::optional<GroupTimes> times = {};  ///< that the names of the groups state
};

/// Attributes of a group, or of one around it, that state its time.
inline constexpr std::initializer_list<const char*> kTimeAttributes{"time", "Time", "TIME", "t"};

/// Dimensions of a dataset, counted from the slowest.
struct Hdf5Layout {
    std::array<std::size_t, 3> space{}; ///< dimensions of the index axes, fastest first
    std::optional<std::size_t> time, component;
};

/// The roles of a dataset's dimensions; dimensions of length 1 are ignored. If four are left, the
/// first is time; but if the first or the last has at most four entries, it may be components, and
/// the options must decide.
/// @param options whether a component is asked for, or the extra axis is declared to be time
/// @param why set to what is wrong, if the dataset has no layout
std::optional<Hdf5Layout> layout_of(const Hdf5Dataset& dataset, const ReadOptions& options,
                                    std::string* why = nullptr);

/// Picks the array that `options` name: by a path, the end of one, or a path with `*`; without a
/// name, the only volume. In openPMD's files of one iteration each, `*` stands for its number, so
/// that the array has the same name in all.
/// @throws Error listing the arrays, with type and shape, when the choice is ambiguous or wrong, or with
/// the options where names leave open which numbers count the steps
Hdf5Array choose_array(const Hdf5File& file, const ReadOptions& options);

} // namespace isochron::index
