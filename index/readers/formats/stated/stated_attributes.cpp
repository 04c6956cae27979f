// Reads attributes that several containers have in common into the record of an array.
//
// Huebl et al., "openPMD: a meta data standard for particle and mesh based data", version 1.1.0,
// section "Mesh Based Records", https://github.com/openPMD/openPMD-standard.
#include "index/readers/formats/stated/stated_attributes.h"

#include "index/readers/formats/stated/axis_roles.h"
#include "index/readers/formats/stated/stated_values.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <sstream>
#include <string_view>

namespace isochron::index {
namespace {

/// Numbers and texts of the nearest object that has an attribute.
class Nearest {
  public:
    explicit Nearest(const std::vector<StatedAttributes>& objects) : objects_(objects) {}

    std::vector<double> numbers(std::initializer_list<const char*> names, std::size_t count) const {
        for (const StatedAttributes& object : objects_)
            for (const char* name : names)
                if (auto found = object.numbers(name); found.size() == count)
                    return found;
        return {};
    }
    std::string text(std::initializer_list<const char*> names) const {
        for (const StatedAttributes& object : objects_)
            for (const char* name : names)
                if (std::string found = object.text(name); !found.empty())
                    return found;
        return {};
    }
    std::vector<std::string> texts(std::initializer_list<const char*> names,
                                   std::size_t count) const {
        for (const StatedAttributes& object : objects_)
            for (const char* name : names)
                if (auto found = object.texts(name); found.size() == count)
                    return found;
        return {};
    }

  private:
    const std::vector<StatedAttributes>& objects_;
};

/// Places axes, slowest first, that have no coordinates.
void set_regular(StatedArray& array, const std::vector<std::size_t>& axes,
                 const std::vector<double>& spacing, const std::vector<double>& first,
                 const std::vector<std::string>& units) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
        StatedAxis& axis = array.axes[axes[i]];
        axis.step = spacing[i];
        axis.first = i < first.size() ? first[i] : 0;
        axis.unit = i < units.size() ? units[i] : "";
        axis.regular = true;
    }
}

/// Names and resolutions in JSON, as vigra writes them: `{"axes": [{"key": "z", ...}, ...]}`.
void take_axistags(const std::string& text, StatedArray& array) {
    const auto tags = nlohmann::json::parse(text, nullptr, false);
    const auto axes = tags.is_object() ? tags.find("axes") : tags.end();
    if (!tags.is_object() || axes == tags.end() || axes->size() != array.axes.size())
        return;
    for (std::size_t i = 0; i < axes->size(); ++i) {
        const auto& tag = (*axes)[i];
        if (!tag.is_object() || !tag.contains("key") || !tag["key"].is_string())
            continue;
        StatedAxis& axis = array.axes[i];
        axis.name = tag["key"];
        if (const auto step = tag.find("resolution");
            step != tag.end() && step->is_number() && *step != 0 && axis.at.empty()) {
            axis.step = *step;
            axis.regular = true;
        }
    }
}

/// Puts lists of openPMD, which are in the order of the dimensions or in reverse, into their order.
template <class T>
std::vector<T> slowest_first(const Nearest& nearest, std::vector<T> of_axes) {
    if (nearest.text({"dataOrder"}) == "F")
        std::ranges::reverse(of_axes);
    return of_axes;
}

void take_open_pmd(const Nearest& nearest, const std::vector<StatedAttributes>& objects,
                   const std::vector<std::size_t>& space, StatedArray& array) {
    std::vector<double> spacing = slowest_first(nearest, nearest.numbers({"gridSpacing"}, 3)),
                        first = slowest_first(nearest, nearest.numbers({"gridGlobalOffset"}, 3)),
                        inside = slowest_first(nearest, objects.front().numbers("position"));
    if (spacing.empty())
        return;
    std::vector<double> meters = nearest.numbers({"gridUnitSI"}, 1);
    if (meters.empty()) // one for each axis, from version 2.0.0 on
        meters = slowest_first(nearest, nearest.numbers({"gridUnitSI"}, 3));
    const std::vector<std::string> units(3, meters.empty() ? "" : "m");
    meters.resize(3, meters.empty() ? 1 : meters.front());
    first.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
        first[i] = (first[i] + (inside.size() == 3 ? inside[i] * spacing[i] : 0)) * meters[i];
        spacing[i] *= meters[i];
    }
    set_regular(array, space, spacing, first, units);
}

