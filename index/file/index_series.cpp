// Reads indices of version 2 and of this version as series, step by step.
#include "index/file/index_series.h"

#include "index/error.h"
#include "index/file/index_file.h"
#include "index/system/running_checksum.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace isochron::index {
namespace {

/// The header of version 2: sections are in another order, and the section of colors is after the
/// checksum. Steps are stored one after the other, not packed, each padded to 64 bytes; the steps
/// of the colors come after a table of their checksums.
struct OldHeader {
    static constexpr std::uint32_t kVersion = 2;
    std::array<char, 8> magic;
    std::uint32_t version, byte_order;
    std::uint64_t file_bytes, content_hash;
    Section volume, bricks, units, tree, directory, checksums, metadata;
    std::uint64_t checksum;
    Section colors;
};
static_assert(sizeof(OldHeader) == 232);

OldHeader header_of(const ByteSource& bytes) {
    OldHeader header{};
    if (bytes.size() >= sizeof header)
        bytes.read(0, std::as_writable_bytes(std::span(&header, 1)));
    return header;
}

/// Applies the overrides that are possible for any series.
SeriesInfo with_overrides(SeriesInfo info, const ReadOptions& options) {
    info.grid.spacing = options.spacing.value_or(info.grid.spacing);
    if (options.spacing)
        info.grid.positions = {};
    info.grid.origin = options.origin.value_or(info.grid.origin);
    info.length_unit = options.length_unit.value_or(info.length_unit);
    info.time_unit = options.time_unit.value_or(info.time_unit);
    info.value_unit = options.value_unit.value_or(info.value_unit);
    for (std::size_t t = 0; options.time_step && t < info.steps(); ++t)
        info.times[t] = static_cast<double>(t) * *options.time_step;
    return info;
}

/// The description and the stored values of an index of either version.
class IndexSeries final : public VolumeSeries {
  public:
    explicit IndexSeries(const std::filesystem::path& path) : name_(path.string()) {
        auto bytes = open_bytes(path);
        const OldHeader header = header_of(*bytes);
        if (header.version != OldHeader::kVersion) {
            file_ = IndexFile::open(std::move(bytes));
            info_ = file_->info();
            for (std::size_t number = 0; number < file_->arrays(); ++number)
                names_.push_back(file_->array(number).info().array);
            if (file_->color())
                color_ = *file_->color();
            if (file_->referral())
                refuse("refers to its sources: build from these");
            return;
        }
        bytes_ = std::move(bytes);
        open_old(header);
    }

    const SeriesInfo& info() const override { return info_; }
    const std::optional<ColorArray>& color() const { return color_; }
    /// Names of the arrays with search structures.
    const std::vector<std::string>& names() const { return names_; }

    /// Chooses between the arrays and the colors.
    void choose(const ReadOptions& options) {
        if (const auto number = file_ && options.array ? file_->array_called(*options.array)
                                                       : std::optional<std::size_t>()) {
            file_ = array_of(file_, *number);
            info_ = file_->info();
        } else if (options.array && color_ && *options.array == color_->array) {
            as_colors_ = true;
            info_.array = color_->array;
            info_.value_unit = color_->value_unit;
            info_.type = color_->type;
            info_.scaling = color_->scaling;
        } else if (options.array && *options.array != info_.array) {
            refuse(fmt::format("has no array {}, only {}{}", *options.array,
                               fmt::join(names_, ", "), color_ ? " and " + color_->array : ""));
        }
        info_.arrays = names_;
        info_ = with_overrides(std::move(info_), options);
    }

    void read(std::size_t step, std::span<std::byte> out) override {
        if (file_) {
            const auto t = static_cast<std::uint32_t>(step);
            const LoadedStep loaded = as_colors_ ? file_->load_color(t) : file_->load(t);
            std::memcpy(out.data(), loaded.values.step_bytes(step).data(), out.size());
            return;
        }
        bytes_->read((as_colors_ ? colors_ : volume_) + step * step_stride(out.size()), out);
        expect_checksum(step, checksum_of(out));
    }

    void stream(std::size_t step, const TakePiece& take) override {
        const std::uint64_t bytes = info_.step_bytes();
        if (file_)
            return stream_chunks(static_cast<std::uint32_t>(step), take);
        RunningChecksum checksum;
        std::vector<std::byte> piece;
        const std::uint64_t begin = (as_colors_ ? colors_ : volume_) + step * step_stride(bytes);
        constexpr std::uint64_t kPiece = 1 << 20;
        for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
            piece.resize(std::min(kPiece, bytes - at));
            bytes_->read(begin + at, piece);
            checksum.add(piece);
            take(piece);
        }
        expect_checksum(step, checksum.take());
    }

