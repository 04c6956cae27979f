// Reads values that are one plain array.
#include "index/readers/formats/stored_file.h"

#include "index/error.h"
#include "index/readers/formats/half_float.h"
#include "index/readers/formats/text_values.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

namespace isochron::index {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kPiece = 1 << 20; ///< [bytes] read at a time

class StoredFile final : public VolumeFile {
  public:
    StoredFile(std::filesystem::path header, SeriesInfo info, StoredLayout layout,
               ChosenScalar chosen, bool allow_surplus)
        : header_(std::move(header)), info_(std::move(info)), layout_(std::move(layout)),
          chosen_(std::move(chosen)), allow_surplus_(allow_surplus) {
        // The end of compressed data and of text is only found when it is read.
        if (layout_.compression == Compression::none && !layout_.ascii)
            expect_end(
                open_values()->rest(layout_.skip + layout_.steps * std::uint64_t{step_bytes()}));
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return layout_.steps; }
    std::vector<std::filesystem::path> beside() const override {
        std::vector<std::filesystem::path> others;
        for (const DataPart& part : layout_.parts)
            others.push_back(part.path);
        if (others.empty() && layout_.data != header_)
            others.push_back(layout_.data);
        return others;
    }

    void read(std::size_t step, std::span<std::byte> out) override {
        stream_to(step, out, [](std::span<const std::byte>) {});
    }

    void stream(std::size_t step, const TakePiece& take) override { stream_to(step, {}, take); }

    bool reads_anywhere() const override {
        return layout_.compression == Compression::none && !layout_.ascii;
    }
    void read_at(std::size_t step, std::size_t first, std::span<std::byte> out) override {
        if (as_they_are())
            return load(step, first, out);
        tuples_.resize(out.size() / size_of(chosen_.value_type()) * tuple_bytes_in_memory());
        load(step, first, tuples_);
        convert(chosen_, tuples_, info_.grid, out, layout_.data.string());
    }

    std::size_t step_bytes() const { return info_.grid.vertex_count() * tuple_bytes(); }

  private:
    /// Values that need no conversion are read directly into their final place.
    bool as_they_are() const {
        return layout_.array.components == 1 && !layout_.half &&
               stored_type_of(chosen_.value_type()) == *layout_.array.type &&
               chosen_.component != ChosenScalar::kMagnitude;
    }

    std::size_t tuple_bytes() const { return layout_.array.components * stored_bytes(layout_); }
    std::size_t tuple_bytes_in_memory() const {
        return layout_.array.components * size_of(*layout_.array.type);
    }

    std::unique_ptr<DataStream> open_values() const {
        if (layout_.parts.empty())
            return open_data(layout_.data, layout_.offset, layout_.compression);
        return open_parts(layout_.parts,
                          layout_.steps * std::uint64_t{step_bytes()} / layout_.parts.size(),
                          layout_.compression);
    }

    /// Reads a step piece by piece. @param out receives all pieces in order; if empty, each piece
    /// uses the same memory
    void stream_to(std::size_t step, std::span<std::byte> out, const TakePiece& take) {
        const std::size_t value = size_of(chosen_.value_type()), all = info_.grid.vertex_count();
        const std::size_t tuple = tuple_bytes_in_memory();
        const std::size_t at_once = std::min(all, kPiece / std::max(tuple, value));
        const bool as_they_are = this->as_they_are();
        tuples_.resize(as_they_are ? 0 : at_once * tuple);
        values_.resize(out.empty() ? at_once * value : 0);
        for (std::size_t first = 0; first < all; first += at_once) {
            const std::size_t count = std::min(at_once, all - first);
            const auto to = out.empty() ? std::span(values_).first(count * value)
                                        : out.subspan(first * value, count * value);
            const auto tuples = as_they_are ? to : std::span(tuples_).first(count * tuple);
            load(step, first, tuples);
            if (!as_they_are)
                convert(chosen_, tuples, info_.grid, to, layout_.data.string());
            take(to);
        }
        if (step + 1 == layout_.steps)
            expect_end(layout_.ascii ? Rest{.bytes = text_->rest()}
                                     : stream_->rest(layout_.skip +
                                                     (step + 1) * std::uint64_t{step_bytes()}));
    }

