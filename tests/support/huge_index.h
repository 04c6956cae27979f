// An index of a step of any size, whose bytes are computed when they are read.
#pragma once

#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_table.h"
#include "index/file/detail_levels.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/metadata.h"
#include "index/system/byte_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace isochron::index {

using ChunkAt = std::array<std::uint32_t, 3>;

/// One u8 step of chunks that hold one value each: 200 in a few, 100 in all others. Its levels of
/// detail hold 100 alone.
class HugeIndex final : public ByteSource {
  public:
    HugeIndex(const Grid& grid, std::set<ChunkAt> high)
        : grid_(grid), chunks_(grid), grids_(detail_grids(grid)), high_(std::move(high)) {
        for (const bool reaches : {false, true})
            for (const bool is_high : {false, true})
                records_.push_back(record(reaches, is_high ? 200 : 100));
        for (const Grid& each : grids_) {
            begins_.push_back(records_end_);
            records_end_ += align_up(ChunkGrid(each).count() * kRecord, kPartAlignment);
        }
        add_sections(tables());
    }

    static std::uint8_t value(const std::set<ChunkAt>& high, std::uint32_t x, std::uint32_t y,
                              std::uint32_t z) {
        return high.contains({x / kChunkEdge, y / kChunkEdge, z / kChunkEdge}) ? 200 : 100;
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return tail_begin() + tail_.size(); }

    /// Writes a file without the records, which are holes: it opens, but cannot be searched.
    void write_without_records(const std::filesystem::path& path) const {
        std::ofstream out(path, std::ios::binary);
        out.write(reinterpret_cast<const char*>(header_.data()),
                  static_cast<std::streamsize>(header_.size()));
        out.seekp(static_cast<std::streamoff>(tail_begin()));
        out.write(reinterpret_cast<const char*>(tail_.data()),
                  static_cast<std::streamsize>(tail_.size()));
    }

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

    std::uint64_t tail_begin() const { return records_end_; }

    std::byte at(std::uint64_t offset) const {
        if (offset >= tail_begin())
            return tail_[offset - tail_begin()];
        if (offset < kHeaderBytes)
            return header_[offset];
        if (offset < kDataBegin)
            return std::byte{0};
        const std::uint64_t begin = *std::prev(std::ranges::upper_bound(begins_, offset));
        if (begin > kDataBegin) // the bytes of a level
            return records_[0][(offset - begin) % kRecord];
        const std::uint64_t number = (offset - kDataBegin) / kRecord;
        if (number >= chunks_.count())
            return std::byte{0};
        const auto layer = static_cast<std::uint32_t>(number / chunks_.chunks_of_layer());
        const auto [x, y] =
            chunks_.at(static_cast<std::uint32_t>(number % chunks_.chunks_of_layer()));
        return records_[kind(x, y, layer)][(offset - kDataBegin) % kRecord];
    }

    /// Bit 0: the chunk has the high value; bit 1: its cells may have vertices of both values.
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
        bytes.back() = static_cast<std::byte>(value); // after the byte for `one value for all`
        const RecordChecksum checksum =
            record_checksum(std::span(bytes).subspan(sizeof(RecordChecksum)));
        std::memcpy(bytes.data(), &checksum, sizeof checksum);
        return bytes;
    }

    /// Adds the tables of all levels. @return where they are
    std::vector<StepEntry> tables() {
        std::vector<StepEntry> levels;
        for (std::size_t level = 0; level < grids_.size(); ++level) {
            const std::uint64_t begin = begins_[level], before = size() - begin;
            add_tables(ChunkGrid(grids_[level]), level == 0);
            levels.push_back({begin, size() - begin, before});
        }
        return levels;
    }

    void add_tables(const ChunkGrid& chunks, bool of_volume) {
        const std::uint32_t count = chunks.chunks_of_layer();
        std::vector<std::byte> table(layer_table_bytes(count));
        for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer) {
            LayerHead head{0, std::uint64_t{layer} * count * kRecord};
            std::memcpy(table.data(), &head, sizeof head);
            for (std::uint32_t place = 0; place < count; ++place) {
                const auto [x, y] = chunks.at(place);
                const std::size_t is = of_volume ? kind(x, y, layer) : 0;
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

    void add_sections(const std::vector<StepEntry>& steps) {
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
    std::vector<Grid> grids_; ///< grids of all levels
    std::set<ChunkAt> high_;
    std::vector<Record> records_; ///< by kind
    /// Where the records of each level begin; they are all of one kind but for level 0.
    std::vector<std::uint64_t> begins_;
    std::uint64_t records_end_ = kDataBegin;
    std::vector<std::byte> tail_; ///< tables and sections
    HeaderSlot header_{};
    std::string name_ = "huge";
};

} // namespace isochron::index
