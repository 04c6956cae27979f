// What a container states of an array, before any of it is understood: NetCDF, Zarr, HDF5 and
// others fill the same record, and one piece of code makes grid, times, units and notes of it.
#pragma once

#include "index/volume/volume_series.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// One axis of an array. What is empty is not stated.
struct StatedAxis {
    std::string name;         ///< name of the dimension: `lev`
    std::uint64_t length = 0; ///< number of vertices, or of steps, or of components
    std::string kind;         ///< `space`, `time` or `channel`, as OME-Zarr's `type`

    /// The variable that has the coordinates, `height`; empty: there is none.
    std::string coordinate;
    std::vector<double> at;     ///< the coordinates of all vertices, scaled
    double first = 0, step = 1; ///< or the coordinate of the first vertex, and the distance
    bool regular = false;       ///< whether `first` and `step` are stated
    std::string unit;           ///< unit of the coordinates, as it is written

    /// Attributes of the CF conventions that the variable of the coordinates has.
    std::string axis, standard_name, positive, calendar;
    std::vector<double> missing; ///< coordinates that stand for missing ones, scaled
};

/// One array with its axes.
struct StatedArray {
    std::string file, name;       ///< for messages
    std::vector<StatedAxis> axes; ///< slowest first
};

/// The attributes of one object of a container: of an array, or of a group around it.
struct StatedAttributes {
    std::function<std::string(const char* name)> text;               ///< empty: there is none
    std::function<std::vector<std::string>(const char* name)> texts; ///< a list of texts
    std::function<std::vector<double>(const char* name)> numbers;    ///< empty: there is none
    std::function<bool(const char* name)> is_real;   ///< whether the numbers are f32 or f64
    std::function<std::vector<std::string>()> names; ///< names of all attributes
};

/// Takes the attributes of the CF conventions from the variable that has an axis' coordinates.
void take_cf_attributes(const StatedAttributes& variable, StatedAxis& axis);

/// Finds the variable with the coordinates of a dimension among those that have this dimension
/// alone: the one of the same name, else one that the array's attribute `coordinates` names, else
/// one whose attributes say which axis it is (CF conventions, chapters 4 and 5). Where the name of
/// the dimension says which axis it is, the variable must not say otherwise.
/// @param dimension its name @param named the attribute `coordinates`: names between blanks
/// @param variables candidates, the nearest group first; `coordinate` is the name of each
/// @return number of the variable; none
std::optional<std::size_t> coordinate_of(const std::string& dimension, const std::string& named,
                                         const std::vector<StatedAxis>& variables);

/// Takes names of axes from attributes that several programs write: openPMD's `axisLabels`, vigra's
/// and ilastik's `axistags`, `axis_names`.
/// @param objects the array, its group, and the groups around that
void take_axis_names(const std::vector<StatedAttributes>& objects, StatedArray& array);

/// Takes spacing and origin of axes without coordinates from such attributes: openPMD's
/// (`gridSpacing`, `gridGlobalOffset`, `gridUnitSI`, `dataOrder`, `position`), the resolution in
/// `axistags`, `element_size_um`, `resolution` with `offset` and `units`, and `dx`, `dy`, `dz`.
/// @param space the dimensions of space, slowest first
/// @return notes on what was taken from where, and on attributes that may be the spacing
std::vector<std::string> take_grid_attributes(const std::vector<StatedAttributes>& objects,
                                              const std::array<std::size_t, 3>& space,
                                              const ReadOptions& options, StatedArray& array);

/// What a note says of coordinates that place the vertices one by one, as on a curved grid, and that
/// are not used; empty without any.
/// @param long_dimensions how many dimensions longer than 1 a variable has; 0: there is none
std::vector<std::string>
curved_coordinates(const StatedAttributes& array,
                   const std::function<std::size_t(const std::string& name)>& long_dimensions);

/// A note on the attributes of an array that change neither values nor places here; texts that only
/// describe are left out. @param others further ones, with their values where short
std::optional<std::string> note_on_attributes(const StatedAttributes& array,
                                              const std::vector<std::string>& others = {});

} // namespace isochron::index