/// `resolution` has a number for each dimension, or for each that is no channel and longer than 1,
/// or for those of space alone.
bool take_resolution(const StatedAttributes& object, const std::vector<std::size_t>& space,
                     StatedArray& array) {
    const std::vector<double> spacing = object.numbers("resolution"),
                              first = object.numbers("offset");
    std::vector<std::string> units = object.texts("units");
    std::vector<std::size_t> all, measured, longer;
    for (std::size_t i = 0; i < array.axes.size(); ++i) {
        all.push_back(i);
        if (role_by_name(array.axes[i].name) == AxisRole::channel)
            continue;
        measured.push_back(i);
        if (array.axes[i].length > 1)
            longer.push_back(i);
    }
    std::vector<std::size_t> axes;
    for (const std::vector<std::size_t>& some : {all, measured, longer, space})
        if (axes.empty() && some.size() == spacing.size())
            axes = some;
    if (axes.empty())
        return false;
    if (units.size() != axes.size())
        units.clear(); // the unit of the values, if it is one text
    set_regular(array, axes, spacing, first, units);
    return true;
}

} // namespace

void take_cf_attributes(const StatedAttributes& variable, StatedAxis& axis) {
    for (const char* name : {"units", "unit", "Units", "UNITS"})
        if (axis.unit.empty())
            axis.unit = variable.text(name);
    axis.axis = variable.text("axis");
    axis.standard_name = variable.text("standard_name");
    axis.positive = variable.text("positive");
    axis.calendar = variable.text("calendar");
    if (axis.calendar.empty()) // as FMS has it
        axis.calendar = variable.text("calendar_type");
    const Scaling scaling = scaling_by(variable, axis.coordinate);
    for (const char* name : {"_FillValue", "missing_value"})
        for (const double value : variable.numbers(name))
            axis.missing.push_back(scaling(value));
}

std::optional<std::size_t> coordinate_of(const std::string& dimension, const std::string& named,
                                         const std::vector<StatedAxis>& variables) {
    const auto role_in = [](const StatedAxis& variable) {
        const auto role = role_by_attributes(variable);
        return role ? role : role_by_name(variable.coordinate);
    };
    const auto wanted = role_by_name(dimension);
    std::vector<std::size_t> fit;
    for (std::size_t i = 0; i < variables.size(); ++i) {
        if (variables[i].coordinate == dimension)
            return i;
        if (!wanted || role_in(variables[i]) == wanted)
            fit.push_back(i);
    }
    std::istringstream names(named);
    for (std::string name; names >> name;)
        for (const std::size_t i : fit)
            if (variables[i].coordinate == name)
                return i;
    std::erase_if(fit, [&](std::size_t i) { return !role_by_attributes(variables[i]); });
    const bool agree = std::ranges::all_of(fit, [&](std::size_t i) {
        return role_in(variables[i]) == role_in(variables[fit.front()]);
    });
    return fit.empty() || !agree ? std::nullopt : std::optional(fit.front());
}

/// The axis of space, slowest first, along which physical x, y or z runs, by names or by order.
std::size_t axis_along(const StatedArray& array, const std::vector<std::size_t>& space,
                       AxisRole role) {
    for (std::size_t i = 0; i < space.size(); ++i)
        if (role_by_name(array.axes[space[i]].name) == role)
            return i;
    return 2 - static_cast<std::size_t>(role);
}

void take_axis_names(const std::vector<StatedAttributes>& objects, StatedArray& array) {
    if (const std::string tags = objects.front().text("axistags"); !tags.empty())
        take_axistags(tags, array);
    const auto take = [&](const std::vector<std::string>& names) {
        for (std::size_t i = 0; names.size() == array.axes.size() && i < names.size(); ++i)
            if (array.axes[i].name.empty())
                array.axes[i].name = names[i];
    };
    std::vector<std::string> names = objects.front().texts("axis_names");
    for (std::string& name : names)
        if (name.ends_with('^')) // funlib's mark of a dimension that is no place
            name.pop_back();
    take(names);
    const Nearest nearest(objects);
    if (!nearest.numbers({"gridSpacing"}, array.axes.size()).empty())
        take(slowest_first(nearest, nearest.texts({"axisLabels"}, array.axes.size())));
}

