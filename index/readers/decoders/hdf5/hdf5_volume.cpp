// Reads steps of HDF5 datasets, slab by slab.
#include "index/readers/decoders/hdf5/hdf5_volume.h"

#include "index/error.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

Scaling scaling_in(const Hdf5File& file, const std::string& path) {
    const auto number = [&](std::initializer_list<const char*> names, double otherwise) {
        for (const char* name : names)
            if (const auto found = file.numbers(path, name); found.size() == 1)
                return found.front();
        return otherwise;
    };
    const Scaling scaling{number({"scale_factor", "unitSI"}, 1), number({"add_offset"}, 0)};
    if (scaling.slope == 0 || !std::isfinite(scaling.slope) || !std::isfinite(scaling.intercept))
        throw Error(fmt::format("{}: {}: factor {} and offset {}, expected finite numbers and a "
                                "factor that is not 0",
                                file.name(), path, scaling.slope, scaling.intercept));
    return scaling;
}

std::vector<double> missing_in(const Hdf5File& file, const std::string& path) {
    std::vector<double> missing;
    for (const char* name : {"_FillValue", "missing_value"})
        for (const double value : file.numbers(path, name))
            if (!std::isnan(value))
                missing.push_back(value);
    return missing;
}

/// Rounds to f32: 1e35 in f64 differs from 1e35 in f32.
double as_float(double value) {
    return static_cast<double>(static_cast<float>(value));
}

class Hdf5Decoder final : public DecodedFile {
  public:
    Hdf5Decoder(std::unique_ptr<Hdf5File> file, const std::string& name, Hdf5Volume volume,
                const ReadOptions& options)
        : file_(std::move(file)), volume_(std::move(volume)),
          missing_(missing_in(*file_, first().path)) {
        const StoredArray array{.name = name,
                                .type = first().type,
                                .components = components(),
                                .on_cells = volume_.on_cells,
                                .gaps = !missing_.empty() && first().type != StoredType::f32 &&
                                        first().type != StoredType::f64};
        ReadOptions asked = options;
        asked.array.reset(); // already chosen
        chosen_ = choose_scalar(std::span(&array, 1), asked, file_->name());
        SeriesInfo& info = volume_.info;
        info.array = chosen_.label();
        info.type = chosen_.value_type();
        info.scaling = scaling_in(*file_, first().path);
        for (std::string& note : chosen_.notes())
            info.notes.push_back(std::move(note));
        note_unread();
        whole_ = info.grid;
        part_ = crop_description(info, options, file_->name());
        for (const char* unit : {"units", "unit", "Units", "UNITS"})
            if (info.value_unit.empty())
                info.value_unit = file_->text(first().path, unit);
        if (info.value_unit == "1")
            info.value_unit.clear();
        open(0);
    }

    const SeriesInfo& info() const override { return volume_.info; }
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
        if (chosen_.component != ChosenScalar::kMagnitude) {
            ChosenScalar alone = chosen_;
            alone.array.components = 1;
            alone.component = 0;
            return take(step, slices.first, layers, chosen_.component, alone, slab, out);
        }
        // Components may be separate planes: joins them to tuples.
        const std::size_t size = size_of(*first().type), count = chosen_.array.components;
        std::vector<std::byte> tuples(values_in(layers) * count * size),
            plane(values_in(layers) * size);
        for (std::uint32_t c = 0; c < count; ++c) {
            load(step, slices.first, layers, c, plane);
            for (std::size_t i = 0; i * size < plane.size(); ++i)
                std::memcpy(&tuples[(i * count + c) * size], &plane[i * size], size);
        }
        convert(chosen_, tuples, slab, out, file_->name());
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
            for (const char* name : {"geometryParameters", "grid_mapping", "cell_methods"})
                if (const std::string text = file_->text(object, name); !text.empty())
                    unread.push_back(fmt::format("{} {}", name, text));
            for (const char* name : {"timeOffset", "valid_min", "valid_max", "valid_range"})
                if (const auto numbers = file_->numbers(object, name);
                    std::ranges::any_of(numbers, [](double number) { return number != 0; }))
                    unread.emplace_back(name);
        }
        if (auto note = note_on_unread(unread))
            volume_.info.notes.push_back(std::move(*note));
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
              std::uint32_t component, std::span<std::byte> out) const {
        const Hdf5Layout& layout = volume_.layout;
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
        if (layout.component)
            start[*layout.component] = component;
        values_->read(start, count, out);
    }

    void take(std::size_t step, std::uint32_t first_layer, std::uint32_t layers,
              std::uint32_t component, const ChosenScalar& alone, const Grid& slab,
              std::span<std::byte> out) const {
        const StoredType stored = *first().type;
        const bool converts = volume_.on_cells || stored_type_of(chosen_.value_type()) != stored;
        std::vector<std::byte> read(converts ? values_in(layers) * size_of(stored) : 0);
        const std::span<std::byte> to = converts ? std::span(read) : out;
        load(step, first_layer, layers, component, to);
        std::vector<std::uint8_t> gaps;
        if (!missing_.empty())
            visit_stored_type(stored, [&]<class T>(std::type_identity<T>) {
                const std::span<T> values(reinterpret_cast<T*>(to.data()), to.size() / sizeof(T));
                if (converts)
                    gaps.resize(values.size());
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const auto is = [value = static_cast<double>(values[i])](double missing) {
                        return value == missing ||
                               (std::is_same_v<T, float> && value == as_float(missing));
                    };
                    if (std::ranges::none_of(missing_, is))
                        continue;
                    if (converts)
                        gaps[i] = 1;
                    if constexpr (std::is_floating_point_v<T>)
                        values[i] = std::numeric_limits<T>::quiet_NaN();
                    else
                        values[i] = 0; // since the number in a gap may have no exact f64
                }
            });
        if (converts)
            convert(alone, read, slab, out, file_->name(), gaps);
    }

    std::unique_ptr<Hdf5File> file_;
    Hdf5Volume volume_;
    std::vector<double> missing_;
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