    /// @param first number of the tuple in the step
    void load(std::size_t step, std::size_t first, std::span<std::byte> out) {
        const std::size_t tuple = step * info_.grid.vertex_count() + first;
        if (layout_.ascii) {
            if (!text_)
                text_.emplace(layout_.data, layout_.offset, *layout_.array.type);
            return text_->read(tuple * layout_.array.components, out);
        }
        if (!stream_)
            stream_ = open_values();
        halves_.resize(layout_.half ? out.size() / 2 : 0);
        const std::span<std::byte> stored = layout_.half ? std::span(halves_) : out;
        stream_->read(layout_.skip + tuple * std::uint64_t{tuple_bytes()}, stored);
        if (layout_.big_endian)
            swap_bytes(stored, stored_bytes(layout_));
        if (layout_.half)
            widen_halves(halves_, out);
    }

    /// @throws Error when more values follow: they may be steps that the header does not count
    void expect_end(const Rest& rest) const {
        if (allow_surplus_ || (rest.bytes == 0 && rest.foreign == 0))
            return;
        const char* at_least = rest.bytes >= Rest::kMostCounted ? "at least " : "";
        throw Error("{}: {}{} bytes {}, expected none (--allow-surplus reads it)",
                    layout_.data.string(), at_least, rest.bytes > 0 ? rest.bytes : rest.foreign,
                    rest.bytes > 0 ? fmt::format("follow the values of the {} step{} that the "
                                                 "header has",
                                                 layout_.steps, layout_.steps == 1 ? "" : "s")
                                   : "follow the end of the compressed data");
    }

    std::filesystem::path header_;
    SeriesInfo info_;
    StoredLayout layout_;
    ChosenScalar chosen_;
    bool allow_surplus_;
    std::unique_ptr<DataStream> stream_;
    std::optional<TextValues> text_;
    std::vector<std::byte> tuples_, values_; ///< a piece, before and after it is converted
    std::vector<std::byte> halves_;
};

} // namespace

std::unique_ptr<VolumeFile> open_stored(const std::filesystem::path& header, SeriesInfo info,
                                        const StoredLayout& layout, const ReadOptions& options) {
    const std::string name = header.string();
    check_grid(info.grid, name);
    const ChosenScalar chosen = choose_scalar(std::span(&layout.array, 1), options, name);
    chosen.describe(info);
    for (std::string& note : chosen.notes())
        info.notes.push_back(std::move(note));
    if (layout.half)
        info.notes.emplace_back("float16 values converted to f32");
    // A value as text takes at least a digit and a blank; the last value needs no blank.
    const double values = static_cast<double>(info.grid.vertex_count()) * layout.array.components *
                          static_cast<double>(layout.steps);
    const double bytes = layout.ascii ? values * 2 - 1
                                      : values * static_cast<double>(stored_bytes(layout)) +
                                            static_cast<double>(layout.skip);
    constexpr double kMost = 1e18; // beyond any file, within 64 bits
    const auto whole = static_cast<std::uint64_t>(std::min(bytes, kMost));
    if (layout.parts.empty())
        expect_room(layout.data, layout.offset, layout.compression, whole);
    if (!layout.parts.empty() && (layout.ascii || whole % layout.parts.size() != 0))
        throw Error("{}: {} bytes of values in {} files, expected {}", name, whole,
                    layout.parts.size(),
                    layout.ascii ? "no text in several" : "the same share in each");
    for (const DataPart& part : layout.parts)
        expect_room(part.path, part.offset, layout.compression, whole / layout.parts.size());
    expect_few_steps(layout.steps, name);
    // Only now, after the checks, can the header's number of steps be trusted.
    give_times(info, layout, layout.steps);
    return std::make_unique<StoredFile>(header, std::move(info), layout, chosen,
                                        options.allow_surplus);
}

