// Zarr arrays and OME-Zarr images.
//
// J. Moore and others, "Next-generation file formats (NGFF)", versions 0.4 and 0.5,
// https://ngff.openmicroscopy.org.
#include "index/error.h"
#include "index/json_mistake.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/zarr/zarr_array.h"
#include "index/readers/decoders/zarr/zarr_groups.h"
#include "index/readers/decoders/zarr/zarr_stated.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/series/numbered_groups.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stated/group_times.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_values.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
        ReadOptions asked = options;
        ZarrLevel level;
        try {
            open_array(multiscale_of(attributes_of_group(*store_, "")), asked);
            level = level_of(*store_, array_->path());
            stated_ = {.file = name_,
                       .name = array_name(),
                       .axes = level.image.is_null()
                                   ? axes_of(*store_, *array_)
                                   : axes_of(level.image, level.dataset, *array_)};
        } catch (const json::exception& error) {
            throw Error("{}: damaged description: {}", name_, json_mistake(error));
        }
        const std::vector<StatedAttributes> objects = objects_of(*store_, *array_);
        layout_ = lay_out(stated_, objects, asked, info_.notes);
        if (layout_.time && !steps_.empty())
            throw Error("{}: each of {} groups holds several steps, choose one with --array {}",
                        name_, steps_.size(), steps_.front());
        member_ = member_of(stated_, layout_, asked);
        describe(level.attributes, objects.front(), asked);
        part_ = crop_description(info_, options, name_);
    }

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
        read_stored(chosen_, missing_, slab.vertex_count(), slab, out, name_,
                    [&](std::size_t component, std::span<std::byte> plane) {
                        load(step, slices, first_channel_ + component, plane);
                    });
    }

  private:
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
                throw Error("{}: its image has no array {}", name_, path);
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
            throw Error("{}: holds no array of three dimensions{}{}", name_,
                        paths.empty() ? "" : ", only ", fmt::join(paths, ", "));
        const auto has_time = [&](const std::string& group) {
            return states_time(of_group(group));
        };
        std::vector<GroupedArray> arrays =
            wanted.find('*') == wanted.npos ? grouped_arrays(volumes, has_time)
                                            : std::vector{matching_arrays(volumes, wanted, name_)};
        std::vector<StoredArray> offered;
        for (const GroupedArray& each : arrays) {
            if (!each.or_else.empty() && !options.any_array)
                throw Error("{}: {}", name_, which_steps(each));
            if (!each.or_else.empty() && info_.notes.empty())
                info_.notes.push_back(which_steps(each));
            const std::size_t first = each.steps.front();
            offered.push_back(
                {.name = each.name,
                 .type = types[first],
                 .shape =
                     volumes[first].kind +
                     (each.steps.size() > 1 ? fmt::format(", {} steps", each.steps.size()) : ""),
                 .by_pattern = true});
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

    StatedAttributes of_group(const std::string& group) const {
        return attributes_of(attributes_of_group(*store_, group));
    }

    void describe(const json& attributes, const StatedAttributes& of_array,
                  const ReadOptions& options) {
        const std::uint64_t channels = layout_.component ? array_->shape()[*layout_.component] : 1;
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
            throw Error("{}: {} is of type {}, expected integers of up to 64 bits, bool, float16, "
                        "float32 or float64",
                        name_, array_name(), array_->type_name());
        const std::string where = fmt::format("{}: {}", name_, array_name());
        missing_ = MissingValues(of_array, *array_->type(), fills_of(*array_), where);
        for (StoredArray& each : offered)
            each.gaps = missing_.make_gaps(*array_->type());
        chosen_ = choose_scalar(offered, options, name_);
        array_->expect_known_codecs();
        info_.scaling = scaling_by(of_array, where);
        info_.value_unit = value_unit_by(of_array);
        if (info_.arrays.empty())
            info_.arrays = chosen_.offered;
        if (!by_components) // each channel is offered as an array
            first_channel_ = static_cast<std::size_t>(
                std::ranges::find(offered, chosen_.array.name, &StoredArray::name) -
                offered.begin());
        std::array<std::int64_t, 3> sizes{};
        for (std::size_t a = 0; a < 3; ++a)
            sizes[a] = static_cast<std::int64_t>(
                std::min(array_->shape()[layout_.space[a]], std::uint64_t{1} << 62));
        info_.grid.vertices = checked_vertices(sizes, name_);
        place_axes(stated_, layout_, options, info_);
        info_.array = chosen_.label();
        info_.type = chosen_.value_type();
        for (std::string& note : chosen_.notes())
            info_.notes.push_back(std::move(note));
        if (array_->half())
            info_.notes.push_back("float16 values converted to f32");
        expect_few_steps(steps(), name_);
        const auto long_dimensions = [&](const std::string& of) {
            return long_dimensions_of(*store_, *array_, of);
        };
        if (auto note = note_on_attributes(of_array, curved_coordinates(of_array, long_dimensions)))
            info_.notes.push_back(std::move(*note));
        if (layout_.time)
            place_steps(stated_.axes[*layout_.time], options, info_);
        else
            place_group_times(
                steps_.empty() ? std::vector{array_->path()} : steps_,
                [&](const std::string& path) { return of_group(path); },
                [&](const std::string& group) { return time_in(*store_, group); }, options, info_);
        if (!steps_.empty() && !info_.times.empty()) // the last ones may have none
            steps_.resize(info_.times.size());
    }

    std::vector<std::string> labels_in(const json& attributes, std::uint64_t channels) const {
        constexpr std::uint64_t kMost = 1000;
        if (channels > kMost)
            throw Error("{}: {} channels, expected at most {}", name_, channels, kMost);
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
        if (layout_.member)
            start[*layout_.member] = member_;
        if (layout_.component)
            start[*layout_.component] = channel;
        array_->read(start, count, out);
    }

    void open_step(std::size_t step) {
        auto array = ZarrArray::open(*store_, steps_[step]);
        const std::string name = fmt::format("{}: {}", name_, steps_[step]);
        if (!array || array->shape() != array_->shape() || array->type() != array_->type() ||
            scaling_by(attributes_of(array->attributes()), name) != info_.scaling)
            throw Error("{} is not as {}", name, steps_.front());
        array_ = std::move(*array);
        open_step_ = step;
    }

    std::unique_ptr<ZarrStore> store_;
    std::string name_;
    std::optional<ZarrArray> array_; ///< where steps have groups, the array of the open step
    std::vector<std::string> steps_; ///< arrays of the steps; empty: all are in one
    std::string name_of_steps_;      ///< their path, with `*` for what differs
    std::size_t open_step_ = 0;
    StatedArray stated_;
    ArrayLayout layout_;
    std::size_t member_ = 0;
    ChosenScalar chosen_;
    std::optional<VolumePart> part_; ///< if not all is wanted
    MissingValues missing_;
    std::size_t first_channel_ = 0; ///< number of the chosen array's first component
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
