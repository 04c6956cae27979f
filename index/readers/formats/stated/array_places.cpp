// Finds dimensions, coordinates and times of an array by what its container states.
#include "index/readers/formats/stated/array_places.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/axis_positions.h"
#include "index/readers/formats/length_units.h"
#include "index/readers/formats/stated/axis_roles.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::index {
namespace {

/// The positions of the vertices along an axis, in its own unit.
struct Positions {
    std::string name, label;    ///< `lev`, `z (lev)`
    double first = 0, step = 1; ///< the step may be negative
    std::string unit, written;  ///< tidy, empty: none; and as it is stated
    bool downwards = false, stated = false;
    bool shares_unit = false;    ///< if none is stated
    std::vector<double> at = {}; ///< positions of all vertices, where they are not even
};

struct Role {
    std::optional<AxisRole> role;
    bool told = false; ///< by more than a name of one letter
};

Role role_of(const StatedAxis& axis) {
    if (const auto role = role_by_attributes(axis))
        return {role, true};
    for (const std::string& name : {axis.name, axis.coordinate})
        if (const auto role = role_by_name(name))
            return {role, name.size() > 1};
    return {};
}

/// Whether a dimension has a name that says something: libraries number those without one.
bool has_telling_name(const StatedAxis& axis) {
    const std::string name = lower_case(axis.name);
    for (const char* numbered : {"dim_", "phony_dim_", "dim", "axis_", "axis"})
        if (name.starts_with(numbered) &&
            name.find_first_not_of("0123456789", std::string(numbered).size()) == name.npos)
            return false;
    return !name.empty();
}

// Assigns each physical axis once: first to dimensions with a known role, then to the others in
// order, x fastest.
void assign_axes(const std::array<Role, 3>& roles, ArrayLayout& layout) {
    std::array<bool, 3> known{}, taken{};
    for (std::size_t a = 0; a < 3; ++a) {
        if (!roles[a].role || *roles[a].role > AxisRole::z)
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

Positions positions_along(const StatedArray& array, const StatedAxis& axis, int physical,
                          const ReadOptions& options, std::vector<std::string>& notes) {
    Positions positions;
    positions.name = axis.coordinate.empty() ? axis.name : axis.coordinate;
    positions.label = positions.name.empty()
                          ? std::string(1, "xyz"[physical])
                          : fmt::format("{} ({})", "xyz"[physical], positions.name);
    if (axis.at.empty() && !axis.regular)
        return positions;
    positions.stated = true;
    positions.unit = tidy_unit(axis.unit);
    positions.written = axis.unit;
    positions.shares_unit = axis.at.empty() && axis.unit.empty();
    positions.downwards = physical == 2 && counts_downwards(axis);
    if (axis.at.empty()) {
        positions.first = axis.first;
        positions.step = axis.step;
    } else {
        std::vector<double> at = axis.at;
        if (physical == 0 && positions.unit == "degrees")
            unwrap(at);
        try {
            const AxisSpread spread = spread_of(at, positions.label, positions.unit, array.file);
            positions.first = spread.first;
            positions.step = spread.step;
            if (spread.note)
                notes.push_back(*spread.note);
            if (spread.uneven)
                positions.at = std::move(at);
        } catch (const Error&) {
            if (!options.spacing)
                throw;
        }
    }
    if (positions.downwards)
        notes.push_back(fmt::format("{} counts downwards and is shown with its sign reversed",
                                    positions.label));
    return positions;
}

/// Along x, y and z, of axes that have directions: each has the name of the axis that runs along it.
std::array<Positions, 3> positions_by(const StatedArray& array, const ArrayLayout& layout) {
    constexpr double kAligned = 1e-6; // share of the length
    const StatedDirections& stated = *array.directions;
    std::array<Positions, 3> axes;
    for (int physical = 0; physical < 3; ++physical) {
        const auto p = static_cast<std::size_t>(physical);
        Positions& axis = axes[p];
        double step = 0;
        for (int a = 0; a < 3; ++a) {
            const double along = std::abs(stated.steps[a][physical]);
            step = std::max(step, along);
            if (std::abs(along / glm::length(stated.steps[a]) - 1) < kAligned)
                axis.name = array.axes[layout.space[static_cast<std::size_t>(a)]].name;
        }
        axis.label = std::string(1, "xyz"[physical]);
        axis.first = stated.origin[physical];
        axis.step = step > 0 ? step : 1;
        axis.written = stated.units[p];
        axis.unit = tidy_unit(axis.written);
        axis.stated = true;
        axis.shares_unit = axis.written.empty();
    }
    return axes;
}

/// The factor that brings coordinates along an axis into the unit of others, or at least into
/// proportion with them.
double to_go_with(const Positions& one, const Positions& other) {
    if (one.unit == other.unit || !other.stated)
        return 1;
    const auto meters_of_one = meters_in(one.unit), meters_of_other = meters_in(other.unit);
    if (meters_of_one && meters_of_other)
        return *meters_of_other / *meters_of_one;
    return std::pow(10.0, std::round(std::log10(std::abs(one.step / other.step))));
}

/// ` / 1000` where numbers are divided by it.
std::string scaled_by(double factor) {
    return factor == 1  ? ""
           : factor < 1 ? fmt::format(" / {:g}", 1 / factor)
                        : fmt::format(" * {:g}", factor);
}

/// A distance that is stated without a unit is in that of the others; one in pixels is not.
void share_units(std::array<Positions, 3>& axes) {
    const auto with_unit = std::ranges::find_if(
        axes, [](const Positions& axis) { return meters_in(axis.unit).has_value(); });
    if (with_unit == axes.end())
        return;
    for (Positions& axis : axes)
        if (axis.shares_unit)
            axis.unit = with_unit->unit;
        else if (axis.unit.empty() && axis.written != "1")
            axis.unit = axis.written;
}

bool in_one_unit(const std::array<Positions, 3>& axes) {
    return std::ranges::all_of(axes, [&](const Positions& axis) {
        return axis.unit == axes[0].unit || (meters_in(axis.unit) && meters_in(axes[0].unit));
    });
}

/// Names and units of axes, as they are shown.
void name_axes(const std::array<Positions, 3>& axes, const ReadOptions& options, SeriesInfo& info) {
    const bool one_unit = in_one_unit(axes);
    std::vector<std::string> units;
    for (std::size_t a = 0; a < 3; ++a) {
        const Positions& axis = axes[a];
        const std::string factor = scaled_by(to_go_with(axes[0], axis));
        std::string unit = axis.unit + factor;
        unit.erase(0, unit.find_first_not_of(' ')); // the space before a unit without a factor
        const bool own_unit = !one_unit && !options.spacing;
        if (!axis.name.empty() || own_unit)
            info.axis_names[a] = with_own_unit((axis.downwards ? "-" : "") +
                                                   (axis.name.empty() ? axis.label : axis.name),
                                               own_unit ? unit : "");
        units.push_back(axis.label + with_blank(axis.unit) + factor);
    }
    if (one_unit)
        info.length_unit = axes[0].unit;
    if (options.spacing)
        return;
    if (!one_unit)
        info.notes.push_back(fmt::format("units differ: {}; --spacing sets other proportions",
                                         fmt::join(units, ", ")));
    else if (axes[1].unit != axes[0].unit || axes[2].unit != axes[0].unit)
        info.notes.push_back(fmt::format("lengths along x, y and z are in {}, {} and {}: all are "
                                         "given in {}",
                                         axes[0].unit, axes[1].unit, axes[2].unit, axes[0].unit));
}

} // namespace

std::optional<ArrayLayout> layout_of(const StatedArray& array, const ReadOptions& options,
                                     std::string* why) {
    constexpr std::uint64_t kMostComponents = 9, kMaybeComponents = 4;
    const auto fail = [&](std::string reason) {
        if (why)
            *why = std::move(reason);
        return std::nullopt;
    };
    const auto length = [&](std::size_t i) { return array.axes[i].length; };
    std::vector<Role> roles;
    std::vector<std::size_t> left; // slowest first
    ArrayLayout layout;
    for (std::size_t i = 0; i < array.axes.size(); ++i) {
        roles.push_back(role_of(array.axes[i]));
        const auto role = roles.back().role;
        if (!layout.time && role == AxisRole::time)
            layout.time = i;
        else if (length(i) == 1)
            continue;
        else if (!layout.component && role == AxisRole::channel)
            layout.component = i;
        else if (!layout.member && role == AxisRole::member)
            layout.member = i;
        else
            left.push_back(i);
    }
    if (left.size() < 3 && layout.component) { // a name alone is no reason to have no volume
        left.push_back(*layout.component);
        std::ranges::sort(left);
        layout.component.reset();
    }
    const auto take = [&](std::size_t at) {
        const std::size_t taken = left[at];
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
        return taken;
    };
    if (options.component && left.size() > 3 && !layout.component) {
        // Components are the last axis, or the first one, or the second one after time.
        const std::size_t first = left.size() - 4;
        std::size_t at = left.size() - 1;
        if (length(left[at]) > kMostComponents || roles[left[at]].role ||
            (length(left[first]) < length(left[at]) && length(left[first]) <= kMaybeComponents &&
             !roles[left[first]].role))
            at = first;
        if (length(left[at]) > kMostComponents)
            return fail(fmt::format("no axis of at most {} components", kMostComponents));
        layout.component = take(at);
    }
    if (left.size() == 4 && !layout.time && !roles[left.front()].role) {
        const bool open = !has_telling_name(array.axes[left.front()]) &&
                          (length(left.front()) <= kMaybeComponents ||
                           (length(left.back()) <= kMaybeComponents && !roles[left.back()].role));
        if (open && !options.any_array && !options.component && !options.extra_axis_is_time)
            return fail("its first axis may be time (--extra-axis-is-time) or an axis components "
                        "(--component 0, 1, ... or magnitude)");
        layout.time = take(0);
        layout.time_is_guessed = true;
    }
    if (left.size() != 3)
        return fail(left.size() > 3 ? "expected three axes, time, and components with --component"
                                    : "expected three axes of more than one vertex besides time");
    std::array<Role, 3> of_space;
    for (std::size_t a = 0; a < 3; ++a) {
        layout.space[a] = left[2 - a];
        of_space[a] = roles[layout.space[a]];
    }
    assign_axes(of_space, layout);
    return layout;
}

ArrayLayout lay_out(StatedArray& array, const std::vector<StatedAttributes>& objects,
                    const ReadOptions& options, std::vector<std::string>& notes) {
    take_axis_names(objects, array);
    std::string why;
    const auto layout = layout_of(array, options, &why);
    if (!layout)
        throw Error("{}: {} ({}): {}", array.file, array.name, shape_text(array), why);
    std::array<std::size_t, 3> space = layout->space;
    std::ranges::reverse(space);
    for (std::string& note : take_grid_attributes(objects, space, options, array))
        notes.push_back(std::move(note));
    if (layout->time_is_guessed)
        notes.push_back(fmt::format("the first axis of {} ({}) is taken for time", array.name,
                                    shape_text(array)));
    return *layout;
}

bool may_be_volume(const StatedArray& array) {
    ReadOptions as_time, components;
    as_time.extra_axis_is_time = true;
    components.component = "0";
    return layout_of(array, as_time) || layout_of(array, components);
}

void place_axes(const StatedArray& array, const ArrayLayout& layout, const ReadOptions& options,
                SeriesInfo& info) {
    std::array<Positions, 3> axes; // axes of physical space
    for (std::size_t a = 0; a < 3; ++a) {
        const int physical = layout.physical[a];
        axes[static_cast<std::size_t>(physical)] =
            positions_along(array, array.axes[layout.space[a]], physical, options, info.notes);
    }
    glm::dmat3 steps(0.0);
    if (array.directions) {
        steps = array.directions->steps;
        axes = positions_by(array, layout);
    } else {
        for (std::size_t a = 0; a < 3; ++a)
            steps[static_cast<int>(a)][layout.physical[a]] =
                axes[static_cast<std::size_t>(layout.physical[a])].step;
    }
    share_units(axes);
    for (int physical = 0; physical < 3; ++physical) {
        const Positions& axis = axes[static_cast<std::size_t>(physical)];
        const double factor = to_go_with(axes[0], axis) * (axis.downwards ? -1 : 1);
        for (int a = 0; a < 3; ++a)
            steps[a][physical] *= factor;
        info.grid.origin[physical] = axis.first * factor + 0.0; // no -0
    }
    set_axes(info.grid, steps, array.file);
    for (std::size_t a = 0; a < 3; ++a) {
        const Positions& axis = axes[static_cast<std::size_t>(layout.physical[a])];
        if (!axis.at.empty())
            set_positions(info.grid, a, axis.at, to_go_with(axes[0], axis));
    }
    name_axes(axes, options, info);
    if (layout.upright)
        info.anatomy = Anatomy::enu;
}

void place_steps(const StatedAxis& time, const ReadOptions& options, SeriesInfo& info) {
    StatedTimes stated{.name = time.coordinate.empty() ? time.name : time.coordinate,
                       .values = time.at,
                       .unit = time.unit == "1" ? "" : time.unit,
                       .calendar = time.calendar,
                       .missing = time.missing};
    if (!time.dates.empty())
        return place_dates(time.dates, stated.name, info, options.dates);
    if (time.at.empty()) {
        if (!time.regular || (time.length == 1 && time.first == 0))
            return;
        if (!std::isfinite(time.first) || !(time.step > 0)) {
            info.notes.push_back(fmt::format("steps are {} apart by the file: their times are not "
                                             "used (--time-step)",
                                             time.step));
            return;
        }
        for (std::uint64_t i = 0; i < time.length; ++i)
            stated.values.push_back(time.first + static_cast<double>(i) * time.step);
    }
    place_times(std::move(stated), info, options.dates);
}

std::size_t member_of(const StatedArray& array, const ArrayLayout& layout,
                      const ReadOptions& options) {
    if (!layout.member) {
        if (options.member && !options.any_array)
            throw Error("{}: {} ({}) has no axis of members, --member names one", array.file,
                        array.name, shape_text(array));
        return 0;
    }
    const StatedAxis& axis = array.axes[*layout.member];
    if (!options.member && options.any_array)
        return 0;
    if (!options.member || *options.member >= axis.length)
        throw Error("{}: {} has {} members along {}{}, choose one with --member 0 to {}",
                    array.file, array.name, axis.length, axis.name,
                    options.member ? fmt::format(", not {}", *options.member) : "",
                    axis.length - 1);
    return *options.member;
}

std::string shape_text(const StatedArray& array) {
    std::vector<std::string> axes;
    for (const StatedAxis& axis : array.axes)
        axes.push_back(has_telling_name(axis) ? fmt::format("{} {}", axis.name, axis.length)
                                              : fmt::format("{}", axis.length));
    return fmt::format("{}", fmt::join(axes, " x "));
}

} // namespace isochron::index
