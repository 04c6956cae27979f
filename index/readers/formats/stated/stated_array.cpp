// Reads attributes that several containers have in common into the record of an array.
//
// Huebl et al., "openPMD: a meta data standard for particle and mesh based data", version 1.1.0,
// section "Mesh Based Records", https://github.com/openPMD/openPMD-standard.
#include "index/readers/formats/stated/stated_array.h"

#include "index/readers/formats/stated/axis_roles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <initializer_list>
#include <sstream>

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

/// Reads openPMD's attributes, which are of all axes of the mesh, in the order of the dimensions or
/// in reverse.
void take_open_pmd(const Nearest& nearest, const std::vector<StatedAttributes>& objects,
                   const std::vector<std::size_t>& space, StatedArray& array) {
    const std::size_t count = space.size();
    std::vector<double> spacing = nearest.numbers({"gridSpacing"}, count),
                        offset = nearest.numbers({"gridGlobalOffset"}, count),
                        inside = objects.front().numbers("position");
    if (spacing.empty())
        return;
    std::vector<std::string> labels = nearest.texts({"axisLabels"}, count);
    if (nearest.text({"dataOrder"}) == "F") {
        std::ranges::reverse(spacing);
        std::ranges::reverse(offset);
        std::ranges::reverse(inside);
        std::ranges::reverse(labels);
    }
    const std::vector<double> unit = nearest.numbers({"gridUnitSI"}, 1);
    offset.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double meters = unit.empty() ? 1 : unit.front();
        offset[i] = (offset[i] + (inside.size() == count ? inside[i] * spacing[i] : 0)) * meters;
        spacing[i] *= meters;
        if (!labels.empty() && array.axes[space[i]].coordinate.empty())
            array.axes[space[i]].name = labels[i];
    }
    set_regular(array, space, spacing, offset,
                std::vector<std::string>(count, unit.empty() ? "" : "m"));
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

std::vector<std::string> take_grid_attributes(const std::vector<StatedAttributes>& objects,
                                              StatedArray& array) {
    std::vector<std::string> notes;
    const Nearest nearest(objects);
    if (const std::string tags = objects.front().text("axistags"); !tags.empty())
        take_axistags(tags, array);
    const std::size_t rank = array.axes.size();
    for (const char* attribute : {"axis_names", "axes"})
        if (const auto names = objects.front().texts(attribute); names.size() == rank)
            for (std::size_t i = 0; i < rank; ++i)
                if (array.axes[i].name.empty())
                    array.axes[i].name = names[i];
    std::vector<std::size_t> space; // slowest first
    for (std::size_t i = 0; i < rank; ++i) {
        const auto role = role_by_name(array.axes[i].name);
        if (!role || *role <= AxisRole::z)
            space.push_back(i);
        if (!array.axes[i].at.empty() && (!role || *role <= AxisRole::z))
            return notes; // there are coordinates
    }
    if (space.size() > 3)
        space.erase(space.begin(), space.end() - 3);
    if (space.size() < 3)
        return notes;
    // Names that are taken last count first: openPMD's labels are of the axes of space alone.
    take_open_pmd(nearest, objects, space, array);
    const auto placed = [&] {
        return std::ranges::any_of(space, [&](std::size_t i) { return array.axes[i].regular; });
    };
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
    if (auto spacing = objects.front().numbers("resolution"); spacing.size() == space.size()) {
        std::vector<std::string> units = objects.front().texts("units");
        if (units.size() != space.size())
            units.assign(space.size(), ""); // the unit of the values, if it is one text
        set_regular(array, space, spacing, objects.front().numbers("offset"), units);
        said("resolution", spacing);
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
    if (!other.empty())
        notes.push_back(fmt::format(
            "an attribute may be the spacing, in either order: {:g} {:g} {:g} (--spacing)",
            other[0], other[1], other[2]));
    return notes;
}

} // namespace isochron::index
