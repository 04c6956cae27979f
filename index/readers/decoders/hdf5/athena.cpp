// Blocks of a mesh as Athena++ writes them: a dataset for each group of variables, [variable][block][z][y][x].
//
// Stone et al., "The Athena++ Adaptive Mesh Refinement Framework: Design and Magnetohydrodynamic
// Solvers", ApJS 249, 2020, doi:10.3847/1538-4365/ab929b;
// https://github.com/PrincetonUniversity/athena/wiki/HDF5-Format.
#include "index/readers/decoders/hdf5/athena.h"

#include "index/error.h"
#include "index/readers/decoders/hdf5/hdf5_values.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/series/block_places.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// A variable, by the dataset that has it and its number there.
struct AthenaVariable {
    Hdf5Dataset dataset;
    std::uint64_t number = 0;
};

class AthenaFile final : public DecodedFile {
  public:
    AthenaFile(std::unique_ptr<Hdf5File> file, const ReadOptions& options)
        : file_(std::move(file)) {
        find_blocks();
        find_variables();
        std::vector<StoredArray> offered;
        const std::vector<std::string> names = file_->texts("/", "VariableNames");
        for (std::size_t i = 0; i < variables_.size(); ++i)
            offered.push_back({.name = names[i], .type = variables_[i].dataset.type});
        chosen_ = choose_scalar(offered, options, file_->name());
        variable_ = static_cast<std::size_t>(
            std::ranges::find(offered, chosen_.array.name, &StoredArray::name) - offered.begin());
        values_.emplace(*file_, variables_[variable_].dataset, std::nullopt);
        chosen_.describe(info_);
        place(options);
        info_.notes.push_back(
            fmt::format("put together from {} blocks of Athena++; values of cells "
                        "are taken at their centers",
                        begins_.size()));
        if (const std::string kind = file_->text("/", "Coordinates");
            !kind.empty() && kind != "cartesian" && kind != "minkowski")
            info_.notes.push_back(
                *note_on_unread({fmt::format("Coordinates {} (shown as cartesian)", kind)}));
        for (std::string& note : chosen_.notes())
            info_.notes.push_back(std::move(note));
        if (const auto time = file_->numbers("/", "Time"); !time.empty())
            info_.times = {time.front()};
    }

    std::size_t steps() const override { return 1; }
    std::uint32_t slices_at_once() const override { return info_.grid.vertices[2]; }
    std::uint64_t decoded_bytes() const override { return 2 * info_.step_bytes(); }

    void read(std::size_t, Slices slices, std::span<std::byte> out) override {
        const BlockSize whole = info_.grid.vertices;
        const std::size_t size = size_of(*chosen_.array.type);
        std::vector<std::byte> all(info_.grid.vertex_count() * size),
            block(std::size_t{size_[0]} * size_[1] * size_[2] * size);
        for (std::size_t i = 0; i < begins_.size(); ++i) {
            values_->read(std::array<std::uint64_t, 5>{variables_[variable_].number, i, 0, 0, 0},
                          std::array<std::uint64_t, 5>{1, 1, size_[2], size_[1], size_[0]}, block);
            each_row_of_block(begins_[i], size_, whole, [&](std::uint64_t to, std::uint64_t from) {
                std::memcpy(&all[to * size], &block[from * size], size_[0] * size);
            });
        }
        Grid part = info_.grid;
        part.vertices[2] = slices.count;
        const std::size_t layer = std::size_t{whole[0]} * whole[1] * size;
        convert(chosen_, std::span(all).subspan(slices.first * layer, slices.count * layer), part,
                out, file_->name());
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error("{}: {}", file_->name(), what);
    }

    std::vector<double> values_of(const char* path, std::size_t count) const {
        const auto dataset = file_->dataset(path);
        std::vector<double> values = dataset ? file_->values(*dataset) : std::vector<double>();
        if (values.size() != count)
            fail(fmt::format("{} has {} numbers, expected {}, as Athena++ writes it", path,
                             values.size(), count));
        return values;
    }

