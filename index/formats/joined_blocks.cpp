// Puts blocks into one grid.
#include "index/formats/joined_blocks.h"

#include "index/error.h"
#include "index/formats/stored_file.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace isochron::index {
namespace {

struct Block {
    SeriesFile file;
    std::array<std::uint32_t, 3> vertices{};
    std::array<std::int64_t, 3> begin{}; ///< its first vertex in the whole grid
};

/// Calls `row` with the first vertex of each row of a block, in the whole and in the block.
template <class Row>
void each_row(const Block& block, const Grid& whole, const Row& row) {
    std::uint64_t within = 0;
    for (std::uint32_t z = 0; z < block.vertices[2]; ++z)
        for (std::uint32_t y = 0; y < block.vertices[1]; ++y, within += block.vertices[0])
            row(static_cast<std::uint64_t>(block.begin[0]) +
                    whole.vertices[0] * (static_cast<std::uint64_t>(block.begin[1]) + y +
                                         std::uint64_t{whole.vertices[1]} *
                                             (static_cast<std::uint64_t>(block.begin[2]) + z)),
                within);
}

class JoinedBlocks final : public VolumeFile {
  public:
    JoinedBlocks(std::vector<SeriesFile> parts, ReadOptions options)
        : options_(std::move(options)) {
        for (SeriesFile& part : parts)
            add(std::move(part));
        open_.reset();
        surround();
        expect_covered();
        info_.notes.push_back(fmt::format("put together from {} parts", blocks_.size()));
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return 1; }
    std::vector<std::filesystem::path> beside() const override {
        std::vector<std::filesystem::path> others;
        for (const Block& block : blocks_)
            others.push_back(block.file.path);
        return others;
    }

    void read(std::size_t, std::span<std::byte> out) override {
        const std::size_t size = size_of(info_.type);
        std::vector<std::byte> values;
        for (const Block& block : blocks_) {
            open(block.file);
            if (open_->info().grid.vertices != block.vertices || open_->info().type != info_.type)
                throw Error(fmt::format("{}: changed while it was read", block.file.path.string()));
            values.resize(open_->info().step_bytes());
            open_->read(0, values);
            each_row(block, info_.grid, [&](std::uint64_t to, std::uint64_t from) {
                std::memcpy(out.data() + to * size, values.data() + from * size,
                            block.vertices[0] * size);
            });
        }
        open_.reset();
    }

    void stream(std::size_t step, const TakePiece& take) override {
        std::vector<std::byte> whole(info_.step_bytes());
        read(step, whole);
        take(whole);
    }

  private:
    void open(const SeriesFile& file) {
        open_.reset(); // first, so that the next file can use the same reader
        open_ = file.open(file.path, options_);
    }

    void add(SeriesFile part) {
        open(part);
        const SeriesInfo& got = open_->info();
        const std::string name = part.path.string();
        if (open_->steps() != 1)
            throw Error(fmt::format("{}: {} steps, expected 1 of a part", name, open_->steps()));
        if (got.grid.rectilinear())
            throw Error(fmt::format("{}: its vertices are not even, expected parts of a regular "
                                    "grid",
                                    name));
        if (blocks_.empty())
            info_ = got;
        const SeriesInfo& first = info_;
        const auto near = [](const glm::dvec3& a, const glm::dvec3& b, double slack) {
            return std::abs(a.x - b.x) <= slack * std::abs(b.x) + 1e-12 &&
                   std::abs(a.y - b.y) <= slack * std::abs(b.y) + 1e-12 &&
                   std::abs(a.z - b.z) <= slack * std::abs(b.z) + 1e-12;
        };
        constexpr double kSlack = 1e-5;
        if (got.array != first.array || got.type != first.type || got.scaling != first.scaling ||
            !near(got.grid.spacing, first.grid.spacing, kSlack) ||
            got.grid.direction != first.grid.direction)
            throw Error(fmt::format("{}: another array, type, spacing or direction than {}", name,
                                    blocks_.front().file.path.string()));
        const glm::dvec3 way = glm::transpose(first.grid.direction) *
                               (got.grid.origin - first.grid.origin) / first.grid.spacing;
        Block block{std::move(part), got.grid.vertices, {}};
        constexpr double kOff = 1e-3, kMostAway = 1e6; // of a cell
        for (int axis = 0; axis < 3; ++axis) {
            const double at = std::round(way[axis]);
            if (!(std::abs(way[axis] - at) <= kOff) || !(std::abs(at) < kMostAway))
                throw Error(fmt::format("{}: begins {} cells from {} along axis {}, expected a "
                                        "whole number",
                                        name, way[axis], blocks_.front().file.path.string(), axis));
            block.begin[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(at);
        }
        blocks_.push_back(std::move(block));
    }

    /// Sets the whole grid.
    void surround() {
        std::array<std::int64_t, 3> sizes{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::int64_t begin = blocks_.front().begin[axis], end = begin;
            for (const Block& block : blocks_) {
                begin = std::min(begin, block.begin[axis]);
                end = std::max(end, block.begin[axis] + std::int64_t{block.vertices[axis]});
            }
            sizes[axis] = end - begin;
            const int i = static_cast<int>(axis);
            info_.grid.origin +=
                info_.grid.direction[i] * info_.grid.spacing[i] * static_cast<double>(begin);
            for (Block& block : blocks_)
                block.begin[axis] -= begin;
        }
        info_.grid.vertices = checked_vertices(sizes, blocks_.front().file.path.string());
    }

    void expect_covered() const {
        std::uint64_t given = 0;
        for (const Block& block : blocks_)
            given += std::uint64_t{block.vertices[0]} * block.vertices[1] * block.vertices[2];
        const std::uint64_t all = info_.grid.vertex_count();
        std::uint64_t covered = 0;
        if (given >= all) {
            std::vector<bool> seen(all);
            for (const Block& block : blocks_)
                each_row(block, info_.grid, [&](std::uint64_t to, std::uint64_t) {
                    for (std::uint64_t i = to; i < to + block.vertices[0]; ++i)
                        if (!seen[i]) {
                            seen[i] = true;
                            ++covered;
                        }
                });
        }
        if (covered != all)
            throw Error(fmt::format("{} and {} other parts: leave vertices of {} x {} x {} without "
                                    "values",
                                    blocks_.front().file.path.string(), blocks_.size() - 1,
                                    info_.grid.vertices[0], info_.grid.vertices[1],
                                    info_.grid.vertices[2]));
    }

    ReadOptions options_;
    std::vector<Block> blocks_;
    SeriesInfo info_;
    std::unique_ptr<VolumeFile> open_;
};

} // namespace

std::unique_ptr<VolumeFile> join_blocks(std::vector<SeriesFile> parts, const ReadOptions& options) {
    return std::make_unique<JoinedBlocks>(std::move(parts), options);
}

} // namespace isochron::index