std::size_t stored_bytes(const StoredLayout& layout) {
    return layout.half ? 2 : size_of(*layout.array.type);
}

void give_times(SeriesInfo& info, const StoredLayout& layout, std::size_t steps) {
    if (info.times.empty() && steps > 1 && layout.time_step > 0 && std::isfinite(layout.time_step))
        for (std::size_t step = 0; step < steps; ++step)
            info.times.push_back(layout.first_time + static_cast<double>(step) * layout.time_step);
    if (info.times.empty())
        info.time_unit.clear();
}

void expect_few_steps(std::size_t steps, const std::string& file) {
    constexpr std::size_t kMost = std::size_t{1} << 20;
    if (steps > kMost)
        throw Error("{}: {} steps, at most {} are supported", file, steps, kMost);
    if (steps == 0)
        throw Error("{}: no steps", file);
}

void set_axes(Grid& grid, const glm::dmat3& steps, const std::string& file) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(steps[axis]);
        if (!(length > 0) || !std::isfinite(length))
            throw Error("{}: the spacing along axis {} is {}, expected a positive number", file,
                        axis, length);
        grid.spacing[axis] = length;
        grid.direction[axis] = steps[axis] / length + 0.0; // turns -0 into 0, for display
    }
    if (std::abs(glm::determinant(grid.direction)) < 1e-6)
        throw Error("{}: the three axes lie in a plane", file);
}

void check_grid(const Grid& grid, const std::string& file) {
    checked_vertices({grid.vertices[0], grid.vertices[1], grid.vertices[2]}, file);
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(grid.origin[axis]))
            throw Error("{}: the origin is not finite", file);
}

void expect_measurable(const Grid& grid, const ReadOptions& options) {
    constexpr double kMost = 1e30;
    const auto text = [](const glm::dvec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
    for (int axis = 0; axis < 3; ++axis) {
        if (options.spacing && (!(grid.spacing[axis] > 0) || !std::isfinite(grid.spacing[axis])))
            throw Error("--spacing: ({}), expected positive numbers", text(*options.spacing));
        if (options.spacing && !(grid.spacing[axis] * grid.vertices[axis] < kMost))
            throw Error("--spacing: {}, expected a volume of less than {:g} along each axis",
                        text(*options.spacing), kMost);
        if (options.origin && !(std::abs(grid.origin[axis]) < kMost))
            throw Error("--origin: {}, expected less than {:g}", text(*options.origin), kMost);
    }
}

std::array<std::uint32_t, 3> checked_vertices(const std::array<std::int64_t, 3>& sizes,
                                              const std::string& file) {
    const std::string got = fmt::format("{}x{}x{}", sizes[0], sizes[1], sizes[2]);
    if (std::any_of(sizes.begin(), sizes.end(), [](std::int64_t n) { return n < 2; }))
        throw Error("{}: {} vertices, needs at least 2 vertices per axis", file, got);
    std::uint64_t cells = 1;
    constexpr std::int64_t kMostAlong = 65537;
    constexpr std::uint64_t kMost =
        std::uint64_t{kMostAlong - 1} * (kMostAlong - 1) * (kMostAlong - 1);
    for (std::int64_t n : sizes) {
        const std::uint64_t along = static_cast<std::uint64_t>(n - 1);
        if (along > kMost / cells)
            throw Error("{}: {} vertices make too many cells, at most {} are supported", file, got,
                        kMost);
        cells *= along;
    }
    if (std::ranges::max(sizes) > kMostAlong)
        throw Error("{}: {} vertices, at most {} along an axis are supported", file, got,
                    kMostAlong);
    return {static_cast<std::uint32_t>(sizes[0]), static_cast<std::uint32_t>(sizes[1]),
            static_cast<std::uint32_t>(sizes[2])};
}

} // namespace isochron::index
