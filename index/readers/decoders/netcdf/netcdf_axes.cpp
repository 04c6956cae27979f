// Finds dimensions, coordinates and times of a NetCDF variable.
#include "index/readers/decoders/netcdf/netcdf_axes.h"

#include "index/error.h"
#include "index/readers/decoders/netcdf/netcdf_dates.h"
#include "index/readers/decoders/netcdf/netcdf_roles.h"
#include "index/readers/formats/axis_positions.h"
#include "index/readers/formats/stated_times.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

/// The positions of the vertices along a dimension, in its own unit.
struct Positions {
    std::string name, label;    ///< `lev`, `z (lev)`
    double first = 0, step = 1; ///< the step may be negative
    std::string unit;           ///< tidy; empty: none
    bool downwards = false;
    std::vector<double> at = {}; ///< positions of all vertices, where they are not even
};

struct Role {
    std::optional<AxisRole> role;
    bool told = false; ///< by more than a name of one letter
};

Role role_of(const NetcdfFile& file, const NetcdfVariable& variable,
             const NetcdfDimension& dimension) {
    if (const NetcdfVariable* coordinate = file.coordinate(variable, dimension))
        if (const auto role = role_by_attributes(file, *coordinate))
            return {role, true};
    return {role_by_name(dimension.name), dimension.name.size() > 1};
}

// Assigns each physical axis once: first to dimensions with a known role, then to the others in
// order, x fastest.
void assign_axes(const std::array<Role, 3>& roles, NetcdfLayout& layout) {
    std::array<bool, 3> known{}, taken{};
    for (std::size_t a = 0; a < 3; ++a) {
        if (!roles[a].role || *roles[a].role == AxisRole::time)
            continue;
        const auto physical = static_cast<std::size_t>(*roles[a].role);
        if (taken[physical])
            continue;
        known[a] = taken[physical] = true;
        layout.physical[a] = static_cast<int>(physical);
        layout.upright = layout.upright || (*roles[a].role == AxisRole::z && roles[a].told);
    }
    for (std::size_t a = 0; a < 3; ++a)
        if (!known[a]) {
            const auto free = std::ranges::find(taken, false);
            *free = true;
            layout.physical[a] = static_cast<int>(free - taken.begin());
        }
}

// Makes longitudes continue beyond 360 degrees instead of jumping back.
void unwrap(std::vector<double>& degrees) {
    for (std::size_t i = 1; i < degrees.size(); ++i)
        if (std::abs(degrees[i] - degrees[i - 1]) > 180)
            degrees[i] = degrees[i - 1] + std::remainder(degrees[i] - degrees[i - 1], 360.0);
}

std::string with_blank(const std::string& unit) {
    return unit.empty() ? "" : " " + unit;
}

/// An attribute of the variable, or else of the group that it is a component of.
std::vector<double> of_the_grid(const NetcdfFile& file, const NetcdfVariable& variable,
                                const char* attribute) {
    std::vector<double> numbers = file.numbers(variable, attribute);
    if (numbers.empty())
        numbers = file.numbers(group_of(variable), attribute);
    return numbers;
}

/// Reads `gridSpacing` and other attributes of openPMD
/// (https://github.com/openPMD/openPMD-standard, 1.1.0, "Mesh Based Records") for axes without
/// coordinates.
/// @param a the index axis, fastest first
void take_grid_attributes(const NetcdfFile& file, const NetcdfVariable& variable, std::size_t a,
                          Positions& positions) {
    const auto text = [&](const char* attribute) {
        const std::string own = file.text(variable, attribute);
        return own.empty() ? file.text(group_of(variable), attribute) : own;
    };
    const bool fastest_first = text("dataOrder") == "F";
    const std::vector<double> spacing = of_the_grid(file, variable, "gridSpacing");
    if (spacing.size() != 3)
        return;
    const std::size_t at = fastest_first ? a : 2 - a;
    const std::vector<double> offset = of_the_grid(file, variable, "gridGlobalOffset"),
                              unit = of_the_grid(file, variable, "gridUnitSI");
    const double meters = unit.size() == 1 ? unit.front() : 1;
    positions.step = spacing[at] * meters;
    positions.first = offset.size() == 3 ? offset[at] * meters : 0;
    positions.unit = unit.size() == 1 ? "m" : "";
}

