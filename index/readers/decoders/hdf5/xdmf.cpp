// XDMF: the values of the grids that a document describes.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/hdf5/hdf5_values.h"
#include "index/readers/decoders/hdf5/xdmf_document.h"
#include "index/readers/decoders/hdf5/xdmf_paths.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

std::uint64_t product(const std::vector<std::uint64_t>& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{1}, std::multiplies<>());
}

class XdmfFile final : public DecodedFile {
  public:
    XdmfFile(const fs::path& path, const ReadOptions& options)
        : name_(path.string()), steps_(read_xdmf(path)) {
        expect_few_steps(steps_.size(), name_);
        const XdmfGrid& first = steps_.front();
        const XdmfPart& part = first.parts.front();
        std::vector<StoredArray> offered;
        for (const XdmfAttribute& attribute : part.attributes)
            if (const auto components = components_of(attribute, part.grid))
                offered.push_back({.name = attribute.name.empty() ? "values" : attribute.name,
                                   .type = type_of(attribute.item),
                                   .components = *components,
                                   .on_cells = attribute.on_cells});
        if (offered.empty())
            throw Error(
                "{}: no attribute of its first grid has values at all its vertices or cells",
                name_);
        chosen_ = choose_scalar(offered, options, name_);
        for (const XdmfGrid& step : steps_) {
            expect_same_grid(step);
            std::vector<XdmfItem>& items = items_.emplace_back();
            for (const XdmfPart& part_of_step : step.parts)
                items.push_back(item_in(part_of_step));
            blocks_ = blocks_ || items.size() > 1;
        }
        if (blocks_ && chosen_.array.on_cells)
            expect_all_cells();
        info_.grid = first.grid;
        chosen_.describe(info_);
        info_.notes = first.notes;
        for (std::string& note : chosen_.notes())
            info_.notes.push_back(std::move(note));
        note_other_type(part);
        leave_out_missing_end();
        StatedTimes times{.name = "Time"};
        std::vector<std::string> dates;
        for (const XdmfGrid& step : steps_) {
            if (step.time)
                times.values.push_back(*step.time);
            dates.push_back(step.date);
        }
        if (are_dates(dates))
            place_dates(dates, times.name, info_, options.dates);
        else if (times.values.size() == steps_.size())
            place_times(std::move(times), info_, options.dates);
        if (!info_.times.empty()) // the last ones may have none
            steps_.resize(info_.times.size());
    }

