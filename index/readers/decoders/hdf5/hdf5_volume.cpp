// Reads steps of HDF5 datasets, slab by slab.
#include "index/readers/decoders/hdf5/hdf5_volume.h"

#include "index/readers/decoders/hdf5/hdf5_stated.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_values.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

class Hdf5Decoder final : public DecodedFile {
  public:
    Hdf5Decoder(std::unique_ptr<Hdf5File> file, const std::string& name, Hdf5Volume volume,
                const ReadOptions& options)
        : file_(std::move(file)), volume_(std::move(volume)) {
        const StatedAttributes attributes = attributes_of(*file_, first().path);
        const std::string where = fmt::format("{}: {}", file_->name(), first().path);
        missing_ = MissingValues(attributes, *first().type, {}, where);
        const StoredArray array{.name = name,
                                .type = first().type,
                                .components = components(),
                                .on_cells = volume_.on_cells,
                                .gaps = missing_.make_gaps(*first().type)};
        ReadOptions asked = options;
        asked.array.reset(); // already chosen
        chosen_ = choose_scalar(std::span(&array, 1), asked, file_->name());
        info_ = std::move(volume_.info);
        info_.array = chosen_.label();
        info_.type = chosen_.value_type();
        info_.scaling = scaling_by(attributes, where);
        for (std::string& note : chosen_.notes())
            info_.notes.push_back(std::move(note));
        note_unread();
        whole_ = info_.grid;
        part_ = crop_description(info_, options, file_->name());
        if (info_.value_unit.empty())
            info_.value_unit = value_unit_by(attributes);
        open(0);
    }

    std::size_t steps() const override {
        if (volume_.datasets.size() > 1)
            return volume_.datasets.size();
        if (!volume_.places.empty())
            return volume_.places.size();
        if (volume_.layout.time && !info().times.empty())
            return info().times.size();
        return volume_.layout.time ? first().dimensions[*volume_.layout.time] : 1;
    }

