// How axes are recognized: by words of the CF conventions.
#include "index/readers/decoders/netcdf/netcdf_roles.h"

#include "index/lower_case.h"
#include "index/readers/formats/text_header.h"

#include <algorithm>
#include <array>

namespace isochron::index {
namespace {

template <std::size_t kCount>
bool is_one_of(const std::array<std::string_view, kCount>& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

constexpr std::array<std::string_view, 6> kEast{"degrees_east", "degree_east", "degrees_e",
                                                "degree_e",     "degreese",    "degreee"};
constexpr std::array<std::string_view, 6> kNorth{"degrees_north", "degree_north", "degrees_n",
                                                 "degree_n",      "degreesn",     "degreen"};
constexpr std::array<std::string_view, 12> kPressure{"pa",       "pascal",    "hpa",  "hectopascal",
                                                     "kpa",      "mb",        "bar",  "mbar",
                                                     "millibar", "millibars", "dbar", "decibar"};
constexpr std::array<std::string_view, 3> kLevels{"level", "layer", "sigma_level"};

struct RoleName {
    std::string_view name;
    AxisRole role;
};

/// Standard names; a name that ends with _ is a prefix.
constexpr std::array<RoleName, 15> kStandardNames{{
    {"longitude", AxisRole::x},
    {"grid_longitude", AxisRole::x},
    {"projection_x_coordinate", AxisRole::x},
    {"latitude", AxisRole::y},
    {"grid_latitude", AxisRole::y},
    {"projection_y_coordinate", AxisRole::y},
    {"height", AxisRole::z},
    {"altitude", AxisRole::z},
    {"depth", AxisRole::z},
    {"air_pressure", AxisRole::z},
    {"model_level_number", AxisRole::z},
    {"atmosphere_", AxisRole::z},
    {"ocean_", AxisRole::z},
    {"height_above_", AxisRole::z},
    {"time", AxisRole::time},
}};

constexpr std::array<RoleName, 38> kDimensionNames{{
    {"x", AxisRole::x},
    {"nx", AxisRole::x},
    {"xc", AxisRole::x},
    {"lon", AxisRole::x},
    {"longitude", AxisRole::x},
    {"nlon", AxisRole::x},
    {"rlon", AxisRole::x},
    {"west_east", AxisRole::x},
    {"grid_longitude", AxisRole::x},
    {"y", AxisRole::y},
    {"ny", AxisRole::y},
    {"yc", AxisRole::y},
    {"lat", AxisRole::y},
    {"latitude", AxisRole::y},
    {"nlat", AxisRole::y},
    {"rlat", AxisRole::y},
    {"south_north", AxisRole::y},
    {"grid_latitude", AxisRole::y},
    {"z", AxisRole::z},
    {"nz", AxisRole::z},
    {"zc", AxisRole::z},
    {"lev", AxisRole::z},
    {"level", AxisRole::z},
    {"levels", AxisRole::z},
    {"plev", AxisRole::z},
    {"nlev", AxisRole::z},
    {"height", AxisRole::z},
    {"alt", AxisRole::z},
    {"altitude", AxisRole::z},
    {"depth", AxisRole::z},
    {"pressure", AxisRole::z},
    {"bottom_top", AxisRole::z},
    {"model_level_number", AxisRole::z},
    {"t", AxisRole::time},
    {"nt", AxisRole::time},
    {"time", AxisRole::time},
    {"times", AxisRole::time},
    {"ocean_time", AxisRole::time},
}};

struct LengthUnit {
    std::string_view name; ///< in lower case
    std::string_view tidy;
    double meters;
};
constexpr std::array<LengthUnit, 26> kLengthUnits{{
    {"m", "m", 1},
    {"meter", "m", 1},
    {"meters", "m", 1},
    {"metre", "m", 1},
    {"metres", "m", 1},
    {"km", "km", 1e3},
    {"kilometer", "km", 1e3},
    {"kilometers", "km", 1e3},
    {"kilometre", "km", 1e3},
    {"kilometres", "km", 1e3},
    {"cm", "cm", 1e-2},
    {"centimeter", "cm", 1e-2},
    {"centimeters", "cm", 1e-2},
    {"centimetre", "cm", 1e-2},
    {"centimetres", "cm", 1e-2},
    {"mm", "mm", 1e-3},
    {"millimeter", "mm", 1e-3},
    {"millimeters", "mm", 1e-3},
    {"millimetre", "mm", 1e-3},
    {"millimetres", "mm", 1e-3},
    {"um", "um", 1e-6},
    {"micrometer", "um", 1e-6},
    {"micrometers", "um", 1e-6},
    {"micrometre", "um", 1e-6},
    {"micrometres", "um", 1e-6},
    {"nm", "nm", 1e-9},
}};

const LengthUnit* length_unit(std::string_view unit) {
    const auto found = std::ranges::find(kLengthUnits, lower_case(unit), &LengthUnit::name);
    return found == kLengthUnits.end() ? nullptr : &*found;
}

} // namespace

std::optional<AxisRole> role_by_attributes(const NetcdfFile& file, const NetcdfVariable& variable) {
    const std::string axis = lower_case(file.text(variable, "axis"));
    constexpr std::string_view kAxes = "xyzt";
    if (axis.size() == 1 && kAxes.find(axis) != kAxes.npos)
        return static_cast<AxisRole>(kAxes.find(axis));
    const std::string units = lower_case(file.text(variable, "units"));
    if (units.find(" since ") != units.npos)
        return AxisRole::time;
    const std::string standard_name = file.text(variable, "standard_name");
    for (const RoleName& known : kStandardNames)
        if (known.name.ends_with('_') ? standard_name.starts_with(known.name)
                                      : standard_name == known.name)
            return known.role;
    if (is_one_of(kEast, units))
        return AxisRole::x;
    if (is_one_of(kNorth, units))
        return AxisRole::y;
    if (is_one_of(kPressure, units) || is_one_of(kLevels, units) ||
        !file.text(variable, "positive").empty())
        return AxisRole::z;
    return std::nullopt;
}

std::optional<AxisRole> role_by_name(std::string_view dimension) {
    const auto found = std::ranges::find(kDimensionNames, lower_case(dimension), &RoleName::name);
    return found == kDimensionNames.end() ? std::nullopt : std::optional(found->role);
}

bool counts_downwards(const NetcdfFile& file, const NetcdfVariable& variable) {
    const std::string positive = lower_case(file.text(variable, "positive"));
    if (!positive.empty())
        return positive == "down";
    return is_one_of(kPressure, lower_case(file.text(variable, "units")));
}

std::string tidy_unit(std::string_view unit) {
    const std::string lower = lower_case(unit);
    if (is_one_of(kEast, lower) || is_one_of(kNorth, lower) || lower == "degree")
        return "degrees";
    if (const LengthUnit* length = length_unit(unit))
        return std::string(length->tidy);
    return lower == "1" ? "" : std::string(unit);
}

std::optional<double> meters(std::string_view unit) {
    const LengthUnit* length = length_unit(unit);
    return length ? std::optional(length->meters) : std::nullopt;
}

} // namespace isochron::index
