// Reads attributes that several containers have in common into the record of an array.
#pragma once

#include "index/readers/formats/stated/stated_array.h"
#include "index/volume/volume_series.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

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
