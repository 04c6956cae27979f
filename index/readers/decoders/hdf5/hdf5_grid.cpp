// Places HDF5 arrays by scales and attributes.
//
// Huebl et al., "openPMD: a meta data standard for particle and mesh based data", version 1.1.0,
// section "Mesh Based Records", https://github.com/openPMD/openPMD-standard.
#include "index/readers/decoders/hdf5/hdf5_grid.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/axis_positions.h"
#include "index/readers/formats/stated_times.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace isochron::index {
namespace {

/// Positions along an index axis.
struct Hdf5Axis {
    std::string label; ///< empty: none
    AxisSpread spread;
    std::vector<double> at = {}; ///< coordinates, where there are any
    std::string unit;
    bool placed = false;
};

/// The paths of an object, its group, and the groups around that, up to the root.
std::vector<std::string> with_groups_around(std::string path) {
    std::vector<std::string> objects{path};
    while (path != "/" && !path.empty()) {
        path.resize(path.rfind('/'));
        if (path.empty())
            path = "/";
        objects.push_back(path);
    }
    return objects;
}

std::string inside(const std::string& group, const std::string& name) {
    return group == "/" ? "/" + name : fmt::format("{}/{}", group, name);
}

std::string last_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

/// The first attribute of these objects that has `count` numbers.
std::vector<double> numbers_at(const Hdf5File& file, const std::vector<std::string>& objects,
                               std::initializer_list<const char*> names, std::size_t count) {
    for (const std::string& object : objects)
        for (const char* name : names)
            if (auto found = file.numbers(object, name); found.size() == count)
                return found;
    return {};
}

std::string unit_of(const Hdf5File& file, const std::string& object) {
    for (const char* name : {"units", "unit", "Units", "UNITS"})
        if (std::string unit = file.text(object, name); !unit.empty())
            return unit == "1" ? "" : unit;
    return {};
}

class Placing {
  public:
    Placing(const Hdf5File& file, const Hdf5Dataset& dataset, const Hdf5Layout& layout,
            const ReadOptions& options, SeriesInfo& info)
        : file_(file), dataset_(dataset), layout_(layout), options_(options), info_(info),
          around_(with_groups_around(dataset.path)) {}

    void place() {
        take_labels();
        take_scales();
        take_grid_attributes();
        if (none_placed())
            take_coordinates();
        if (none_placed())
            take_spacings();
        write();
    }

  private:
    bool none_placed() const {
        return std::ranges::none_of(axes_, [](const Hdf5Axis& axis) { return axis.placed; });
    }
    std::size_t length_of(std::size_t a) const { return dataset_.dimensions[layout_.space[a]]; }

    void take_labels() {
        const auto labels = file_.texts(dataset_.path, "DIMENSION_LABELS");
        if (labels.size() == dataset_.dimensions.size())
            for (std::size_t a = 0; a < 3; ++a)
                axes_[a].label = labels[layout_.space[a]];
    }

    bool take_from(const std::string& path, Hdf5Axis& axis, std::size_t length) {
        const auto found = file_.dataset(path);
        if (!found || !found->type || found->dimensions != std::vector<std::uint64_t>{length})
            return false;
        axis.unit = unit_of(file_, path);
        if (axis.label.empty())
            axis.label = last_name(path);
        try {
            axis.at = file_.values(*found);
            axis.spread = spread_of(axis.at, path, axis.unit, file_.name());
        } catch (const Error&) {
            if (!options_.spacing)
                throw;
        }
        axis.placed = true;
        return true;
    }

    void take_scales() {
        const std::vector<std::string> scales = file_.scales(dataset_);
        for (std::size_t a = 0; a < 3; ++a)
            if (const std::string& path = scales[layout_.space[a]]; !path.empty())
                take_from(path, axes_[a], length_of(a));
    }

