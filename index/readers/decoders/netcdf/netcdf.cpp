// Reads NetCDF (classic, 64-bit offset, CDF-5 and NetCDF-4) through Unidata's library.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/netcdf/netcdf_stated.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/series/numbered_groups.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stated/group_times.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_values.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// Names of variables that hold cell bounds of coordinates, which are not fields to show.
std::vector<std::string> bounds_in(const NetcdfFile& file) {
    std::vector<std::string> names;
    for (const NetcdfVariable& variable : file.variables())
        for (const char* attribute : {"bounds", "climatology"})
            if (const std::string name = file.text(variable, attribute); !name.empty())
                names.push_back(variable.name.substr(0, variable.name.rfind('/') + 1) + name);
    return names;
}

[[noreturn]] void fail_without_volume(const NetcdfFile& file) {
    constexpr std::size_t kListed = 8;
    std::vector<std::string> found;
    for (const NetcdfVariable& variable : file.variables())
        if (variable.dimensions.size() > 1 && found.size() < kListed)
            found.push_back(text(variable));
    throw Error("{}: holds no array with three dimensions of more than one vertex besides time{}{}",
                file.name(), found.empty() ? "" : ": ", fmt::join(found, ", "));
}

bool is_volume(const NetcdfFile& file, const NetcdfVariable& variable) {
    return may_be_volume(stated(file, variable, false));
}

/// Variables with three dimensions, and those of several groups that are the steps of one.
struct Offered {
    std::vector<StoredArray> arrays;
    std::vector<std::vector<const NetcdfVariable*>> steps; ///< variables of each array
    std::vector<std::string> notes;
};

/// @throws Error naming the file: names leave open which groups are the steps
Offered offered_in(const NetcdfFile& file, const ReadOptions& options) {
    const std::vector<std::string> bounds = bounds_in(file);
    std::vector<const NetcdfVariable*> variables;
    std::vector<GroupedPath> paths;
    for (const NetcdfVariable& variable : file.variables())
        if (is_volume(file, variable) && std::ranges::find(bounds, variable.name) == bounds.end() &&
            (variable.type || options.array == variable.name)) {
            std::vector<std::size_t> lengths;
            for (const NetcdfDimension& dimension : variable.dimensions)
                lengths.push_back(dimension.length);
            variables.push_back(&variable);
            paths.push_back({variable.name, fmt::format("{}", fmt::join(lengths, " x "))});
        }
    const auto has_time = [&](const std::string& group) {
        return states_time(attributes_of(file, group));
    };
    Offered offered;
    const bool by_pattern = options.array && options.array->find('*') != std::string::npos;
    for (const GroupedArray& array :
         by_pattern ? std::vector{matching_arrays(paths, *options.array, file.name())}
                    : grouped_arrays(paths, has_time)) {
        if (!array.or_else.empty() && !options.any_array)
            throw Error("{}: {}", file.name(), which_steps(array));
        if (!array.or_else.empty() && offered.notes.empty())
            offered.notes.push_back(which_steps(array));
        std::vector<const NetcdfVariable*>& steps = offered.steps.emplace_back();
        for (const std::size_t step : array.steps)
            steps.push_back(variables[step]);
        offered.arrays.push_back({.name = array.name,
                                  .type = steps.front()->type,
                                  .shape = paths[array.steps.front()].kind,
                                  .by_pattern = true});
        if (steps.size() > 1)
            offered.arrays.back().shape += fmt::format(", {} steps", steps.size());
    }
    return offered;
}

/// The variable that `options` ask for among those with three dimensions: one, or one for each step.
/// @throws Error naming the file, as `choose_scalar` does, or when it has others
std::vector<NetcdfVariable> choose_variables(const NetcdfFile& file, const ReadOptions& options,
                                             std::string& name) {
    const auto& variables = file.variables();
    if (options.array) {
        const auto named = std::ranges::find(variables, *options.array, &NetcdfVariable::name);
        if (named != variables.end() && !is_volume(file, *named))
            throw Error(
                "{}: array {}, expected three dimensions of more than one vertex besides time",
                file.name(), text(*named));
        name = *options.array;
        if (named != variables.end())
            return {*named};
    }
    const Offered offered = offered_in(file, options);
    if (offered.arrays.empty())
        fail_without_volume(file);
    ReadOptions which = options;
    which.component.reset(); // components are an axis here
    name = choose_scalar(offered.arrays, which, file.name()).array.name;
    std::vector<NetcdfVariable> steps;
    for (std::size_t i = 0; i < offered.arrays.size() && steps.empty(); ++i)
        if (offered.arrays[i].name == name)
            for (const NetcdfVariable* step : offered.steps[i])
                steps.push_back(*step);
    return steps;
}

