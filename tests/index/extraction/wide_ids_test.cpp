// Active cells of a step of 2^32 cells, of an index that is nowhere as a whole.
#include "index/build/index_build.h"
#include "index/error.h"
#include "index/extraction/index_search.h"
#include "index/extraction/layer_search.h"
#include "index/file/chunk_table.h"
#include "index/file/detail_levels.h"
#include "index/file/file_layout.h"
#include "index/file/metadata.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <set>
#include <string>

namespace isochron::index {
namespace {

using ChunkAt = std::array<std::uint32_t, 3>;

/// One u8 step of chunks that hold one value each: 200 in a few, 100 in all others.
class HugeIndex final : public ByteSource {
  public:
    HugeIndex(const Grid& grid, std::set<ChunkAt> high)
        : grid_(grid), chunks_(grid), high_(std::move(high)) {
        for (const bool reaches : {false, true})
            for (const bool is_high : {false, true})
                records_.push_back(record(reaches, is_high ? 200 : 100));
        add_tables();
        add_sections();
    }

    static std::uint8_t value(const std::set<ChunkAt>& high, std::uint32_t x, std::uint32_t y,
                              std::uint32_t z) {
        return high.contains({x / kChunkEdge, y / kChunkEdge, z / kChunkEdge}) ? 200 : 100;
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return tail_begin() + tail_.size(); }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        std::size_t done = 0;
        for (; done < out.size() && offset + done < size(); ++done)
            out[done] = at(offset + done);
        return done;
    }

  private:
    static constexpr std::size_t kRecord = sizeof(RecordChecksum) + sizeof(ChunkBricks) + 2;
    using Record = std::array<std::byte, kRecord>;

    std::uint64_t tail_begin() const { return kDataBegin + chunks_.count() * kRecord; }

    std::byte at(std::uint64_t offset) const {
        if (offset >= tail_begin())
            return tail_[offset - tail_begin()];
        if (offset < kHeaderBytes)
            return header_[offset];
        if (offset < kDataBegin)
            return std::byte{0};
        const std::uint64_t number = (offset - kDataBegin) / kRecord;
        const auto layer = static_cast<std::uint32_t>(number / chunks_.chunks_of_layer());
        const auto [x, y] =
            chunks_.at(static_cast<std::uint32_t>(number % chunks_.chunks_of_layer()));
        return records_[kind(x, y, layer)][(offset - kDataBegin) % kRecord];
    }

    /// Bit 0: its own value is the high one; bit 1: its cells reach both values, or may.
    std::size_t kind(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        bool reaches = false;
        for (unsigned d = 0; d < 8; ++d)
            reaches |= high_.contains({x + (d & 1), y + (d >> 1 & 1), z + (d >> 2)});
        return (reaches ? 2 : 0) + (high_.contains({x, y, z}) ? 1 : 0);
    }

    static Record record(bool reaches, std::uint8_t value) {
        ChunkBricks bricks;
        std::fill_n(bricks.begin(), kBricksOfChunk, reaches ? 100 : value);
        std::fill_n(bricks.begin() + kBricksOfChunk, kBricksOfChunk, reaches ? 200 : value);
        Record bytes{};
        std::memcpy(bytes.data() + sizeof(RecordChecksum), bricks.data(), bricks.size());
        bytes.back() = static_cast<std::byte>(value); // and before it the form of one value for all
        const RecordChecksum checksum =
            record_checksum(std::span(bytes).subspan(sizeof(RecordChecksum)));
        std::memcpy(bytes.data(), &checksum, sizeof checksum);
        return bytes;
    }

    void add_tables() {
        const std::uint32_t count = chunks_.chunks_of_layer();
        std::vector<std::byte> table(layer_table_bytes(count));
        for (std::uint32_t layer = 0; layer < chunks_.layers(); ++layer) {
            LayerHead head{0, std::uint64_t{layer} * count * kRecord};
            std::memcpy(table.data(), &head, sizeof head);
            for (std::uint32_t place = 0; place < count; ++place) {
                const auto [x, y] = chunks_.at(place);
                const std::size_t is = kind(x, y, layer);
                const auto own = static_cast<std::uint8_t>(is & 1 ? 200 : 100);
                const ChunkEntry entry{kRecord, is & 2 ? std::uint8_t{100} : own,
                                       is & 2 ? std::uint8_t{200} : own};
                std::memcpy(table.data() + sizeof head + place * sizeof entry, &entry,
                            sizeof entry);
            }
            head.checksum = checksum_of(std::span(table).subspan(sizeof head.checksum));
            std::memcpy(table.data(), &head, sizeof head);
            tail_.insert(tail_.end(), table.begin(), table.end());
        }
    }

    void add_sections() {
        Metadata metadata;
        metadata.info.array = "huge";
        metadata.info.grid = grid_;
        metadata.info.type = ValueType::u8;
        metadata.info.times = {0};
        metadata.info.sources = {"huge.raw"};
        metadata.plan.tiers = TierSet().with(Tier::bricks);
        ValueCounts counts;
        const std::array<std::uint8_t, 2> values{100, 200};
        counts.add(ValueType::u8, {}, std::as_bytes(std::span(values)));
        set_counts(metadata, counts);
        const std::uint64_t records = chunks_.count() * kRecord;
        std::vector<StepEntry> steps{{kDataBegin, records + tail_.size(), records}};
        const std::vector<Grid> grids = detail_grids(grid_);
        for (std::size_t level = 1; level < grids.size(); ++level) { // nobody looks at them
            const ChunkGrid coarse(grids[level]);
            steps.push_back(
                {kDataBegin, layer_table_bytes(coarse.chunks_of_layer()) * coarse.layers(), 0});
        }
        const std::array<std::uint64_t, 2> checksums{};
        const std::string text = to_json(metadata);
        FileHeader header;
        const auto add = [&](SectionKind kind, std::span<const std::byte> bytes) {
            tail_.resize(align_up(tail_begin() + tail_.size(), kPartAlignment) - tail_begin());
            header.section(kind) = {tail_begin() + tail_.size(), bytes.size(), checksum_of(bytes)};
            tail_.insert(tail_.end(), bytes.begin(), bytes.end());
        };
        add(SectionKind::tree, {});
        add(SectionKind::steps, std::as_bytes(std::span(steps)));
        add(SectionKind::directory, {});
        add(SectionKind::checksums, std::as_bytes(std::span(checksums)));
        add(SectionKind::metadata, std::as_bytes(std::span(text)));
        header.file_bytes = size();
        header_ = header_bytes(header);
    }

