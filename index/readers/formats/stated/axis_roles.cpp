// Words of the CF conventions and of others by which axes are recognized.
#include "index/readers/formats/stated/axis_roles.h"

#include "index/lower_case.h"
#include "index/readers/formats/length_units.h"

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
constexpr std::array<RoleName, 16> kStandardNames{{
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
    {"realization", AxisRole::member},
}};

constexpr std::array<RoleName, 52> kDimensionNames{{
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
    {"c", AxisRole::channel},
    {"channel", AxisRole::channel},
    {"channels", AxisRole::channel},
    {"band", AxisRole::channel},
    {"component", AxisRole::channel},
    {"components", AxisRole::channel},
    {"comp", AxisRole::channel},
    {"member", AxisRole::member},
    {"members", AxisRole::member},
    {"ens", AxisRole::member},
    {"ensemble", AxisRole::member},
    {"ensemble_member", AxisRole::member},
    {"realization", AxisRole::member},
    {"number", AxisRole::member},
}};

} // namespace

std::optional<AxisRole> role_by_attributes(const StatedAxis& stated) {
    const std::string axis = lower_case(stated.axis), units = lower_case(stated.unit);
    constexpr std::string_view kAxes = "xyzt";
    if (axis.size() == 1 && kAxes.find(axis) != kAxes.npos)
        return static_cast<AxisRole>(kAxes.find(axis));
    if (stated.kind == "time" || !stated.dates.empty() || units.find(" since ") != units.npos)
        return AxisRole::time;
    if (stated.kind == "channel")
        return AxisRole::channel;
    for (const RoleName& known : kStandardNames)
        if (known.name.ends_with('_') ? stated.standard_name.starts_with(known.name)
                                      : stated.standard_name == known.name)
            return known.role;
    if (is_one_of(kEast, units))
        return AxisRole::x;
    if (is_one_of(kNorth, units))
        return AxisRole::y;
    if (is_one_of(kPressure, units) || is_one_of(kLevels, units) || !stated.positive.empty())
        return AxisRole::z;
    return std::nullopt;
}

std::optional<AxisRole> role_by_name(std::string_view dimension) {
    const auto found = std::ranges::find(kDimensionNames, lower_case(dimension), &RoleName::name);
    return found == kDimensionNames.end() ? std::nullopt : std::optional(found->role);
}

bool counts_downwards(const StatedAxis& axis) {
    const std::string positive = lower_case(axis.positive);
    if (!positive.empty())
        return positive == "down";
    return is_one_of(kPressure, lower_case(axis.unit));
}

std::string tidy_unit(const std::string& unit) {
    const std::string lower = lower_case(unit);
    if (is_one_of(kEast, lower) || is_one_of(kNorth, lower) || lower == "degree")
        return "degrees";
    return lower == "1" ? "" : tidy_length_unit(unit);
}

} // namespace isochron::index