    std::size_t steps() const override { return steps_.size(); }
    std::uint32_t slices_at_once() const override {
        return chosen_.array.on_cells || blocks_ ? info_.grid.vertices[2]
                                                 : slices_worth_asking(info_);
    }
    std::uint64_t decoded_bytes() const override {
        return std::uint64_t{chosen_.array.components} * size_of(*chosen_.array.type) *
               (blocks_                  ? 2 * info_.grid.vertex_count()
                : chosen_.array.on_cells ? info_.grid.cell_count()
                                         : std::uint64_t{slices_worth_asking(info_)} *
                                               info_.grid.vertices[0] * info_.grid.vertices[1]);
    }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        Grid part = info_.grid;
        part.vertices[2] = slices.count;
        const bool cells = chosen_.array.on_cells;
        const std::uint64_t layers = cells ? info_.grid.vertices[2] - 1 : slices.count;
        tuples_.resize(layers * layer_values(info_.grid) * size_of(*chosen_.array.type));
        if (items_[step].size() == 1)
            load(step, items_[step].front(), info_.grid, cells ? 0 : slices.first, tuples_);
        else
            load_blocks(step);
        convert(chosen_, tuples_, cells ? info_.grid : part, out, name_);
    }

  private:
    /// Vertices, or cells, along each axis of a grid.
    BlockSize places_of(const Grid& grid) const {
        return chosen_.array.on_cells ? grid.cells() : grid.vertices;
    }
    /// Number of values between neighbors along z.
    std::uint64_t layer_values(const Grid& grid) const {
        const BlockSize places = places_of(grid);
        return std::uint64_t{places[0]} * places[1] * chosen_.array.components;
    }

    /// The shape of an array decides how many components it has; what is said of it may differ.
    void note_other_type(const XdmfPart& part) {
        for (const XdmfAttribute& attribute : part.attributes) {
            const std::string type = lower_case(attribute.type);
            const std::uint32_t stated = type == "scalar"    ? 1
                                         : type == "vector"  ? 3
                                         : type == "tensor6" ? 6
                                         : type == "tensor"  ? 9
                                                             : chosen_.array.components;
            if (attribute.name == chosen_.array.name && stated != chosen_.array.components)
                info_.notes.push_back(*note_on_unread(
                    {fmt::format("AttributeType {} ({} has the shape of {} {})", attribute.type,
                                 attribute.name, chosen_.array.components,
                                 chosen_.array.components == 1 ? "component" : "components")}));
        }
    }

    /// Checks that no cell is missing: blocks may hold all vertices, but not the cells between two
    /// blocks.
    void expect_all_cells() const {
        for (const XdmfGrid& step : steps_) {
            std::vector<Grid> cells;
            for (const XdmfPart& part : step.parts) {
                cells.push_back(part.grid);
                cells.back().vertices = part.grid.cells();
            }
            places_of_blocks(cells, std::vector<std::string>(cells.size(), name_));
        }
    }

    /// Fills `tuples_` with the whole of a step in several blocks.
    void load_blocks(std::size_t step) {
        const std::size_t size = chosen_.array.components * size_of(*chosen_.array.type);
        const BlockSize whole = places_of(info_.grid);
        std::vector<std::byte> values;
        for (std::size_t i = 0; i < steps_[step].parts.size(); ++i) {
            const XdmfPart& part = steps_[step].parts[i];
            const BlockSize places = places_of(part.grid);
            values.resize(size * places[0] * places[1] * places[2]);
            load(step, items_[step][i], part.grid, 0, values);
            each_row_of_block(part.begin, places, whole, [&](std::uint64_t to, std::uint64_t from) {
                std::memcpy(&tuples_[to * size], &values[from * size], places[0] * size);
            });
        }
    }

    /// @return none: its values are not at every vertex or cell
    static std::optional<std::uint32_t> components_of(const XdmfAttribute& attribute,
                                                      const Grid& grid) {
        const std::uint64_t places = attribute.on_cells ? grid.cell_count() : grid.vertex_count();
        std::uint64_t values = 1;
        for (const std::uint64_t size : attribute.item.dimensions)
            if (__builtin_mul_overflow(values, size, &values))
                return std::nullopt;
        constexpr std::uint64_t kMost = 64;
        if (attribute.item.dimensions.empty() || values % places != 0 || values / places == 0 ||
            values / places > kMost)
            return std::nullopt;
        const auto components = static_cast<std::uint32_t>(values / places);
        if (components > 1 && attribute.item.dimensions.back() != components)
            return std::nullopt;
        return components;
    }

    /// The type of a dataset is what counts, not what the document says.
    StoredType type_of(const XdmfItem& item) {
        if (item.where != XdmfItem::Where::hdf5)
            return item.type;
        const Hdf5Dataset dataset = open_dataset(item);
        if (!dataset.type)
            throw Error("{}: {} does not hold numbers that can be read", heavy_->name(),
                        dataset.path);
        return *dataset.type;
    }

    /// Leaves out the last steps whose datasets are not there, as where a run was stopped.
    void leave_out_missing_end() {
        const std::size_t all = items_.size();
        const auto is_there = [&](const XdmfItem& item) {
            std::error_code ignored;
            return item.where != XdmfItem::Where::hdf5 ||
                   (fs::exists(heavy_of(item.text, item.document).file, ignored) &&
                    find_dataset(item));
        };
        while (items_.size() > 1 && std::ranges::none_of(items_.back(), is_there))
            items_.pop_back();
        if (items_.size() == all)
            return;
        info_.notes.push_back(
            fmt::format("{} of {} steps are written, the values of step {} are "
                        "not there ({}): left out",
                        items_.size(), all, items_.size(),
                        excerpt(steps_[items_.size()].parts.front().attributes.front().item.text)));
        steps_.resize(items_.size());
    }

    std::optional<Hdf5Dataset> find_dataset(const XdmfItem& item) {
        const XdmfHeavy heavy = heavy_of(item.text, item.document);
        if (!heavy_ || heavy_path_ != heavy.file) {
            values_.reset();
            heavy_ = std::make_unique<Hdf5File>(heavy.file);
            heavy_path_ = heavy.file;
        }
        return heavy_->dataset(heavy.path);
    }

    Hdf5Dataset open_dataset(const XdmfItem& item) {
        auto dataset = find_dataset(item);
        if (!dataset)
            throw Error("{}: holds no dataset {}", heavy_->name(),
                        excerpt(heavy_of(item.text, item.document).path));
        return std::move(*dataset);
    }

    void expect_same_grid(const XdmfGrid& step) const {
        if (step.grid.vertices != steps_.front().grid.vertices ||
            step.grid.spacing != steps_.front().grid.spacing ||
            step.grid.origin != steps_.front().grid.origin ||
            step.grid.positions != steps_.front().grid.positions)
            throw Error("{}: the grid of step {} is not as in step 0", name_, items_.size());
    }

    /// The chosen array of a part; it must be like the chosen array of the first part.
    XdmfItem item_in(const XdmfPart& part) const {
        const std::size_t step = items_.size() - 1;
        const auto found = std::ranges::find_if(part.attributes, [&](const XdmfAttribute& one) {
            return (one.name.empty() ? "values" : one.name) == chosen_.array.name &&
                   one.on_cells == chosen_.array.on_cells;
        });
        if (found == part.attributes.end())
            throw Error("{}: step {} has no attribute {}", name_, step, chosen_.array.name);
        if (components_of(*found, part.grid) != chosen_.array.components)
            throw Error("{}: {} of step {} is not as in step 0", name_, chosen_.array.name, step);
        expect_room_for(found->item);
        return found->item;
    }

    /// A document that lies about sizes is to cost no memory.
    void expect_room_for(const XdmfItem& item) const {
        const std::uint64_t values = product(item.dimensions);
        if (item.where == XdmfItem::Where::plain)
            expect_room(file_named_in(item.document, item.text), item.seek, Compression::none,
                        values * size_of(item.type));
        if (item.where == XdmfItem::Where::document && values > item.text.size() / 2 + 1)
            throw Error("{}: {} bytes of numbers as text, expected {} numbers", name_,
                        item.text.size(), values);
    }

    /// Reads layers along z. @param grid that the item is of
    void load(std::size_t step, const XdmfItem& item, const Grid& grid, std::uint64_t first,
              std::span<std::byte> out) {
        const std::size_t size = size_of(*chosen_.array.type);
        switch (item.where) {
        case XdmfItem::Where::hdf5: return load_dataset(item, grid, first, out);
        case XdmfItem::Where::plain: {
            const fs::path file = file_named_in(item.document, item.text);
            const std::uint64_t at = item.seek + first * layer_values(grid) * size;
            const std::size_t got = InputFile(file).read(at, out);
            if (item.type != *chosen_.array.type || !item.start.empty() || got < out.size())
                throw Error("{}: {} bytes from byte {} on, expected {} of {}", file.string(), got,
                            at, out.size(), name_of(*chosen_.array.type));
            if (item.big_endian)
                swap_bytes(out, size);
            return;
        }
        case XdmfItem::Where::document: break;
        }
        const auto numbers = numbers_of_item(item);
        if (numbers.size() != product(item.dimensions) || item.type != *chosen_.array.type)
            throw Error("{}: {} numbers in step {}, expected {}", name_, numbers.size(), step,
                        product(item.dimensions));
        visit_stored_type(item.type, [&]<class T>(std::type_identity<T>) {
            for (std::size_t i = 0; i < out.size() / sizeof(T); ++i) {
                const double number = numbers[first * layer_values(grid) + i];
                if (std::is_integral_v<T> &&
                    !(number >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
                      // NOLINTNEXTLINE(bugprone-integer-division): half of a power of two
                      number < 2.0 * static_cast<double>(std::numeric_limits<T>::max() / 2 + 1)))
                    throw Error("{}: {} in step {}, expected {}", name_, number, step,
                                name_of(item.type));
                const T value = static_cast<T>(number);
                std::memcpy(out.data() + i * sizeof(T), &value, sizeof(T));
            }
        });
    }

    void load_dataset(const XdmfItem& item, const Grid& grid, std::uint64_t first,
                      std::span<std::byte> out) {
        if (!values_ || values_of_ != &item) {
            values_.reset();
            dataset_ = open_dataset(item);
            if (dataset_.type != chosen_.array.type)
                throw Error("{}: {} holds {}, expected {}", heavy_->name(), dataset_.path,
                            dataset_.type ? name_of(*dataset_.type) : "no numbers",
                            name_of(*chosen_.array.type));
            values_.emplace(*heavy_, dataset_, std::nullopt);
            values_of_ = &item;
        }
        std::vector<std::uint64_t> start = item.start, count = item.count;
        if (start.empty()) {
            start.assign(dataset_.dimensions.size(), 0);
            count = dataset_.dimensions;
        }
        bool within = start.size() == dataset_.dimensions.size();
        for (std::size_t i = 0; i < start.size() && within; ++i)
            within = start[i] + count[i] <= dataset_.dimensions[i];
        const std::uint64_t all_layers = places_of(grid)[2], of_layer = layer_values(grid);
        const std::uint64_t layers = out.size() / size_of(*chosen_.array.type) / of_layer;
        // The axis of the layers is the first that is longer than 1; a flat dataset has one axis.
        std::size_t axis = 0;
        while (axis + 1 < count.size() && count[axis] == 1 && all_layers > 1)
            ++axis;
        const bool flat = !count.empty() && axis + 1 == count.size();
        if (!within || count.empty() || product(count) != all_layers * of_layer ||
            (!flat && layers != all_layers && count[axis] != all_layers))
            throw Error("{}: {} ({}) is not of the shape that {} says", heavy_->name(),
                        dataset_.path, shape_text(dataset_.dimensions), name_);
        if (layers != all_layers) {
            const std::uint64_t share = flat ? of_layer : 1;
            start[axis] += first * share;
            count[axis] = layers * share;
        }
        values_->read(start, count, out);
    }

    std::string name_;
    std::vector<XdmfGrid> steps_;
    std::vector<std::vector<XdmfItem>> items_; ///< items of the chosen array, by step and part
    bool blocks_ = false;                      ///< a step has several parts
    ChosenScalar chosen_;
    std::unique_ptr<Hdf5File> heavy_; ///< the file that was opened last
    fs::path heavy_path_;
    Hdf5Dataset dataset_;
    std::optional<Hdf5Values> values_;    ///< values of `dataset_`
    const XdmfItem* values_of_ = nullptr; ///< whose `values_` are
    std::vector<std::byte> tuples_;
};

} // namespace

std::unique_ptr<DecodedFile> decode_xdmf(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<XdmfFile>(path, options);
}

} // namespace isochron::index