    /// Whole chunks, since HDF5 decompresses a whole chunk for each request of a part of it. Where
    /// chunks hold whole planes and need no decompressing: as many planes as fit the processor's
    /// cache.
    std::uint32_t slices_at_once() const override {
        const std::uint32_t all = info().grid.vertices[2], worth = slices_worth_asking(info());
        if (volume_.on_cells)
            return all; // also of a part
        const auto whole_along = [&](std::size_t a) {
            const std::size_t dimension = volume_.layout.space[a];
            return values_->chunk()[dimension] >= first().dimensions[dimension];
        };
        if (values_->chunk().empty() || (values_->in_parts() && whole_along(0) && whole_along(1)))
            return worth;
        const auto along =
            std::clamp<std::uint64_t>(values_->chunk()[volume_.layout.space[2]], 1, all);
        const std::uint64_t whole = (worth + along - 1) / along * along;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(whole, all));
    }

    std::uint64_t decoded_bytes() const override {
        double chunk = 1;
        for (const std::uint64_t length : values_->chunk())
            chunk *= static_cast<double>(length);
        const double values = std::max(chunk, static_cast<double>(info().grid.vertex_count()));
        constexpr double kMost = 1e15;
        return static_cast<std::uint64_t>(std::min(values * components(), kMost)) *
               size_of(*first().type);
    }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        if (!part_ || crops())
            return read_slab(step, slices, info().grid, out);
        std::vector<std::byte> all(whole_.vertex_count() * size_of(info().type));
        read_slab(step, {0, whole_.vertices[2]}, whole_, all);
        take_part(all, whole_, *part_, size_of(info().type), out);
    }

  private:
    void read_slab(std::size_t step, Slices slices, const Grid& grid, std::span<std::byte> out) {
        open(volume_.datasets.size() > 1 ? step : 0);
        Grid slab = grid;
        slab.vertices[2] = slices.count;
        const bool whole = volume_.on_cells; // then the slab is the whole volume
        const std::uint32_t layers = whole ? slab.vertices[2] - 1 : slices.count;
        read_stored(chosen_, missing_, values_in(layers), slab, out, file_->name(),
                    [&](std::size_t component, std::span<std::byte> plane) {
                        load(step, slices.first, layers, component, plane);
                    });
    }

    /// What openPMD and CF state of a mesh that changes neither values nor places here.
    void note_unread() {
        const std::string& path = first().path;
        const std::string group = path.substr(0, std::max<std::size_t>(path.rfind('/'), 1));
        std::vector<std::string> unread;
        for (const std::string& object : {path, group}) {
            if (const std::string geometry = file_->text(object, "geometry");
                !geometry.empty() && geometry != "cartesian")
                unread.push_back(fmt::format("geometry {} (shown as cartesian)", geometry));
            if (const std::string text = file_->text(object, "geometryParameters"); !text.empty())
                unread.push_back(fmt::format("geometryParameters {}", text));
            const auto offset = file_->numbers(object, "timeOffset");
            if (std::ranges::any_of(offset, [](double number) { return number != 0; }))
                unread.emplace_back("timeOffset");
        }
        const StatedAttributes attributes = attributes_of(*file_, path);
        for (std::string& curved : curved_coordinates(attributes, [&](const std::string& name) {
                 const auto beside = file_->dataset(group + "/" + name);
                 return !beside ? std::size_t{0}
                                : static_cast<std::size_t>(std::ranges::count_if(
                                      beside->dimensions, [](std::uint64_t n) { return n > 1; }));
             }))
            unread.push_back(std::move(curved));
        if (auto note = note_on_attributes(attributes, unread))
            info_.notes.push_back(std::move(*note));
    }

    const Hdf5Dataset& first() const { return volume_.datasets.front(); }

    /// Whether a part of the dataset is read; of values of cells all are, for their means.
    bool crops() const { return part_ && !volume_.on_cells; }

    std::uint32_t components() const {
        const auto& at = volume_.layout.component;
        return at ? static_cast<std::uint32_t>(first().dimensions[*at]) : 1;
    }

    std::size_t values_in(std::uint32_t layers) const {
        const auto& space = volume_.layout.space;
        if (crops())
            return std::size_t{part_->count[0]} * part_->count[1] * layers;
        return first().dimensions[space[0]] * first().dimensions[space[1]] * layers;
    }

    void open(std::size_t number) {
        if (values_ && number == open_)
            return;
        values_.reset();
        values_.emplace(*file_, volume_.datasets[number], volume_.layout.time);
        open_ = number;
    }

    void load(std::size_t step, std::uint32_t first_layer, std::uint32_t layers,
              std::size_t component, std::span<std::byte> out) const {
        const ArrayLayout& layout = volume_.layout;
        std::vector<std::uint64_t> start(first().dimensions.size()),
            count(first().dimensions.size(), 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t dimension = layout.space[axis];
            start[dimension] = crops() ? part_->first[axis] : 0;
            count[dimension] = crops() ? part_->count[axis] : first().dimensions[dimension];
        }
        start[layout.space[2]] += first_layer;
        count[layout.space[2]] = layers;
        if (layout.time)
            start[*layout.time] = volume_.places.empty() ? step : volume_.places[step];
        if (layout.member)
            start[*layout.member] = volume_.member;
        if (layout.component)
            start[*layout.component] = component;
        values_->read(start, count, out);
    }

    std::unique_ptr<Hdf5File> file_;
    Hdf5Volume volume_;
    MissingValues missing_;
    std::optional<VolumePart> part_; ///< if not all is wanted
    Grid whole_;
    ChosenScalar chosen_;
    std::optional<Hdf5Values> values_;
    std::size_t open_ = 0;
};

} // namespace

void size_grid(const Hdf5File& file, Hdf5Volume& volume) {
    std::array<std::int64_t, 3> sizes{};
    for (std::size_t a = 0; a < 3; ++a)
        sizes[a] = static_cast<std::int64_t>(
                       std::min(volume.datasets.front().dimensions[volume.layout.space[a]],
                                std::uint64_t{1} << 62)) +
                   (volume.on_cells ? 1 : 0);
    volume.info.grid.vertices = checked_vertices(sizes, file.name());
}

std::unique_ptr<DecodedFile> open_volume(std::unique_ptr<Hdf5File> file, const std::string& name,
                                         Hdf5Volume volume, const ReadOptions& options) {
    return std::make_unique<Hdf5Decoder>(std::move(file), name, std::move(volume), options);
}

} // namespace isochron::index
