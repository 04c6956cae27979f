// Takes the vertices of a part out of the stream of all.
#include "index/readers/formats/cropped_file.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

/// Thrown to end a stream of which all is taken.
struct PartIsTaken {};

class CroppedFile final : public VolumeFile {
  public:
    CroppedFile(std::unique_ptr<VolumeFile> whole, const VolumePart& part)
        : whole_(std::move(whole)), part_(part), info_(whole_->info()) {
        const Grid& all = whole_->info().grid;
        info_.grid = grid_of_part(all, part_);
        info_.notes.push_back(note_on_part(all, part_));
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return whole_->steps(); }
    std::vector<std::filesystem::path> beside() const override { return whole_->beside(); }

    void read(std::size_t step, std::span<std::byte> out) override {
        std::size_t at = 0;
        stream(step, [&](std::span<const std::byte> piece) {
            std::memcpy(&out[at], piece.data(), piece.size());
            at += piece.size();
        });
    }

    // Row by row: pieces end anywhere between values.
    void stream(std::size_t step, const TakePiece& take) override {
        if (whole_->reads_anywhere())
            return stream_rows(step, take);
        const auto& all = whole_->info().grid.vertices;
        const std::size_t size = size_of(info_.type), row = std::size_t{all[0]} * size;
        const std::uint64_t end =
            (std::uint64_t{part_.last[2]} * all[1] + part_.last[1] + 1) * row; // last byte needed
        std::vector<std::byte> rest, slice;
        std::uint64_t number = 0; // number of the row that begins in `rest`
        std::uint64_t seen = 0;
        try {
            whole_->stream(step, [&](std::span<const std::byte> piece) {
                seen += piece.size();
                const auto take_row = [&](std::span<const std::byte> values) {
                    add_row(number++, values, slice, take);
                };
                if (!rest.empty()) {
                    const std::size_t missing = std::min(row - rest.size(), piece.size());
                    rest.insert(rest.end(), piece.begin(),
                                piece.begin() + static_cast<std::ptrdiff_t>(missing));
                    piece = piece.subspan(missing);
                    if (rest.size() == row) {
                        take_row(rest);
                        rest.clear();
                    }
                }
                for (; piece.size() >= row; piece = piece.subspan(row))
                    take_row(piece.first(row));
                rest.insert(rest.end(), piece.begin(), piece.end());
                if (seen >= end)
                    throw PartIsTaken();
            });
        } catch (const PartIsTaken&) {
        }
    }

  private:
    /// Reads the rows of the part alone, and of them no more than the part's columns.
    void stream_rows(std::size_t step, const TakePiece& take) {
        const auto& all = whole_->info().grid.vertices;
        const std::size_t size = size_of(info_.type), first = part_.first[0];
        std::vector<std::byte> row(std::size_t{all[0]} * size), slice;
        const std::size_t columns = part_.last[0] - first + 1;
        for (std::uint64_t z = part_.first[2]; z <= part_.last[2]; z += part_.stride[2])
            for (std::uint64_t y = part_.first[1]; y <= part_.last[1]; y += part_.stride[1]) {
                const std::uint64_t number = z * all[1] + y;
                whole_->read_at(step, number * all[0] + first,
                                std::span(row).subspan(first * size, columns * size));
                add_row(number, row, slice, take);
            }
    }

    bool holds(std::size_t axis, std::uint64_t vertex) const {
        return vertex >= part_.first[axis] && vertex <= part_.last[axis] &&
               (vertex - part_.first[axis]) % part_.stride[axis] == 0;
    }

    /// Passes a slice on when its last row is there.
    void add_row(std::uint64_t number, std::span<const std::byte> values,
                 std::vector<std::byte>& slice, const TakePiece& take) const {
        const std::uint32_t rows = whole_->info().grid.vertices[1];
        const std::uint64_t y = number % rows, z = number / rows;
        if (!holds(1, y) || !holds(2, z))
            return;
        const std::size_t size = size_of(info_.type);
        for (std::uint32_t x = 0; x < part_.count[0]; ++x) {
            const auto value =
                values.subspan((part_.first[0] + std::size_t{x} * part_.stride[0]) * size, size);
            slice.insert(slice.end(), value.begin(), value.end());
        }
        if (slice.size() < std::size_t{part_.count[0]} * part_.count[1] * size)
            return;
        take(slice);
        slice.clear();
    }

    std::unique_ptr<VolumeFile> whole_;
    VolumePart part_;
    SeriesInfo info_;
};

} // namespace