  private:
    /// Streams a step, a layer of chunks at a time.
    void stream_chunks(std::uint32_t step, const TakePiece& take) {
        const ChunkStore& store = as_colors_ ? *file_->color_chunks() : file_->chunks();
        const ChunkGrid& grid = store.grid();
        const std::size_t size = size_of(info_.type);
        const std::size_t row = info_.grid.vertices[0] * size, plane = info_.grid.vertices[1] * row;
        std::vector<std::uint32_t> places(grid.chunks_of_layer());
        std::iota(places.begin(), places.end(), 0u);
        std::vector<std::byte> planes;
        for (std::uint32_t layer = 0; layer < grid.layers(); ++layer) {
            planes.resize(grid.size(layer, 0)[2] * plane);
            // Reads some chunks at a time, since the cache may be small.
            constexpr std::size_t kAtOnce = 1024;
            for (std::size_t first = 0; first < places.size(); first += kAtOnce) {
                const auto some =
                    std::span(places).subspan(first, std::min(kAtOnce, places.size() - first));
                const std::vector<ChunkPtr> chunks = store.chunks(step, layer, some);
                for (std::size_t i = 0; i < some.size(); ++i)
                    put(*chunks[i], grid.at(some[i]), row, plane, planes);
            }
            take(planes);
        }
    }

    static void put(const Chunk& chunk, const std::array<std::uint32_t, 2>& at, std::size_t row,
                    std::size_t plane, std::span<std::byte> planes) {
        const auto [nx, ny, nz] = chunk.size;
        const std::size_t bytes = chunk.values.size() / nz / ny;
        const std::byte* from = chunk.values.data();
        std::byte* to = planes.data() + at[1] * kChunkEdge * row + at[0] * kChunkEdge * bytes / nx;
        for (std::uint32_t z = 0; z < nz; ++z)
            for (std::uint32_t y = 0; y < ny; ++y, from += bytes)
                std::memcpy(to + z * plane + y * row, from, bytes);
    }

    void expect_checksum(std::size_t step, std::uint64_t checksum) const {
        if (checksum != (as_colors_ ? color_checksums_ : checksums_)[step])
            refuse(fmt::format("damaged: the checksum of step {} does not match", step));
    }

    [[noreturn]] void refuse(const std::string& what) const { throw Error("{}: {}", name_, what); }

    template <class T>
    std::vector<T> section(const Section& where, std::uint64_t count) const {
        if (where.offset > bytes_->size() || where.bytes > bytes_->size() - where.offset ||
            count > where.bytes / sizeof(T))
            refuse("damaged or truncated");
        std::vector<T> items(count);
        bytes_->read(where.offset, std::as_writable_bytes(std::span(items)));
        return items;
    }

    void open_old(const OldHeader& header) {
        const auto text = section<char>(header.metadata, header.metadata.bytes);
        if (checksum_of(std::as_bytes(std::span(text))) != header.metadata.checksum)
            refuse("damaged: the checksum of section metadata does not match");
        const Metadata metadata = [&] {
            try {
                return metadata_from_json({text.data(), text.size()});
            } catch (const Error& error) {
                refuse(fmt::format("damaged: metadata: {}", error.what()));
            }
        }();
        if (metadata.referral)
            refuse("refers to its sources: build from these");
        info_ = metadata.info;
        names_ = {info_.array};
        color_ = metadata.color;
        checksums_ = section<std::uint64_t>(header.checksums, info_.steps());
        volume_ = header.volume.offset;
        if (header.volume.bytes / step_stride(info_.step_bytes()) < info_.steps())
            refuse("damaged: the volume is too short");
        if (!color_)
            return;
        color_checksums_ = section<std::uint64_t>(header.colors, info_.steps());
        colors_ =
            header.colors.offset + align_up(info_.steps() * sizeof(std::uint64_t), kPartAlignment);
    }

    std::string name_;
    SeriesInfo info_;
    std::vector<std::string> names_;
    std::optional<ColorArray> color_;
    bool as_colors_ = false;
    std::shared_ptr<const IndexFile> file_; ///< if of this version
    std::unique_ptr<ByteSource> bytes_;     ///< if of version 2
    std::uint64_t volume_ = 0, colors_ = 0; ///< where the steps begin
    std::vector<std::uint64_t> checksums_, color_checksums_;
};

} // namespace

bool is_index(const std::filesystem::path& path) {
    if (std::error_code ignored; !std::filesystem::is_regular_file(path, ignored))
        return false;
    const auto bytes = open_bytes(path);
    std::array<char, 8> magic{};
    if (bytes->size() < magic.size())
        return false;
    bytes->read(0, std::as_writable_bytes(std::span(magic)));
    return magic == FileHeader{}.magic;
}

std::optional<std::string> color_of_index(const std::filesystem::path& path) {
    const auto color = IndexSeries(path).color();
    return color ? std::optional(color->array) : std::nullopt;
}

std::vector<std::string> arrays_of_index(const std::filesystem::path& path) {
    return IndexSeries(path).names();
}

std::unique_ptr<VolumeSeries> open_index_series(const std::filesystem::path& path,
                                                const ReadOptions& options) {
    auto series = std::make_unique<IndexSeries>(path);
    series->choose(options);
    return series;
}

} // namespace isochron::index
