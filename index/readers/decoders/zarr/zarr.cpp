// Zarr arrays and OME-Zarr images.
//
// J. Moore and others, "Next-generation file formats (NGFF)", versions 0.4 and 0.5,
// https://ngff.openmicroscopy.org.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/zarr/zarr_array.h"
#include "index/readers/decoders/zarr/zarr_cf.h"
#include "index/readers/decoders/zarr/zarr_groups.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/length_units.h"
#include "index/readers/formats/series/numbered_groups.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A dimension of an array.
struct ZarrAxis {
    std::string name, unit;
    double scale = 1, first = 0;
};

/// Where time, channels and space are among the dimensions.
struct ZarrLayout {
    std::array<std::size_t, 3> space{}; ///< fastest first
    std::optional<std::size_t> time, channel;
};

std::optional<ZarrLayout> layout_by_names(const ZarrArray& array, const std::vector<ZarrAxis>& axes,
                                          const ReadOptions& options, std::string& why) {
    ZarrLayout layout;
    std::vector<std::size_t> left; // slowest first
    for (std::size_t i = 0; i < array.shape().size(); ++i) {
        const std::string name = i < axes.size() ? lower_case(axes[i].name) : "";
        if (array.shape()[i] == 1)
            continue;
        if (!layout.time && (name == "t" || name == "time"))
            layout.time = i;
        else if (!layout.channel && (name == "c" || name == "channel" || name == "band"))
            layout.channel = i;
        else
            left.push_back(i);
    }
    const auto length = [&](std::size_t i) { return array.shape()[i]; };
    constexpr std::uint64_t kMaybeComponents = 4, kMostComponents = 9;
    if (left.size() > 3 && !layout.channel && options.component &&
        length(left.back()) <= kMostComponents) {
        layout.channel = left.back();
        left.pop_back();
    }
    if (left.size() == 4 && !layout.time) {
        if (!options.any_array && !options.extra_axis_is_time && !options.component &&
            (length(left.front()) <= kMaybeComponents || length(left.back()) <= kMaybeComponents)) {
            why = "its first axis may be time (--extra-axis-is-time), its last one components "
                  "(--component 0, 1, ... or magnitude)";
            return std::nullopt;
        }
        layout.time = left.front();
        left.erase(left.begin());
    }
    if (left.size() != 3) {
        why = "expected three axes of more than one vertex besides time and channels";
        return std::nullopt;
    }
    layout.space = {left[2], left[1], left[0]};
    return layout;
}

/// `x.zarr/.zattrs` stands for the folder that it describes.
fs::path zarr_folder_of(const fs::path& given) {
    const std::string file = given.filename();
    const bool describes =
        file == "zarr.json" || file == ".zattrs" || file == ".zarray" || file == ".zgroup";
    return describes ? given.parent_path() : given;
}

class ZarrVolume final : public DecodedFile {
  public:
    ZarrVolume(std::unique_ptr<ZarrStore> store, const ReadOptions& options)
        : store_(std::move(store)), name_(store_->name()) {
        const json attributes = attributes_of_group(*store_, "");
        ReadOptions asked = options;
        const json image = multiscale_of(attributes);
        try {
            open_array(image, asked);
            place(image);
        } catch (const json::exception& error) {
            throw Error(fmt::format("{}: damaged description: {}", name_, error.what()));
        }
        std::string why;
        const auto layout = layout_by_names(*array_, axes_, asked, why);
        if (!layout)
            throw Error(fmt::format("{}: {} ({}): {}", name_, array_name(),
                                    fmt::join(array_->shape(), " x "), why));
        layout_ = *layout;
        if (layout_.time && !steps_.empty())
            throw Error(fmt::format("{}: each of {} groups holds several steps, choose one with "
                                    "--array {}",
                                    name_, steps_.size(), steps_.front()));
        describe(attributes, asked);
        if (image.is_null())
            place_by_coordinates(*store_, *array_, layout_.space, layout_.time, asked, info_);
        if (!steps_.empty())
            time_groups();
        part_ = crop_description(info_, options, name_);
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override {
        if (!steps_.empty())
            return steps_.size();
        if (layout_.time && info_.times.empty())
            return array_->shape()[*layout_.time];
        return layout_.time ? info_.times.size() : 1;
    }
    std::uint32_t slices_at_once() const override {
        const std::uint32_t all = info_.grid.vertices[2], worth = slices_worth_asking(info_);
        constexpr std::uint32_t kOfPlain = 8; // each slab opens its chunks' files once more
        if (array_->plain())
            return std::min(all, kOfPlain * worth);
        if (array_->keeps_whole(layout_.space))
            return std::min(all, worth);
        const auto along = std::clamp<std::uint64_t>(array_->chunk()[layout_.space[2]], 1, all);
        return static_cast<std::uint32_t>(
            std::min<std::uint64_t>((worth + along - 1) / along * along, all));
    }
    std::uint64_t decoded_bytes() const override {
        std::uint64_t values = 1; // checked to be no more than memory takes
        for (const std::uint64_t length : array_->chunk())
            values *= length;
        constexpr std::uint64_t kKept = 512 << 20;
        return values * size_of(*array_->type()) + kKept;
    }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        Grid slab = info_.grid;
        slab.vertices[2] = slices.count;
        if (!missing_.empty())
            return read_with_gaps(step, slices, slab, out);
        convert_planes(chosen_, slab, out, name_,
                       [&](std::size_t component, std::span<std::byte> plane) {
                           load(step, slices, first_channel_ + component, plane);
                       });
    }