std::vector<std::string> take_grid_attributes(const std::vector<StatedAttributes>& objects,
                                              const std::array<std::size_t, 3>& slowest_first,
                                              const ReadOptions& options, StatedArray& array) {
    std::vector<std::string> notes;
    const std::vector<std::size_t> space(slowest_first.begin(), slowest_first.end());
    const auto placed = [&] {
        return std::ranges::any_of(space, [&](std::size_t i) {
            return array.axes[i].regular || !array.axes[i].at.empty();
        });
    };
    const Nearest nearest(objects);
    if (!placed())
        take_open_pmd(nearest, objects, space, array);
    if (placed())
        return notes;
    const auto said = [&](const char* from, std::vector<double> spacing) {
        std::ranges::reverse(spacing);
        notes.push_back(fmt::format("spacing {} taken from {}", fmt::join(spacing, " "), from));
    };
    if (const auto um = nearest.numbers({"element_size_um"}, 3); !um.empty()) {
        set_regular(array, space, um, {}, std::vector<std::string>(3, "um"));
        said("element_size_um", um);
        return notes;
    }
    if (take_resolution(objects.front(), space, array)) {
        notes.emplace_back("spacing taken from resolution");
        return notes;
    }
    const auto x = nearest.numbers({"dx", "DX"}, 1), y = nearest.numbers({"dy", "DY"}, 1),
               z = nearest.numbers({"dz", "DZ"}, 1);
    if (!x.empty() && !y.empty() && !z.empty()) {
        std::vector<double> spacing(3);
        spacing[axis_along(array, space, AxisRole::x)] = x.front();
        spacing[axis_along(array, space, AxisRole::y)] = y.front();
        spacing[axis_along(array, space, AxisRole::z)] = z.front();
        set_regular(array, space, spacing, {}, {});
        said("dx, dy and dz", spacing);
        return notes;
    }
    const std::vector<double> other =
        nearest.numbers({"spacing", "Spacing", "voxel_size", "voxelSize", "pixel_size"}, 3);
    if (!other.empty() && !options.spacing)
        notes.push_back(fmt::format(
            "an attribute may be the spacing, in either order: {:g} {:g} {:g} (--spacing)",
            other[0], other[1], other[2]));
    return notes;
}

std::vector<std::string>
curved_coordinates(const StatedAttributes& array,
                   const std::function<std::size_t(const std::string& name)>& long_dimensions) {
    const std::string named = array.text("coordinates");
    std::istringstream names(named);
    for (std::string name; names >> name;)
        if (long_dimensions(name) > 1)
            return {
                fmt::format("coordinates {} (a curved grid is shown straight)", excerpt(named))};
    return {};
}

std::optional<std::string> note_on_attributes(const StatedAttributes& array,
                                              const std::vector<std::string>& others) {
    static const std::set<std::string_view> kReadOrText{"geometry",
                                                        "geometryParameters",
                                                        "timeOffset",
                                                        "_ARRAY_DIMENSIONS",
                                                        "_ChunkSizes",
                                                        "_DeflateLevel",
                                                        "_Endianness",
                                                        "_FillValue",
                                                        "_NCProperties",
                                                        "_Netcdf4Coordinates",
                                                        "_Netcdf4Dimid",
                                                        "_Storage",
                                                        "_Unsigned",
                                                        "add_offset",
                                                        "axes",
                                                        "axis",
                                                        "axis_names",
                                                        "axisLabels",
                                                        "axistags",
                                                        "calendar",
                                                        "CLASS",
                                                        "comment",
                                                        "coordinates",
                                                        "dataOrder",
                                                        "description",
                                                        "DIMENSION_LABELS",
                                                        "DIMENSION_LIST",
                                                        "DX",
                                                        "dx",
                                                        "DY",
                                                        "dy",
                                                        "DZ",
                                                        "dz",
                                                        "element_size_um",
                                                        "FieldType",
                                                        "gridGlobalOffset",
                                                        "gridSpacing",
                                                        "gridUnitSI",
                                                        "history",
                                                        "institution",
                                                        "long_name",
                                                        "MemoryOrder",
                                                        "missing_value",
                                                        "NAME",
                                                        "name",
                                                        "offset",
                                                        "param",
                                                        "pixel_size",
                                                        "position",
                                                        "positive",
                                                        "REFERENCE_LIST",
                                                        "references",
                                                        "resolution",
                                                        "scale_factor",
                                                        "source",
                                                        "Spacing",
                                                        "spacing",
                                                        "stagger",
                                                        "standard_name",
                                                        "Time",
                                                        "time",
                                                        "timeUnitSI",
                                                        "title",
                                                        "unit",
                                                        "unitDimension",
                                                        "UNITS",
                                                        "Units",
                                                        "units",
                                                        "unitSI",
                                                        "valid_max",
                                                        "valid_min",
                                                        "valid_range",
                                                        "voxel_size",
                                                        "voxelSize"};
    std::vector<std::string> unread;
    for (const std::string& name : array.names())
        if (!kReadOrText.contains(name))
            unread.push_back(name);
    unread.insert(unread.end(), others.begin(), others.end());
    return note_on_unread(unread);
}

} // namespace isochron::index
