// Reads VTK XML image data (.vti), in all encodings and with all compressors, without VTK.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/vtk/vti_document.h"
#include "index/readers/decoders/vtk/vtk_fields.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_image.h"
#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/stored_file.h"
#include "index/system/mapped_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The vertices or cells that an extent has along each axis.
std::array<std::int64_t, 3> sizes_of(const VtiExtent& extent, bool on_cells) {
    std::array<std::int64_t, 3> sizes{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        sizes[axis] = std::max<std::int64_t>(
            std::int64_t{extent[2 * axis + 1]} - extent[2 * axis] + !on_cells, 0);
    return sizes;
}

/// The product; none where it has more than 62 bits.
std::optional<std::uint64_t> count_of(const std::array<std::int64_t, 3>& sizes) {
    std::uint64_t count = 1;
    for (const std::int64_t size : sizes) {
        if (size != 0 && count > (std::uint64_t{1} << 62) / static_cast<std::uint64_t>(size))
            return std::nullopt;
        count *= static_cast<std::uint64_t>(size);
    }
    return count;
}

// Every piece gives its part of the vertices; where one is missing there would be zeros. Pieces may
// overlap.
void expect_whole(const std::vector<VtiPiece>& pieces, const Grid& grid, const std::string& file) {
    std::uint64_t cells = 0;
    for (const VtiPiece& piece : pieces)
        cells += std::min(count_of(sizes_of(piece.extent, true)).value_or(grid.cell_count()),
                          grid.cell_count());
    if (cells < grid.cell_count())
        throw Error("{}: its pieces hold {} cells, the whole extent has {}", file, cells,
                    grid.cell_count());
}

// Checks that the file is large enough. A value takes at least a digit and a blank as text, and 4/3
// of its size in base64.
void expect_bytes(const ChosenScalar& chosen, const VtiDocument& document, const Grid& grid,
                  std::uint64_t size, const std::string& file) {
    const bool text = std::ranges::any_of(document.pieces, [&](const VtiPiece& piece) {
        return std::ranges::any_of(piece.arrays(chosen.array.on_cells), [&](const VtiArray& array) {
            return array.array.name == chosen.array.name && array.place.as == VtiPlace::As::text;
        });
    });
    const double stored =
        static_cast<double>(tuples_of_vtk(chosen, grid)) * chosen.array.components;
    const double best = static_cast<double>(best_ratio(document.encoding.packing));
    const double least =
        text ? stored : stored * static_cast<double>(size_of(*chosen.array.type)) / best;
    if (least > static_cast<double>(size))
        throw Error("{}: truncated: {} vertices in {} bytes", file, grid.vertex_count(), size);
}

class VtiFile final : public DecodedFile {
  public:
    VtiFile(fs::path path, const ReadOptions& options) : path_(std::move(path)), file_(path_) {
        const std::string name = path_.string();
        const std::string_view markup = markup_of(file_);
        if (markup.find("<VTKFile") == markup.npos || markup.find("ImageData") == markup.npos)
            throw Error("{}: not VTK XML image data", name);
        expect_end(file_, name);
        expect_shallow(markup, name);
        expect_names(markup, name);
        document_ = vti_document(file_, markup, name);
        describe(options);
        take_fields_of_markup(markup, chosen_, info_);
        if (document_.encoding.packing == BlockPacking::lz4)
            info_.notes.push_back(
                "LZ4 data of VTK carry no check: damage to them may go unnoticed");
        expect_whole(document_.pieces, info_.grid, name);
        expect_bytes(chosen_, document_, info_.grid, file_.bytes().size(), name);
        if (chosen_.array.gaps)
            hidden_ = hidden_by_flags({.points = flags(false), .cells = flags(true)}, chosen_,
                                      info_.grid);
        std::ranges::copy(notes_on_hidden(hidden_, chosen_.array.on_cells),
                          std::back_inserter(info_.notes));
        take_time();
    }

    std::size_t steps() const override { return 1; }

    std::uint32_t slices_at_once() const override { return slices_of_vtk(chosen_, info_); }
    std::uint64_t decoded_bytes() const override { return bytes_of_vtk(chosen_, info_.grid); }

    void read(std::size_t, Slices slices, std::span<std::byte> out) override {
        if (!std::exchange(decoded_, true))
            decode();
        const bool all = slices.count == info_.grid.vertices[2];
        const std::uint64_t slice = values_.size() / info_.grid.vertices[2];
        auto tuples = all ? values_ : values_.subspan(slices.first * slice, slices.count * slice);
        std::vector<std::byte> aligned; // a file has its values anywhere
        if (reinterpret_cast<std::uintptr_t>(tuples.data()) % size_of(*chosen_.array.type) != 0) {
            aligned.assign(tuples.begin(), tuples.end());
            tuples = aligned;
        }
        convert_slices(chosen_, tuples, info_.grid, slices, hidden_, out, path_.string());
    }

  private:
    void describe(const ReadOptions& options) {
        const std::string name = path_.string();
        info_.grid = grid_of_vtk(*reinterpret_cast<const int(*)[6]>(document_.extent.data()),
                                 document_.origin.data(), document_.spacing.data(),
                                 document_.direction.data(), name);
        std::vector<StoredArray> arrays;
        for (const bool on_cells : {false, true})
            if (!document_.pieces.empty())
                for (const VtiArray& each : document_.pieces.front().arrays(on_cells))
                    arrays.push_back(each.array);
        chosen_ = choose_scalar(without_flags(std::move(arrays)), options, name);
        chosen_.describe(info_);
        info_.notes = chosen_.notes();
    }

    void take_time() {
        for (const char* name : kTimeFields)
            for (const VtiArray& field : document_.fields) {
                if (field.array.name != name)
                    continue;
                if (!field.array.type)
                    throw Error("{} is of another type than VTK's, expected Int8 to UInt64, "
                                "Float32 or Float64",
                                where(name));
                std::array<std::byte, 8> bytes{};
                const std::size_t size = size_of(*field.array.type);
                read_vti_values(field.place, document_.encoding, *field.array.type,
                                std::span(bytes).first(size), where(name));
                info_.times = {
                    visit_stored_type(*field.array.type, [&]<class T>(std::type_identity<T>) {
                        T value{};
                        std::memcpy(&value, bytes.data(), sizeof(T));
                        return static_cast<double>(value);
                    })};
                if (std::string_view(name) != kTimeFields.front())
                    info_.notes.push_back(fmt::format("times are those of the field {}", name));
                return;
            }
    }

    std::string where(std::string_view array) const {
        return fmt::format("{}: array {}", path_.string(), array);
    }

    /// The array of a piece that has a name; null if it has none.
    static const VtiArray* array_in(const VtiPiece& piece, const std::string& name, bool on_cells) {
        const auto& arrays = piece.arrays(on_cells);
        const auto found =
            std::ranges::find(arrays, name, [](const VtiArray& each) -> const std::string& {
                return each.array.name;
            });
        return found == arrays.end() ? nullptr : &*found;
    }

    /// Puts the pieces of an array together, in the order of the file: of what two pieces have, the later counts.
    /// @param out tuples of the whole grid
    void assemble(const StoredArray& wanted, std::span<std::byte> out) const {
        const std::size_t tuple = size_of(*wanted.type) * wanted.components;
        const auto whole = sizes_of(document_.extent, wanted.on_cells);
        for (const VtiPiece& piece : document_.pieces) {
            const auto sizes = sizes_of(piece.extent, wanted.on_cells);
            if (std::ranges::find(sizes, 0) != sizes.end())
                continue;
            const VtiArray* const array = array_in(piece, wanted.name, wanted.on_cells);
            if (!array || array->array.type != wanted.type ||
                array->array.components != wanted.components)
                throw Error("{}: array {} is not the same in all pieces", path_.string(),
                            wanted.name);
            if (piece.extent == document_.extent) {
                read_vti_values(array->place, document_.encoding, *wanted.type, out,
                                where(wanted.name));
                continue;
            }
            const auto count = count_of(sizes);
            if (!count || *count > out.size() / tuple)
                throw Error("{}: a piece is larger than the whole extent", path_.string());
            std::vector<std::byte> part(*count * tuple);
            read_vti_values(array->place, document_.encoding, *wanted.type, part,
                            where(wanted.name));
            place_part(part, piece.extent, sizes, whole, tuple, out);
        }
    }

    /// Copies rows of the part that lies within the whole.
    void place_part(std::span<const std::byte> part, const VtiExtent& extent,
                    const std::array<std::int64_t, 3>& sizes,
                    const std::array<std::int64_t, 3>& whole, std::size_t tuple,
                    std::span<std::byte> out) const {
        std::array<std::int64_t, 3> at{}, first{}, count{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            at[axis] = std::int64_t{extent[2 * axis]} - document_.extent[2 * axis];
            first[axis] = std::max<std::int64_t>(0, -at[axis]);
            count[axis] = std::min(sizes[axis], whole[axis] - at[axis]) - first[axis];
            if (count[axis] <= 0)
                return;
        }
        for (std::int64_t z = first[2]; z < first[2] + count[2]; ++z)
            for (std::int64_t y = first[1]; y < first[1] + count[1]; ++y) {
                const auto from =
                    static_cast<std::size_t>((z * sizes[1] + y) * sizes[0] + first[0]);
                const auto to = static_cast<std::size_t>(
                    ((z + at[2]) * whole[1] + y + at[1]) * whole[0] + first[0] + at[0]);
                std::memcpy(out.data() + to * tuple, part.data() + from * tuple,
                            static_cast<std::size_t>(count[0]) * tuple);
            }
    }

    /// Flags of all points or cells; none where the file has no flags for them.
    std::vector<std::uint8_t> flags(bool on_cells) const {
        std::vector<std::uint8_t> all;
        for (const char* name : kGhostFlags) {
            const VtiArray* const array = array_in(document_.pieces.front(), name, on_cells);
            if (!array || !array->array.type || array->array.components != 1)
                continue;
            const std::size_t tuples =
                on_cells ? info_.grid.cell_count() : info_.grid.vertex_count();
            std::vector<std::byte> stored(tuples * size_of(*array->array.type));
            assemble(array->array, stored);
            all.resize(tuples);
            visit_stored_type(*array->array.type, [&]<class T>(std::type_identity<T>) {
                const T* const values = reinterpret_cast<const T*>(stored.data());
                for (std::size_t i = 0; i < tuples; ++i)
                    all[i] |= ghost_flag(name, static_cast<double>(values[i]));
            });
        }
        return all;
    }

    /// Values that stand in the file as they are in memory stay there.
    void decode() {
        const StoredArray& wanted = chosen_.array;
        const std::uint64_t bytes = bytes_of_vtk(chosen_, info_.grid);
        if (document_.pieces.size() == 1 && document_.pieces.front().extent == document_.extent)
            if (const VtiArray* array =
                    array_in(document_.pieces.front(), wanted.name, wanted.on_cells))
                values_ = plain_vti_values(array->place, document_.encoding, *wanted.type, bytes,
                                           where(wanted.name));
        if (!values_.empty())
            return;
        memory_.resize(bytes);
        assemble(wanted, memory_);
        values_ = memory_;
    }

    fs::path path_;
    MappedFile file_;
    VtiDocument document_;
    ChosenScalar chosen_;
    std::vector<std::uint8_t> hidden_;
    bool decoded_ = false;
    std::span<const std::byte> values_; ///< values of the chosen array, in the file or in memory
    std::vector<std::byte> memory_;
};

} // namespace

std::unique_ptr<DecodedFile> decode_vti(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<VtiFile>(path, options);
}

} // namespace isochron::index