  private:
    /// Reads a slab of one component.
    void read_with_gaps(std::size_t step, Slices slices, const Grid& slab,
                        std::span<std::byte> out) {
        ChosenScalar alone = chosen_;
        alone.array.components = 1;
        alone.component = 0;
        std::vector<std::byte> values(slab.vertex_count() * size_of(*array_->type()));
        load(step, slices, first_channel_ + chosen_.component, values);
        const std::vector<std::uint8_t> gaps = take_out(missing_, *array_->type(), values);
        convert(alone, values, slab, out, name_,
                alone.array.gaps ? std::span(gaps) : std::span<const std::uint8_t>());
    }

    std::string array_name() const {
        return !steps_.empty()          ? name_of_steps_
               : array_->path().empty() ? "values"
                                        : array_->path();
    }

    void open_array(const json& image, ReadOptions& options) {
        if (auto root = ZarrArray::open(*store_, "")) {
            array_ = std::move(*root);
            options.array.reset();
            return;
        }
        std::string wanted = options.array.value_or("");
        wanted.erase(0, wanted.find_first_not_of('/') == std::string::npos
                            ? 0
                            : wanted.find_first_not_of('/'));
        if (auto named = wanted.empty() ? std::nullopt : ZarrArray::open(*store_, wanted)) {
            array_ = std::move(*named);
            options.array.reset();
            return;
        }
        if (!image.is_null()) { // the finest level; a name means a channel
            const std::string path = image.at("datasets").at(0).at("path");
            auto finest = ZarrArray::open(*store_, path);
            if (!finest)
                throw Error(fmt::format("{}: its image has no array {}", name_, path));
            array_ = std::move(*finest);
            return;
        }
        std::vector<std::string> paths;
        find_arrays(*store_, "", 0, paths);
        std::vector<GroupedPath> volumes;
        std::vector<std::optional<StoredType>> types;
        for (const std::string& path : paths) {
            const auto array = ZarrArray::open(*store_, path);
            const auto dimensions =
                array ? std::ranges::count_if(array->shape(), [](auto n) { return n != 1; }) : 0;
            if (dimensions < 3)
                continue;
            types.push_back(array->type());
            volumes.push_back({path, fmt::format("{}", fmt::join(array->shape(), " x "))});
        }
        if (volumes.empty())
            throw Error(fmt::format("{}: holds no array of three dimensions{}{}", name_,
                                    paths.empty() ? "" : ", only ", fmt::join(paths, ", ")));
        const auto has_time = [&](const std::string& group) { return time_of(group).has_value(); };
        std::vector<GroupedArray> arrays =
            wanted.find('*') == wanted.npos ? grouped_arrays(volumes, has_time)
                                            : std::vector{matching_arrays(volumes, wanted, name_)};
        std::vector<StoredArray> offered;
        for (const GroupedArray& each : arrays) {
            if (!each.or_else.empty() && !options.any_array)
                throw Error(fmt::format("{}: {}", name_, which_steps(each)));
            if (!each.or_else.empty() && info_.notes.empty())
                info_.notes.push_back(which_steps(each));
            const std::size_t first = each.steps.front();
            offered.push_back(
                {.name = each.name,
                 .type = types[first],
                 .shape =
                     volumes[first].kind +
                     (each.steps.size() > 1 ? fmt::format(", {} steps", each.steps.size()) : "")});
        }
        ReadOptions which = options;
        which.component.reset();
        if (wanted.find('*') != wanted.npos)
            which.array.reset(); // there is one
        const ChosenScalar chosen = choose_scalar(offered, which, name_);
        info_.arrays = chosen.offered;
        const auto found = std::ranges::find(arrays, chosen.array.name, &GroupedArray::name);
        array_ = ZarrArray::open(*store_, volumes[found->steps.front()].path);
        if (found->steps.size() > 1) {
            name_of_steps_ = found->name;
            for (const std::size_t step : found->steps)
                steps_.push_back(volumes[step].path);
        }
        options.array.reset();
    }