    /// Reads openPMD's attributes of the dataset or its group. They are of all axes of the mesh, in
    /// the order of the dimensions or in reverse.
    void take_grid_attributes() {
        const std::vector<std::string> here(
            around_.begin(), around_.begin() + std::min<std::ptrdiff_t>(2, std::ssize(around_)));
        const auto spacing = numbers_at(file_, here, {"gridSpacing"}, 3);
        if (spacing.empty() || !none_placed())
            return;
        const auto offset = numbers_at(file_, here, {"gridGlobalOffset"}, 3);
        const auto unit = numbers_at(file_, here, {"gridUnitSI"}, 1);
        const auto position = file_.numbers(dataset_.path, "position");
        std::vector<std::string> labels;
        bool fastest_first = false;
        for (const std::string& object : here) {
            if (labels.size() != 3)
                labels = file_.texts(object, "axisLabels");
            fastest_first = fastest_first || file_.text(object, "dataOrder") == "F";
        }
        const double to_meters = unit.empty() ? 1 : unit.front();
        for (std::size_t a = 0; a < 3; ++a) {
            Hdf5Axis& axis = axes_[a];
            const std::size_t at = fastest_first ? a : 2 - a;
            const double inside_cell = position.size() == 3 ? position[at] : 0;
            axis.spread.step = spacing[at] * to_meters;
            axis.spread.first =
                ((offset.empty() ? 0 : offset[at]) + inside_cell * spacing[at]) * to_meters;
            axis.unit = unit.empty() ? "" : "m";
            if (labels.size() == 3)
                axis.label = labels[at];
            axis.placed = true;
        }
    }

    /// Reads one-dimensional datasets with the names and lengths of the axes.
    void take_coordinates() {
        for (std::size_t i = 1; i < around_.size(); ++i) {
            std::array<std::string, 3> paths;
            for (std::size_t a = 0; a < 3; ++a)
                for (const char* name : {"xyz", "XYZ"}) {
                    const std::string path = inside(around_[i], std::string(1, name[a]));
                    const auto found = file_.dataset(path);
                    if (found && found->type &&
                        found->dimensions == std::vector<std::uint64_t>{length_of(a)})
                        paths[a] = path;
                }
            if (std::ranges::find(paths, "") != paths.end())
                continue;
            for (std::size_t a = 0; a < 3; ++a)
                take_from(paths[a], axes_[a], length_of(a));
            info_.notes.push_back(fmt::format("coordinates taken from {}", fmt::join(paths, ", ")));
            return;
        }
    }

    void set_spacings(const std::array<double, 3>& of_axes, const std::string& unit,
                      const std::string& from) {
        for (std::size_t a = 0; a < 3; ++a) {
            axes_[a].spread.step = of_axes[a];
            axes_[a].unit = unit;
            axes_[a].placed = true;
        }
        info_.notes.push_back(
            fmt::format("spacing {} taken from {}", fmt::join(of_axes, " "), from));
    }

    void take_spacings() {
        // ilastik and Fiji write it in the order of the dimensions.
        if (const auto um = numbers_at(file_, around_, {"element_size_um"}, 3); !um.empty())
            return set_spacings({um[2], um[1], um[0]}, "um", "element_size_um");
        const auto x = numbers_at(file_, around_, {"dx", "DX"}, 1),
                   y = numbers_at(file_, around_, {"dy", "DY"}, 1),
                   z = numbers_at(file_, around_, {"dz", "DZ"}, 1);
        if (!x.empty() && !y.empty() && !z.empty())
            return set_spacings({x[0], y[0], z[0]}, "", "dx, dy and dz");
        const std::initializer_list<const char*> others{"spacing",   "Spacing",    "voxel_size",
                                                        "voxelSize", "resolution", "pixel_size"};
        const auto other = numbers_at(file_, around_, others, 3);
        if (!other.empty() && !options_.spacing)
            info_.notes.push_back(fmt::format(
                "an attribute may be the spacing, in either order: {:g} {:g} {:g} (--spacing)",
                other[0], other[1], other[2]));
    }

    /// The physical axis of each index axis, if the labels are x, y and z.
    std::array<int, 3> physical_axes() const {
        std::array<int, 3> physical{0, 1, 2};
        std::array<int, 3> told{};
        for (std::size_t a = 0; a < 3; ++a) {
            const std::string label = lower_case(axes_[a].label);
            const std::size_t number =
                label.size() == 1 ? std::string("xyz").find(label) : std::string::npos;
            if (number == std::string::npos)
                return physical;
            told[a] = static_cast<int>(number);
        }
        return std::ranges::is_permutation(told, physical) ? told : physical;
    }