    void find_blocks() {
        const auto number = file_->numbers("/", "NumMeshBlocks"),
                   sizes = file_->numbers("/", "MeshBlockSize");
        constexpr double kMostBlocks = 1 << 20, kLongest = 1 << 16;
        if (number.empty() || !(number[0] >= 1 && number[0] <= kMostBlocks) || sizes.size() != 3 ||
            std::ranges::any_of(sizes, [](double n) { return !(n >= 1 && n <= kLongest); }))
            fail(
                "NumMeshBlocks and MeshBlockSize, expected a number and three sizes of at least 1");
        const auto count = static_cast<std::size_t>(number[0]);
        const std::vector<double> levels = values_of("/Levels", count),
                                  places = values_of("/LogicalLocations", 3 * count);
        const std::set<double> different(levels.begin(), levels.end());
        if (different.size() > 1)
            fail(fmt::format("Athena++'s blocks of {} levels of refinement, expected one; yt's "
                             "covering_grid makes a regular grid of them",
                             different.size()));
        for (std::size_t axis = 0; axis < 3; ++axis)
            size_[axis] = static_cast<std::uint32_t>(sizes[axis]);
        std::set<std::array<double, 3>> seen;
        std::array<double, 3> least{HUGE_VAL, HUGE_VAL, HUGE_VAL}, most{};
        for (std::size_t i = 0; i < count; ++i) {
            std::array<double, 3> at{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                at[axis] = places[3 * i + axis];
                least[axis] = std::min(least[axis], at[axis]);
                most[axis] = std::max(most[axis], at[axis]);
            }
            if (!seen.insert(at).second)
                fail(fmt::format("two blocks at {}", fmt::join(at, " ")));
        }
        std::array<std::int64_t, 3> whole{}, blocks{};
        double expected = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            blocks[axis] = static_cast<std::int64_t>(most[axis] - least[axis] + 1);
            expected *= static_cast<double>(blocks[axis]);
            whole[axis] = blocks[axis] * size_[axis];
        }
        if (expected != static_cast<double>(count))
            fail(fmt::format("{} blocks, expected {}", count, fmt::join(blocks, " x ")));
        info_.grid.vertices = checked_vertices(whole, file_->name());
        for (std::size_t i = 0; i < count; ++i) {
            BlockSize& begin = begins_.emplace_back();
            for (std::size_t axis = 0; axis < 3; ++axis)
                begin[axis] =
                    static_cast<std::uint32_t>(places[3 * i + axis] - least[axis]) * size_[axis];
        }
    }

    void find_variables() {
        const std::vector<std::string> names = file_->texts("/", "VariableNames"),
                                       datasets = file_->texts("/", "DatasetNames");
        const std::vector<double> counts = file_->numbers("/", "NumVariables");
        for (std::size_t i = 0; i < datasets.size() && i < counts.size(); ++i) {
            const auto dataset = file_->dataset("/" + datasets[i]);
            const std::vector<std::uint64_t> shape{static_cast<std::uint64_t>(counts[i]),
                                                   begins_.size(), size_[2], size_[1], size_[0]};
            if (!dataset || !dataset->type || dataset->dimensions != shape)
                fail(fmt::format("/{} is {}, expected {}", datasets[i],
                                 dataset ? shape_text(dataset->dimensions) : "not there",
                                 shape_text(shape)));
            for (std::uint64_t number = 0; number < shape[0]; ++number)
                variables_.push_back({*dataset, number});
        }
        if (variables_.empty() || variables_.size() != names.size())
            fail(fmt::format("{} names of {} variables, expected one for each", names.size(),
                             variables_.size()));
    }

    /// The centers of the cells of all blocks along an axis.
    void place(const ReadOptions& options) {
        StatedArray stated{.file = file_->name(), .name = info_.array, .axes = {}};
        for (const std::size_t axis : {2, 1, 0}) {
            const std::string name = fmt::format("x{}", axis + 1);
            const std::vector<double> centers =
                values_of(("/" + name + "v").c_str(), begins_.size() * size_[axis]);
            StatedAxis& along = stated.axes.emplace_back(StatedAxis{.name = name});
            along.at.resize(info_.grid.vertices[axis]);
            for (std::size_t block = 0; block < begins_.size(); ++block)
                for (std::size_t i = 0; i < size_[axis]; ++i)
                    along.at[begins_[block][axis] + i] = centers[block * size_[axis] + i];
        }
        place_axes(stated, layout_of_zyx(), options, info_);
    }

    std::unique_ptr<Hdf5File> file_;
    BlockSize size_{};              ///< cells of each block along x, y and z
    std::vector<BlockSize> begins_; ///< the first cell of each block
    std::vector<AthenaVariable> variables_;
    std::size_t variable_ = 0;
    ChosenScalar chosen_;
    std::optional<Hdf5Values> values_;
};

} // namespace

bool is_athena(const Hdf5File& file) {
    return !file.numbers("/", "NumMeshBlocks").empty() && file.holds("/LogicalLocations");
}

std::unique_ptr<DecodedFile> decode_athena(std::unique_ptr<Hdf5File> file,
                                           const ReadOptions& options) {
    return std::make_unique<AthenaFile>(std::move(file), options);
}

} // namespace isochron::index