    /// The time that a group states.
    std::optional<double> time_of(const std::string& group) const {
        const json attributes = attributes_of_group(*store_, group);
        for (const char* name : {"time", "Time", "TIME", "t"})
            if (const auto found = attributes.find(name);
                found != attributes.end() && found->is_number())
                return found->get<double>();
        return std::nullopt;
    }

    /// Times of steps that have a group each: as the groups state them, or their names.
    void time_groups() {
        if (const auto named = times_of_groups(steps_)) {
            info_.times = named->times;
            info_.time_unit = named->unit;
        }
        std::vector<double> times;
        for (const std::string& path : steps_)
            for (std::size_t end = path.rfind('/'); end != path.npos && end > 0;
                 end = path.rfind('/', end - 1))
                if (const auto time = time_of(path.substr(0, end))) {
                    times.push_back(*time);
                    break;
                }
        if (times.size() == steps_.size() && times.front() != times.back()) {
            info_.times = std::move(times);
            info_.time_unit.clear();
        }
    }

    /// Names, scales and units of the dimensions.
    void place(const json& image) {
        axes_.resize(array_->shape().size());
        for (std::size_t i = 0; i < std::min(axes_.size(), array_->names().size()); ++i)
            axes_[i].name = array_->names()[i];
        if (image.is_null())
            return;
        if (const auto axes = image.find("axes"); axes != image.end())
            for (std::size_t i = 0; i < std::min(axes_.size(), axes->size()); ++i) {
                const json& axis = axes->at(i);
                axes_[i].name =
                    axis.is_string() ? axis.get<std::string>() : axis.at("name").get<std::string>();
                if (axis.is_object())
                    axes_[i].unit = tidy_unit_of_ome(axis.value("unit", ""));
            }
        for (const json* object : {&image.at("datasets").at(0), &image})
            if (const auto all = object->find("coordinateTransformations"); all != object->end())
                for (const json& transformation : *all)
                    transform(transformation);
    }

    void transform(const json& transformation) {
        for (const bool scales : {true, false}) {
            const auto found = transformation.find(scales ? "scale" : "translation");
            if (found == transformation.end() || found->size() != axes_.size())
                continue;
            for (std::size_t i = 0; i < axes_.size(); ++i) {
                const double number = found->at(i);
                axes_[i].first = scales ? axes_[i].first * number : axes_[i].first + number;
                axes_[i].scale *= scales ? number : 1;
            }
        }
    }

    void describe(const json& attributes, const ReadOptions& options) {
        const std::uint64_t channels = layout_.channel ? array_->shape()[*layout_.channel] : 1;
        std::vector<StoredArray> offered;
        const bool by_components = options.component.has_value();
        const std::vector<std::string> labels = labels_in(attributes, channels);
        if (by_components || channels == 1)
            offered.push_back({.name = array_name(),
                               .type = array_->type(),
                               .components = static_cast<std::uint32_t>(channels)});
        else
            for (const std::string& label : labels)
                offered.push_back({.name = label, .type = array_->type()});
        if (!array_->type())
            throw Error(
                fmt::format("{}: {} is of type {}, expected integers of up to 64 bits, bool, "
                            "float16, float32 or float64",
                            name_, array_name(), array_->type_name()));
        if (options.component != "magnitude")
            missing_ = missing_in(*array_);
        const bool whole = *array_->type() != StoredType::f32 && *array_->type() != StoredType::f64;
        for (StoredArray& each : offered)
            each.gaps = !missing_.empty() && whole;
        chosen_ = choose_scalar(offered, options, name_);
        info_.scaling = scaling_of(*array_, fmt::format("{}: {}", name_, array_name()));
        if (info_.arrays.empty())
            info_.arrays = chosen_.offered;
        if (!by_components) // each channel is offered as an array
            first_channel_ = static_cast<std::size_t>(
                std::ranges::find(offered, chosen_.array.name, &StoredArray::name) -
                offered.begin());
        std::array<std::int64_t, 3> sizes{};
        glm::dmat3 spacing(0.0);
        const OneLengthUnit one_unit =
            one_length_unit({axes_[layout_.space[0]].unit, axes_[layout_.space[1]].unit,
                             axes_[layout_.space[2]].unit});
        for (std::size_t a = 0; a < 3; ++a) {
            const ZarrAxis& axis = axes_[layout_.space[a]];
            sizes[a] = static_cast<std::int64_t>(
                std::min(array_->shape()[layout_.space[a]], std::uint64_t{1} << 62));
            const double factor = one_unit.factor[static_cast<int>(a)];
            spacing[static_cast<int>(a)][static_cast<int>(a)] = axis.scale * factor;
            info_.grid.origin[static_cast<int>(a)] = axis.first * factor;
        }
        info_.notes.insert(info_.notes.end(), one_unit.notes.begin(), one_unit.notes.end());
        info_.grid.vertices = checked_vertices(sizes, name_);
        set_axes(info_.grid, spacing, name_);
        info_.length_unit = one_unit.unit;
        info_.array = chosen_.label();
        info_.type = chosen_.value_type();
        for (std::string& note : chosen_.notes())
            info_.notes.push_back(std::move(note));
        if (array_->half())
            info_.notes.push_back("float16 values converted to f32");
        expect_few_steps(steps(), name_);
        if (!layout_.time)
            return;
        const ZarrAxis& time = axes_[*layout_.time];
        if (time.name.empty())
            info_.notes.push_back(fmt::format("the first axis of {} ({}) is taken for time",
                                              array_name(), fmt::join(array_->shape(), " x ")));
        if (time.scale == 1 && time.unit.empty())
            return;
        info_.time_unit = time.unit;
        const std::size_t count = steps();
        for (std::size_t i = 0; i < count; ++i)
            info_.times.push_back(time.first + static_cast<double>(i) * time.scale);
    }