    void write() {
        const std::array<int, 3> physical = physical_axes();
        glm::dmat3 steps(0.0);
        for (std::size_t a = 0; a < 3; ++a) {
            const AxisSpread& spread = axes_[a].spread;
            steps[static_cast<int>(a)][physical[a]] = spread.step;
            info_.grid.origin[physical[a]] = spread.first + 0.0; // no -0
            if (spread.note)
                info_.notes.push_back(*spread.note);
        }
        set_axes(info_.grid, steps, file_.name());
        for (std::size_t a = 0; a < 3; ++a)
            if (axes_[a].spread.uneven)
                set_positions(info_.grid, a, axes_[a].at);
        const bool one_unit = axes_[0].unit == axes_[1].unit && axes_[0].unit == axes_[2].unit;
        for (std::size_t a = 0; a < 3; ++a)
            if (!axes_[a].label.empty())
                info_.axis_names[static_cast<std::size_t>(physical[a])] =
                    with_own_unit(last_name(axes_[a].label), one_unit ? "" : axes_[a].unit);
        if (one_unit)
            info_.length_unit = axes_[0].unit;
        else if (!options_.spacing)
            info_.notes.push_back(fmt::format("units differ: {} ({}), {} ({}), {} ({}); --spacing "
                                              "sets proportions",
                                              axes_[0].label, axes_[0].unit, axes_[1].label,
                                              axes_[1].unit, axes_[2].label, axes_[2].unit));
    }

    const Hdf5File& file_;
    const Hdf5Dataset& dataset_;
    const Hdf5Layout& layout_;
    const ReadOptions& options_;
    SeriesInfo& info_;
    std::vector<std::string> around_;
    std::array<Hdf5Axis, 3> axes_; ///< fastest first
};

/// Sets times from a one-dimensional dataset with `steps` values, if there is one.
void take_times(const Hdf5File& file, const std::string& path, std::size_t steps,
                SeriesInfo& info) {
    const auto found = file.dataset(path);
    if (!found || !found->type || found->dimensions != std::vector<std::uint64_t>{steps})
        return;
    StatedTimes stated{.name = path,
                       .values = file.values(*found),
                       .unit = unit_of(file, path),
                       .calendar = file.text(path, "calendar")};
    for (const char* name : {"_FillValue", "missing_value"})
        for (const double value : file.numbers(path, name))
            stated.missing.push_back(value);
    place_times(std::move(stated), info);
}

} // namespace

void place_hdf5(const Hdf5File& file, const Hdf5Dataset& dataset, const Hdf5Layout& layout,
                const ReadOptions& options, SeriesInfo& info) {
    Placing(file, dataset, layout, options, info).place();
}

void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const Hdf5Layout& layout,
               std::size_t steps, SeriesInfo& info) {
    if (layout.time) {
        const Hdf5Dataset& dataset = array.steps.front();
        if (const std::string path = file.scales(dataset)[*layout.time]; !path.empty())
            take_times(file, path, steps, info);
        const std::vector<std::string> around = with_groups_around(dataset.path);
        for (std::size_t i = 1; i < around.size(); ++i)
            for (const char* name : {"time", "Time", "times", "t"})
                if (info.times.empty())
                    take_times(file, inside(around[i], name), steps, info);
        return;
    }
    if (array.times) { // unless attributes say more
        info.times = array.times->times;
        info.time_unit = array.times->unit;
    }
    std::vector<double> times;
    std::string of_times;
    for (const Hdf5Dataset& step : array.steps) {
        const std::vector<std::string> around = with_groups_around(step.path);
        const auto time = numbers_at(file, around, kTimeAttributes, 1);
        if (time.empty())
            return;
        const auto unit = numbers_at(file, around, {"timeUnitSI"}, 1);
        times.push_back(time.front() * (unit.empty() ? 1 : unit.front()));
        if (!unit.empty())
            of_times = "s";
    }
    // A number that is equal for all steps belongs to the group around them and is not their time.
    if (times.size() > 1 && times.front() == times.back())
        return;
    info.times = std::move(times);
    info.time_unit = of_times;
}

} // namespace isochron::index