VolumePart part_in(const Grid& grid, const ReadOptions& options, const std::string& file) {
    VolumePart part;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t all = grid.vertices[axis];
        part.last[axis] = all - 1;
        if (options.crop) {
            const auto [first, last] = (*options.crop)[axis];
            if (first > last || last >= all)
                throw Error("{}: --crop {}:{} along {}, expected vertices of 0:{}", file, first,
                            last, "xyz"[axis], all - 1);
            part.first[axis] = first;
            part.last[axis] = last;
        }
        if (options.stride)
            part.stride[axis] = (*options.stride)[axis];
        if (part.stride[axis] == 0)
            throw Error("{}: --stride 0, expected 1 or more", file);
        part.count[axis] = (part.last[axis] - part.first[axis]) / part.stride[axis] + 1;
        if (part.count[axis] < 2)
            throw Error("{}: {}:{} along {} with every {}th vertex leaves {}, expected at least 2",
                        file, part.first[axis], part.last[axis], "xyz"[axis], part.stride[axis],
                        part.count[axis]);
    }
    return part;
}

Grid grid_of_part(const Grid& whole, const VolumePart& part) {
    Grid grid = whole;
    grid.origin = whole.physical({part.first[0], part.first[1], part.first[2]});
    grid.vertices = part.count;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if (whole.positions[i].even()) {
            grid.spacing[axis] = whole.spacing[axis] * part.stride[i];
            continue;
        }
        std::vector<double> distances;
        const double begin = whole.distance(axis, part.first[i]);
        for (std::uint32_t vertex = 0; vertex < part.count[i]; ++vertex)
            distances.push_back(whole.distance(axis, part.first[i] + vertex * part.stride[i]) -
                                begin);
        grid.spacing[axis] = distances.back() / (part.count[i] - 1);
        grid.positions[i] = AxisPositions(std::move(distances));
    }
    return grid;
}

std::string note_on_part(const Grid& whole, const VolumePart& part) {
    const auto range = [&](std::size_t axis) {
        return fmt::format("{}:{}", part.first[axis], part.last[axis]);
    };
    std::string stride;
    if (part.stride != std::array<std::uint32_t, 3>{1, 1, 1})
        stride = fmt::format(", stride {},{},{}", part.stride[0], part.stride[1], part.stride[2]);
    const Grid grid = grid_of_part(whole, part);
    return fmt::format("vertices {},{},{}{} of {} x {} x {}: {} x {} x {} from ({:g} {:g} {:g}), "
                       "{:g} {:g} {:g} apart; ids of cells count within them",
                       range(0), range(1), range(2), stride, whole.vertices[0], whole.vertices[1],
                       whole.vertices[2], part.count[0], part.count[1], part.count[2],
                       grid.origin.x, grid.origin.y, grid.origin.z, grid.spacing.x, grid.spacing.y,
                       grid.spacing.z);
}

void take_part(std::span<const std::byte> all, const Grid& whole, const VolumePart& part,
               std::size_t size, std::span<std::byte> out) {
    std::byte* to = out.data();
    for (std::uint32_t z = 0; z < part.count[2]; ++z)
        for (std::uint32_t y = 0; y < part.count[1]; ++y)
            for (std::uint32_t x = 0; x < part.count[0]; ++x, to += size) {
                const std::size_t row =
                    part.first[1] + y * part.stride[1] +
                    std::size_t{whole.vertices[1]} * (part.first[2] + z * part.stride[2]);
                std::memcpy(
                    to, &all[(row * whole.vertices[0] + part.first[0] + x * part.stride[0]) * size],
                    size);
            }
}

std::optional<VolumePart> crop_description(SeriesInfo& info, const ReadOptions& options,
                                           const std::string& file) {
    if (!options.crop)
        return std::nullopt;
    ReadOptions alone;
    alone.crop = options.crop;
    const VolumePart part = part_in(info.grid, alone, file);
    info.notes.push_back(note_on_part(info.grid, part));
    info.grid = grid_of_part(info.grid, part);
    return part;
}

std::unique_ptr<VolumeFile> cropped(std::unique_ptr<VolumeFile> whole, const ReadOptions& options,
                                    const std::filesystem::path& path) {
    if (!options.crop && !options.stride)
        return whole;
    const VolumePart part = part_in(whole->info().grid, options, path.string());
    return std::make_unique<CroppedFile>(std::move(whole), part);
}

} // namespace isochron::index