/// Formats within NetCDF whose values would be wrong if they were read as they are stored.
void expect_no_other_format(const NetcdfFile& file) {
    for (const NetcdfVariable& variable : file.variables())
        if (file.text(variable, "varid").starts_with("MINC standard variable"))
            throw Error("{}: MINC 1, which scales each slice in its own way, expected plain "
                        "NetCDF; mnc2nii of the MINC tools makes NIfTI of it",
                        file.name());
    if (!file.variables().empty() &&
        file.text(file.at(""), "Conventions").find("AMBER") != std::string::npos)
        throw Error("{}: a trajectory of AMBER, expected volumes", file.name());
}

/// Notes the sizes of cells that a weather model writes for the whole file (WRF: DX, DY). They say
/// nothing about heights, so they are not used unless the user gives them.
void offer_cell_sizes(const std::vector<StatedAttributes>& objects, const StatedArray& array,
                      const ArrayLayout& layout, SeriesInfo& info) {
    const auto number = [&](const char* name) {
        for (const StatedAttributes& object : objects)
            if (auto found = object.numbers(name); found.size() == 1)
                return found;
        return std::vector<double>();
    };
    const std::vector<double> dx = number("DX"), dy = number("DY");
    for (const std::size_t space : layout.space)
        if (!array.axes[space].at.empty() || array.axes[space].regular)
            return;
    if (dx.size() == 1 && dy.size() == 1)
        info.notes.push_back(fmt::format("attributes say DX {:g} and DY {:g}: --spacing {:g} {:g} "
                                         "DZ, with DZ as the distance between levels, takes them",
                                         dx.front(), dy.front(), dx.front(), dy.front()));
}

class NetcdfVolume final : public DecodedFile {
  public:
    NetcdfVolume(const fs::path& path, const ReadOptions& options)
        : file_(path, options.crop.has_value()),
          variables_(
              (expect_no_other_format(file_), choose_variables(file_, options, array_name_))),
          variable_(variables_.front()) {
        const std::string& name = file_.name();
        const std::string where = fmt::format("{}: {}", name, variable_.name);
        const std::vector<StatedAttributes> objects = objects_of(file_, variable_);
        StatedArray array = stated(file_, variable_, true);
        array.name = array_name_;
        layout_ = lay_out(array, objects, options, info_.notes);
        member_ = member_of(array, layout_, options);
        steps_ = layout_.time ? array.axes[*layout_.time].length : 1;
        if (steps_ == 0)
            throw Error("{}: {} has 0 steps, expected at least 1", name, text(variable_));
        size_grid(array);
        file_.expect_room(variable_);
        if (layout_.time)
            file_.keep_chunks(variable_, *layout_.time);
        choose(options, objects, where);
        info_.scaling = scaling_by(objects.front(), where);
        info_.value_unit = value_unit_by(objects.front());
        place_axes(array, layout_, options, info_);
        if (!options.spacing)
            offer_cell_sizes(objects, array, layout_, info_);
        if (variables_.size() > 1) {
            expect_alike();
            steps_ = variables_.size();
        }
        place_times(array, options);
        if (steps_ > 1 && !info_.times.empty()) // the last ones may have none
            steps_ = info_.times.size();
        const auto long_dimensions = [&](const std::string& of) -> std::size_t {
            for (const NetcdfVariable& other : file_.variables())
                if (other.type && other.name.substr(other.name.rfind('/') + 1) == of)
                    return static_cast<std::size_t>(
                        std::ranges::count_if(other.dimensions, [](const NetcdfDimension& each) {
                            return each.length > 1;
                        }));
            return 0;
        };
        if (auto note = note_on_attributes(objects.front(),
                                           curved_coordinates(objects.front(), long_dimensions)))
            info_.notes.push_back(std::move(*note));
        part_ = crop_description(info_, options, name);
    }

    std::size_t steps() const override { return steps_; }

