// Makes grid, steps, units and notes of what a container states of an array.
#pragma once

#include "index/readers/formats/stated/stated_array.h"
#include "index/volume/volume_series.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// The roles of an array's dimensions, counted from the slowest.
struct ArrayLayout {
    std::array<std::size_t, 3> space{};        ///< the dimensions of the index axes, fastest first
    std::array<int, 3> physical{0, 1, 2};      ///< the physical axis along which each of them runs
    bool upright = false;                      ///< physical z is known to point upwards
    std::optional<std::size_t> time = {};      ///< dimension of the steps
    std::optional<std::size_t> component = {}; ///< dimension of components or channels
    std::optional<std::size_t> member = {};    ///< dimension of an ensemble's runs; one is read
    bool time_is_guessed = false;              ///< nothing says that this dimension is time
};

/// The roles of the axes z, y and x, which the format names.
inline ArrayLayout layout_of_zyx() {
    return {.space = {2, 1, 0}};
}

/// Finds the roles of dimensions by attributes (`role_by_attributes`), else by their names, else by
/// their order: time slowest, x fastest. Dimensions of length 1 that are not time are ignored. If
/// four without a role of their own are left, the first is time; but if it has no telling name, and
/// the first or the last has at most four entries, these may be components, and `options` must
/// decide.
/// @param why set to what is wrong, if there is no layout @return none unless exactly three
/// dimensions are left for space
std::optional<ArrayLayout> layout_of(const StatedArray& array, const ReadOptions& options,
                                     std::string* why = nullptr);

/// Completes the record by the attributes of the array and the groups around it, and finds its
/// layout. @param notes what was taken from where, and which axis is taken for time
/// @throws Error naming file and array: as `layout_of` says
ArrayLayout lay_out(StatedArray& array, const std::vector<StatedAttributes>& objects,
                    const ReadOptions& options, std::vector<std::string>& notes);

/// As `layout_of`, for a list: whether some options would give a layout.
bool may_be_volume(const StatedArray& array);

/// Sets grid (all but its vertices), unit of length, names of axes, space and notes. If axes have
/// units of different kinds, a power of ten brings them into proportion; a note says which.
/// @throws Error: coordinates that neither increase nor decrease, unless `options` have a spacing
void place_axes(const StatedArray& array, const ArrayLayout& layout, const ReadOptions& options,
                SeriesInfo& info);

/// Sets times and their unit, if the axis states them. The unit includes its reference date and,
/// if it is not the usual one, its calendar.
void place_steps(const StatedAxis& time, const ReadOptions& options, SeriesInfo& info);

/// The run of an ensemble that is read. @throws Error naming the file: no such member
std::size_t member_of(const StatedArray& array, const ArrayLayout& layout,
                      const ReadOptions& options);

/// `lev 18 x lat 64 x lon 128`; sizes alone where dimensions have no names.
std::string shape_text(const StatedArray& array);

} // namespace isochron::index
