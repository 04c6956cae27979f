// Repairs all checksums of a modified index.
#include "tests/support/index_repair.h"

#include "index/error.h"
#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_table.h"
#include "index/file/detail_levels.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {
namespace {

class IndexRepair {
  public:
    explicit IndexRepair(std::span<std::byte> file) : file_(file) {}

    void run() {
        // Repair both slots, as the second one may be the valid one.
        for (std::uint64_t slot = 0; slot < kHeaderSlots; ++slot) {
            const std::uint64_t begin = slot * kHeaderBytes;
            if (!has(begin, kHeaderBytes))
                return;
            header_ = at<FileHeader>(begin);
            if (header_.magic != FileHeader{}.magic || slot_of(header_) != begin)
                continue;
            repair_further_arrays();
            repair_parts();
            for (Section& section : header_.sections)
                section.checksum = sum(section.offset, section.bytes);
            const HeaderSlot sealed = header_bytes(header_);
            std::memcpy(file_.data() + begin, sealed.data(), sealed.size());
        }
    }

  private:
    bool has(std::uint64_t offset, std::uint64_t bytes) const {
        return offset <= file_.size() && bytes <= file_.size() - offset;
    }
    template <class T>
    T at(std::uint64_t offset) const {
        T value{};
        if (has(offset, sizeof value))
            std::memcpy(&value, file_.data() + offset, sizeof value);
        return value;
    }
    void put(std::uint64_t offset, auto value) {
        if (has(offset, sizeof value))
            std::memcpy(file_.data() + offset, &value, sizeof value);
    }
    std::uint64_t sum(std::uint64_t offset, std::uint64_t bytes) const {
        return has(offset, bytes) ? checksum_of(file_.subspan(offset, bytes)) : 0;
    }

    std::optional<Metadata> metadata() const {
        const Section& section = header_.section(SectionKind::metadata);
        if (!has(section.offset, section.bytes))
            return std::nullopt;
        try {
            return metadata_from_json(
                {reinterpret_cast<const char*>(file_.data() + section.offset), section.bytes});
        } catch (const Error&) {
            return std::nullopt;
        }
    }

    /// Their checksums are hexadecimal digits in the metadata of the first array.
    void repair_further_arrays() {
        const auto known = metadata();
        const FileHeader first = header_;
        const Section& text = first.section(SectionKind::metadata);
        for (const ArrayPlace& place : known ? known->further : std::vector<ArrayPlace>()) {
            header_.sections = place.sections;
            repair_parts();
            for (const Section& section : place.sections) {
                const auto digits = [](std::uint64_t sum) { return fmt::format("{:016x}", sum); };
                const std::string_view all(
                    reinterpret_cast<const char*>(file_.data() + text.offset), text.bytes);
                const std::string now = digits(sum(section.offset, section.bytes));
                if (const auto at = all.find(digits(section.checksum)); at != all.npos)
                    std::memcpy(file_.data() + text.offset + at, now.data(), now.size());
            }
        }
        header_ = first;
    }

    void repair_parts() {
        const auto known = metadata();
        if (!known)
            return;
        const std::size_t steps = known->info.steps();
        const std::vector<Grid> grids = detail_grids(known->info.grid);
        const Section entries = header_.section(SectionKind::steps);
        for (std::uint64_t i = 0; i < std::min(entries.bytes, file_.size()) / sizeof(StepEntry);
             ++i)
            if (const Grid& grid = grids[i / steps % grids.size()];
                grid.vertex_count() / (kChunkEdge * kChunkEdge * kChunkEdge) < file_.size())
                repair_step(at<StepEntry>(entries.offset + i * sizeof(StepEntry)), ChunkGrid(grid));
        const Section unused = header_.section(SectionKind::directory);
        const std::uint64_t checksums =
            header_.section(SectionKind::checksums).offset + steps * sizeof(std::uint64_t);
        const std::uint64_t rows = std::min(unused.bytes, file_.size()) / sizeof(UnusedParts);
        for (std::uint64_t i = 0; i < rows; ++i) {
            const auto two = at<UnusedParts>(unused.offset + i * sizeof(UnusedParts));
            for (std::uint64_t n = 0; n < 2; ++n)
                put(checksums + 16 * i + 8 * n, sum(two.parts[n].offset, two.parts[n].bytes));
        }
    }

    void repair_step(const StepEntry& entry, const ChunkGrid& grid) {
        const std::uint64_t table_bytes = layer_table_bytes(grid.chunks_of_layer());
        std::uint64_t table = entry.offset + entry.tables;
        for (std::uint32_t layer = 0; layer < grid.layers(); ++layer, table += table_bytes) {
            std::uint64_t record = entry.offset + at<LayerHead>(table).records;
            for (std::uint32_t place = 0; place < grid.chunks_of_layer(); ++place) {
                const auto chunk =
                    at<ChunkEntry>(table + sizeof(LayerHead) + place * sizeof(ChunkEntry));
                if (chunk.bytes > sizeof(RecordChecksum) && has(record, chunk.bytes))
                    put(record,
                        static_cast<RecordChecksum>(sum(record + sizeof(RecordChecksum),
                                                        chunk.bytes - sizeof(RecordChecksum))));
                record += chunk.bytes;
            }
            put(table, sum(table + sizeof(std::uint64_t), table_bytes - sizeof(std::uint64_t)));
        }
        if (const std::uint64_t end = entry.offset + entry.bytes;
            end > table + 8 && has(table, end - table))
            put(table, sum(table + 8, end - table - 8));
    }

    std::span<std::byte> file_;
    FileHeader header_;
};

} // namespace

void repair_checksums(std::span<std::byte> file) {
    IndexRepair(file).run();
}

} // namespace isochron::index