    /// Whole chunks, since HDF5 decompresses a whole chunk for each request of a part of it.
    std::uint32_t slices_at_once() const override {
        const std::uint32_t all = info_.grid.vertices[2], worth = slices_worth_asking(info_);
        const std::vector<std::size_t> chunk = file_.chunk_of(variable_);
        if (chunk.empty())
            return worth;
        const auto along = std::clamp<std::uint64_t>(chunk[layout_.space[2]], 1, all);
        const std::uint64_t whole = (worth + along - 1) / along * along;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(whole, all));
    }

    std::uint64_t decoded_bytes() const override {
        double chunk = 1; // values of a chunk, which may span several steps
        for (const std::size_t length : file_.chunk_of(variable_))
            chunk *= static_cast<double>(length);
        const double values = std::max(chunk, static_cast<double>(info_.grid.vertex_count()));
        constexpr double kMost = 1e15;
        return static_cast<std::uint64_t>(std::min(values, kMost)) * size_of(*variable_.type);
    }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        std::vector<std::size_t> start(variable_.dimensions.size()),
            count(variable_.dimensions.size(), 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t dimension = layout_.space[axis];
            start[dimension] = part_ ? part_->first[axis] : 0;
            count[dimension] = part_ ? part_->count[axis] : variable_.dimensions[dimension].length;
        }
        start[layout_.space[2]] += slices.first;
        count[layout_.space[2]] = slices.count;
        const bool in_groups = variables_.size() > 1;
        if (layout_.time)
            start[*layout_.time] = in_groups ? 0 : step;
        if (layout_.member)
            start[*layout_.member] = member_;
        Grid slab = info_.grid;
        slab.vertices[2] = slices.count;
        read_stored(chosen_, missing_, slab.vertex_count(), slab, out, file_.name(),
                    [&](std::size_t component, std::span<std::byte> plane) {
                        if (layout_.component)
                            start[*layout_.component] = component;
                        file_.read(in_groups ? variables_[step] : variable_, start, count, plane);
                    });
    }

  private:
    void size_grid(const StatedArray& array) {
        std::array<std::int64_t, 3> sizes{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            sizes[axis] = static_cast<std::int64_t>(std::min<std::uint64_t>(
                array.axes[layout_.space[axis]].length, std::int64_t{1} << 62));
        info_.grid.vertices = checked_vertices(sizes, file_.name());
    }

    void choose(const ReadOptions& options, const std::vector<StatedAttributes>& objects,
                const std::string& where) {
        const auto fill = file_.fill(variable_);
        missing_ = MissingValues(objects.front(), *variable_.type,
                                 fill ? std::vector{*fill} : std::vector<double>{}, where);
        const std::size_t components =
            layout_.component ? variable_.dimensions[*layout_.component].length : 1;
        const StoredArray array{.name = array_name_,
                                .type = variable_.type,
                                .components = static_cast<std::uint32_t>(components),
                                .gaps = missing_.make_gaps(*variable_.type)};
        ReadOptions asked = options;
        asked.array = array_name_;
        chosen_ = choose_scalar(std::span(&array, 1), asked, file_.name());
        ReadOptions any;
        any.any_array = true;
        const Offered all = offered_in(file_, any);
        info_.arrays = choose_scalar(all.arrays, any, file_.name()).offered;
        info_.notes.insert(info_.notes.end(), all.notes.begin(), all.notes.end());
        info_.array = chosen_.label();
        info_.type = chosen_.value_type();
        for (std::string& note : chosen_.notes())
            info_.notes.push_back(std::move(note));
    }

    void place_times(const StatedArray& array, const ReadOptions& options) {
        if (layout_.time && variables_.size() == 1)
            return place_steps(array.axes[*layout_.time], options, info_);
        std::vector<std::string> paths;
        for (const NetcdfVariable& variable : variables_)
            paths.push_back(variable.name);
        place_group_times(
            paths, [&](const std::string& path) { return attributes_of(file_, path); },
            [&](const std::string& group) { return time_in(file_, group); }, options, info_);
    }

    /// @throws Error naming the file: groups that are the steps hold several, or differ
    void expect_alike() const {
        if (steps_ > 1)
            throw Error("{}: each of {} groups holds several steps, choose one with --array {}",
                        file_.name(), variables_.size(), variable_.name);
        for (const NetcdfVariable& variable : variables_)
            if (variable.type != variable_.type ||
                scaling_by(attributes_of(file_, variable), variable.name) != info_.scaling)
                throw Error("{}: {} is not as {}", file_.name(), variable.name, variable_.name);
    }

    NetcdfFile file_;
    std::string array_name_;
    std::vector<NetcdfVariable> variables_; ///< one, or one for each step
    NetcdfVariable variable_;               ///< the first of them
    ArrayLayout layout_;
    std::size_t member_ = 0;
    MissingValues missing_;
    ChosenScalar chosen_;
    std::optional<VolumePart> part_;
    std::size_t steps_ = 1;
};

} // namespace

std::unique_ptr<DecodedFile> decode_netcdf(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<NetcdfVolume>(path, options);
}

} // namespace isochron::index