Positions positions_along(const NetcdfFile& file, const NetcdfVariable& variable,
                          const NetcdfDimension& dimension, int physical,
                          const ReadOptions& options, std::vector<std::string>& notes) {
    Positions positions;
    positions.name = dimension.name;
    positions.label = fmt::format("{} ({})", "xyz"[physical], dimension.name);
    const NetcdfVariable* coordinate = file.coordinate(variable, dimension);
    if (!coordinate)
        return positions;
    positions.unit = tidy_unit(file.text(*coordinate, "units"));
    positions.downwards = physical == 2 && counts_downwards(file, *coordinate);
    std::vector<double> at = file.values(*coordinate);
    if (physical == 0 && positions.unit == "degrees")
        unwrap(at);
    try {
        const AxisSpread spread = spread_of(at, positions.label, positions.unit, file.name());
        positions.first = spread.first;
        positions.step = spread.step;
        if (spread.note)
            notes.push_back(*spread.note);
        if (spread.uneven)
            positions.at = at;
    } catch (const Error&) {
        if (!options.spacing)
            throw;
    }
    if (positions.downwards)
        notes.push_back(fmt::format("{} counts downwards and is shown with its sign reversed",
                                    positions.label));
    return positions;
}

/// The factor that brings coordinates along another axis into the unit of the coordinates along x,
/// or at least into proportion with them.
double to_go_with(const Positions& x, const Positions& other) {
    if (x.unit == other.unit)
        return 1;
    const auto meters_of_x = meters(x.unit), meters_of_other = meters(other.unit);
    if (meters_of_x && meters_of_other)
        return *meters_of_other / *meters_of_x;
    return std::pow(10.0, std::round(std::log10(std::abs(x.step / other.step))));
}

/// ` / 1000` where numbers are divided by it.
std::string scaled_by(double factor) {
    return factor == 1  ? ""
           : factor < 1 ? fmt::format(" / {:g}", 1 / factor)
                        : fmt::format(" * {:g}", factor);
}

bool in_one_unit(const std::array<Positions, 3>& axes) {
    return std::ranges::all_of(axes, [&](const Positions& axis) {
        return axis.unit == axes[0].unit || (meters(axis.unit) && meters(axes[0].unit));
    });
}

const NetcdfVariable* time_variable(const NetcdfFile& file, const NetcdfVariable& variable,
                                    const NetcdfLayout& layout) {
    std::vector<NetcdfDimension> dimensions;
    if (layout.time) {
        dimensions = {variable.dimensions[*layout.time]};
        if (const NetcdfVariable* coordinate = file.coordinate(variable, dimensions.front()))
            return coordinate;
    }
    for (const NetcdfVariable& other : file.variables())
        if (other.type && other.dimensions == dimensions &&
            role_by_attributes(file, other) == AxisRole::time &&
            (layout.time || file.text(other, "standard_name") == "time" ||
             role_by_name(other.name) == AxisRole::time))
            return &other;
    return nullptr;
}

/// Notes the sizes of cells that a weather model writes for the whole file (WRF: DX, DY). They say
/// nothing about heights, so they are not used unless the user gives them.
void offer_cell_sizes(const NetcdfFile& file, const NetcdfVariable& variable,
                      const NetcdfLayout& layout, SeriesInfo& info) {
    const std::vector<double> dx = of_the_grid(file, variable, "DX"),
                              dy = of_the_grid(file, variable, "DY");
    for (const std::size_t space : layout.space)
        if (file.coordinate(variable, variable.dimensions[space]))
            return;
    if (dx.size() == 1 && dy.size() == 1)
        info.notes.push_back(fmt::format("attributes say DX {:g} and DY {:g}: --spacing {:g} {:g} "
                                         "DZ, with DZ as the distance between levels, takes them",
                                         dx.front(), dy.front(), dx.front(), dy.front()));
}

} // namespace