    Grid grid_;
    ChunkGrid chunks_;
    std::set<ChunkAt> high_;
    std::vector<Record> records_; ///< by kind
    std::vector<std::byte> tail_; ///< tables and sections
    HeaderSlot header_{};
    std::string name_ = "huge";
};

/// Cells about the chunks of the high value.
std::vector<std::uint64_t> active_slowly(const Grid& grid, const std::set<ChunkAt>& high) {
    const auto cells = grid.cells();
    std::set<std::uint64_t> active;
    for (const ChunkAt& chunk : high) {
        std::array<std::uint32_t, 3> first{}, end{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first[axis] = std::max(chunk[axis] * kChunkEdge, 1u) - 1;
            end[axis] = std::min((chunk[axis] + 1) * kChunkEdge, cells[axis]);
        }
        for (std::uint32_t z = first[2]; z < end[2]; ++z)
            for (std::uint32_t y = first[1]; y < end[1]; ++y)
                for (std::uint32_t x = first[0]; x < end[0]; ++x) {
                    unsigned above = 0;
                    for (unsigned d = 0; d < 8; ++d)
                        above += HugeIndex::value(high, x + (d & 1), y + (d >> 1 & 1),
                                                  z + (d >> 2)) > 150;
                    if (above > 0 && above < 8)
                        active.insert(std::uint64_t{x} +
                                      cells[0] * (y + std::uint64_t{cells[1]} * z));
                }
    }
    return {active.begin(), active.end()};
}

std::vector<std::uint64_t> wide_ids_of(const CellSet& set, const Grid& grid) {
    std::vector<std::uint64_t> ids;
    for (const CellPoint& point : set.points)
        ids.push_back(wide_id(grid, point.x, point.y, point.z));
    return ids;
}

TEST(WideIds, OfAStepOf2To32CellsAreAllFoundInTheirPlaces) {
    Grid grid;
    grid.vertices = {257, 257, 65537};
    ASSERT_TRUE(has_wide_ids(grid));
    const std::set<ChunkAt> high{{0, 0, 0},      {5, 7, 2047},  {5, 7, 2048},  {6, 7, 2048},
                                 {15, 15, 4095}, {16, 3, 4096}, {16, 16, 4090}};
    const auto file = IndexFile::open(std::make_unique<HugeIndex>(grid, high));
    const auto expected = active_slowly(grid, high);
    EXPECT_GT(expected.back(), 0xffff'0000u);
    const Query query{0, 150};
    const CellSetPtr found = search_in(file)(query, {});
    EXPECT_EQ(found->method, SearchMethod::bricks);
    EXPECT_EQ(wide_ids_of(*found, grid), expected);
    EXPECT_EQ(wide_ids_of(search_level(file, 0, query), grid), expected);
    EXPECT_TRUE(search_in(file)({0, 250}, {})->ids.empty());
}

TEST(WideIds, WhatTellsCellsApartBy32BitsRefusesThemBeforeAnythingIsRead) {
    test_support::TestFolder folder;
    StepValues values{.grid = {.vertices = {2048, 2048, 2048}},
                      .type = ValueType::u8,
                      .scaling = {},
                      .steps = 1,
                      .first = nullptr,
                      .stride = 0};
    MemorySeries series(values);
    series.before_read = [](std::size_t) { FAIL() << "read"; };
    const auto refusal = [&](const BuildOptions& options) -> std::string {
        try {
            build_index(series, folder.path() / "a.isochron", options);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    };
    const std::string cells = "t0.raw: 8577357823 cells, expected fewer than 2^32 for ";
    BuildOptions referring;
    referring.referral.emplace();
    EXPECT_EQ(refusal(referring), cells + "an index that refers to its sources");
    BuildOptions with_cells;
    with_cells.tiers = TierSet().with(Tier::bricks).with(Tier::cells);
    BuildOptions with_tree;
    with_tree.with_tree = true;
    EXPECT_EQ(refusal(with_tree), cells + "the tiers cells and tree");
    // Rows of 2047 cells are within what cells can index.
    EXPECT_EQ(refusal(with_cells), cells + "the tiers cells and tree");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WideIds, ReachBeyond32Bits) {
    Grid grid;
    grid.vertices = {2048, 2048, 2048};
    EXPECT_TRUE(has_wide_ids(grid));
    EXPECT_EQ(wide_id(grid, 2046, 2046, 2046), 2047ull * 2047 * 2047 - 1);
    grid.vertices = {65536, 65538, 2};
    EXPECT_EQ(grid.cell_count(), 65535ull * 65537);
    EXPECT_FALSE(has_wide_ids(grid)) << "2^32 - 1 cells";
}

} // namespace
} // namespace isochron::index