    std::vector<std::string> labels_in(const json& attributes, std::uint64_t channels) const {
        constexpr std::uint64_t kMost = 1000;
        if (channels > kMost)
            throw Error(
                fmt::format("{}: {} channels, expected at most {}", name_, channels, kMost));
        std::vector<std::string> labels;
        const json ome = attributes.value("ome", attributes);
        const json list = ome.is_object() && ome.contains("omero")
                              ? ome["omero"].value("channels", json::array())
                              : json::array();
        for (std::size_t i = 0; i < channels; ++i) {
            std::string label =
                i < list.size() && list[i].is_object() ? list[i].value("label", "") : std::string();
            if (label.empty() || std::ranges::find(labels, label) != labels.end())
                label = fmt::format("channel {}", i);
            labels.push_back(std::move(label));
        }
        return labels;
    }

    void load(std::size_t step, Slices slices, std::size_t channel, std::span<std::byte> out) {
        std::vector<std::uint64_t> start(array_->shape().size()), count(array_->shape().size(), 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t dimension = layout_.space[axis];
            start[dimension] = part_ ? part_->first[axis] : 0;
            count[dimension] = part_ ? part_->count[axis] : array_->shape()[dimension];
        }
        start[layout_.space[2]] += slices.first;
        count[layout_.space[2]] = slices.count;
        if (!steps_.empty() && step != open_step_)
            open_step(step);
        if (layout_.time)
            start[*layout_.time] = step;
        if (layout_.channel)
            start[*layout_.channel] = channel;
        array_->read(start, count, out);
    }

    void open_step(std::size_t step) {
        auto array = ZarrArray::open(*store_, steps_[step]);
        const std::string name = fmt::format("{}: {}", name_, steps_[step]);
        if (!array || array->shape() != array_->shape() || array->type() != array_->type() ||
            scaling_of(*array, name) != info_.scaling)
            throw Error(fmt::format("{} is not as {}", name, steps_.front()));
        array_ = std::move(*array);
        open_step_ = step;
    }

    std::unique_ptr<ZarrStore> store_;
    std::string name_;
    std::optional<ZarrArray> array_; ///< of steps in groups the one of the open step
    std::vector<std::string> steps_; ///< arrays of the steps; empty: all are in one
    std::string name_of_steps_;      ///< their path, with `*` for what differs
    std::size_t open_step_ = 0;
    std::vector<ZarrAxis> axes_;
    ZarrLayout layout_;
    ChosenScalar chosen_;
    SeriesInfo info_;
    std::optional<VolumePart> part_; ///< if not all is wanted
    std::vector<double> missing_;    ///< values that stand for missing ones
    std::size_t first_channel_ = 0;  ///< number of the chosen array's first component
};

} // namespace

std::unique_ptr<DecodedFile> decode_zarr(const fs::path& path, const ReadOptions& options) {
    return decode_zarr(open_zarr_store(zarr_folder_of(path)), options);
}

std::unique_ptr<DecodedFile> decode_zarr(std::unique_ptr<ZarrStore> store,
                                         const ReadOptions& options) {
    return std::make_unique<ZarrVolume>(std::move(store), options);
}

} // namespace isochron::index