std::optional<NetcdfLayout> layout_of(const NetcdfFile& file, const NetcdfVariable& variable) {
    const std::size_t count = variable.dimensions.size();
    std::vector<Role> roles;
    std::vector<std::size_t> long_ones; // slowest first
    NetcdfLayout layout;
    for (std::size_t i = 0; i < count; ++i) {
        roles.push_back(role_of(file, variable, variable.dimensions[i]));
        if (!layout.time && roles[i].role == AxisRole::time)
            layout.time = i;
        else if (variable.dimensions[i].length != 1)
            long_ones.push_back(i);
    }
    // If nothing tells the role of the slowest of four dimensions, it is time.
    if (!layout.time && long_ones.size() == 4 && !roles[long_ones.front()].role) {
        layout.time = long_ones.front();
        long_ones.erase(long_ones.begin());
    }
    if (long_ones.size() != 3)
        return std::nullopt;
    std::array<Role, 3> of_space;
    for (std::size_t a = 0; a < 3; ++a) {
        layout.space[a] = long_ones[2 - a];
        of_space[a] = roles[layout.space[a]];
    }
    assign_axes(of_space, layout);
    return layout;
}

void place_axes(const NetcdfFile& file, const NetcdfVariable& variable, const NetcdfLayout& layout,
                const ReadOptions& options, SeriesInfo& info) {
    std::array<Positions, 3> axes; // axes of physical space
    for (std::size_t a = 0; a < 3; ++a) {
        const int physical = layout.physical[a];
        const NetcdfDimension& dimension = variable.dimensions[layout.space[a]];
        Positions& axis = axes[static_cast<std::size_t>(physical)];
        axis = positions_along(file, variable, dimension, physical, options, info.notes);
        if (!file.coordinate(variable, dimension))
            take_grid_attributes(file, variable, a, axis);
    }
    glm::dmat3 steps(0.0);
    for (std::size_t a = 0; a < 3; ++a) {
        const int physical = layout.physical[a];
        const Positions& axis = axes[static_cast<std::size_t>(physical)];
        const double factor = to_go_with(axes[0], axis) * (axis.downwards ? -1 : 1);
        steps[static_cast<int>(a)][physical] = axis.step * factor;
        info.grid.origin[physical] = axis.first * factor + 0.0; // no -0
    }
    set_axes(info.grid, steps, file.name());
    for (std::size_t a = 0; a < 3; ++a) {
        const Positions& axis = axes[static_cast<std::size_t>(layout.physical[a])];
        if (!axis.at.empty())
            set_positions(info.grid, a, axis.at, to_go_with(axes[0], axis));
    }
    const bool one_unit = in_one_unit(axes);
    for (std::size_t a = 0; a < 3; ++a) {
        const Positions& axis = axes[a];
        std::string unit = axis.unit + scaled_by(to_go_with(axes[0], axis));
        unit.erase(0, unit.find_first_not_of(' ')); // the space before a unit without a factor
        info.axis_names[a] = with_own_unit((axis.downwards ? "-" : "") + axis.name,
                                           one_unit || options.spacing ? "" : unit);
    }
    if (one_unit) {
        info.length_unit = axes[0].unit;
    } else if (!options.spacing) {
        std::vector<std::string> units;
        for (const Positions& axis : axes)
            units.push_back(axis.label + with_blank(axis.unit) +
                            scaled_by(to_go_with(axes[0], axis)));
        info.notes.push_back(fmt::format("units differ: {}; --spacing sets other proportions",
                                         fmt::join(units, ", ")));
    }
    if (layout.upright)
        info.anatomy = Anatomy::enu;
    if (!options.spacing)
        offer_cell_sizes(file, variable, layout, info);
}

void place_steps(const NetcdfFile& file, const NetcdfVariable& variable, const NetcdfLayout& layout,
                 SeriesInfo& info) {
    const NetcdfVariable* time = time_variable(file, variable, layout);
    if (!time && layout.time)
        return place_dates(file, variable.dimensions[*layout.time], info);
    if (!time)
        return;
    StatedTimes stated{.name = time->name,
                       .values = file.values(*time),
                       .unit = file.text(*time, "units"),
                       .calendar = file.text(*time, "calendar")};
    if (stated.calendar.empty()) // as FMS has it
        stated.calendar = file.text(*time, "calendar_type");
    const Scaling scaling = file.scaling(*time);
    for (const char* attribute : {"_FillValue", "missing_value"})
        for (const double value : file.numbers(*time, attribute))
            stated.missing.push_back(scaling(value));
    place_times(std::move(stated), info);
}

} // namespace isochron::index
