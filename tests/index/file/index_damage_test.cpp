// Damage that no checksum tells, at every depth of the file: refused in one line, or harmless.
#include "index/build/index_build.h"
#include "index/error.h"
#include "index/extraction/cell_change.h"
#include "index/extraction/layer_search.h"
#include "index/file/chunk_table.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace isochron::index {
namespace {

/// An index in memory whose checksums can be made to match again.
class DamagedIndex final : public ByteSource {
  public:
    DamagedIndex(std::string bytes, const IndexFile& sound) : bytes_(std::move(bytes)) {
        std::memcpy(&header_, bytes_.data(), sizeof header_);
        for (std::size_t level = 0; level < sound.detail_levels(); ++level)
            grids_.push_back(sound.chunks(level).grid());
        steps_ = sound.info().steps();
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }
    std::string& bytes() { return bytes_; }

    void repair() {
        const Section entries = header_.section(SectionKind::steps);
        for (std::uint64_t i = 0; i * sizeof(StepEntry) < entries.bytes; ++i) {
            const auto entry = at<StepEntry>(entries.offset + i * sizeof(StepEntry));
            repair_step(entry, grids_[i / steps_ % grids_.size()]);
        }
        for (Section& section : header_.sections)
            section.checksum = sum(section.offset, section.bytes);
        const auto sealed = header_bytes(header_);
        std::memcpy(bytes_.data(), sealed.data(), sealed.size());
    }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        if (offset >= bytes_.size())
            return 0;
        const std::size_t count = std::min<std::size_t>(out.size(), bytes_.size() - offset);
        std::memcpy(out.data(), bytes_.data() + offset, count);
        return count;
    }

  private:
    bool has(std::uint64_t offset, std::uint64_t bytes) const {
        return offset <= bytes_.size() && bytes <= bytes_.size() - offset;
    }
    template <class T>
    T at(std::uint64_t offset) const {
        T value{};
        if (has(offset, sizeof value))
            std::memcpy(&value, bytes_.data() + offset, sizeof value);
        return value;
    }
    std::uint64_t sum(std::uint64_t offset, std::uint64_t bytes) const {
        return has(offset, bytes)
                   ? checksum_of(std::as_bytes(std::span(bytes_)).subspan(offset, bytes))
                   : 0;
    }
    void put(std::uint64_t offset, auto value) {
        if (has(offset, sizeof value))
            std::memcpy(bytes_.data() + offset, &value, sizeof value);
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

    std::string name_ = "damaged", bytes_;
    FileHeader header_;
    std::vector<ChunkGrid> grids_;
    std::size_t steps_ = 0;
};

/// Everything that reads the file.
void use(const std::shared_ptr<const IndexFile>& file) {
    ChangeSearch changes(file);
    for (std::uint32_t step = 0; step < file->info().steps(); ++step)
        for (const double isovalue : {100.5, 128.0}) {
            for (const SearchMethod method :
                 {SearchMethod::cells, SearchMethod::bricks, SearchMethod::scan})
                if (can_search(*file, method))
                    search_in(file, method)({step, isovalue}, {});
            for (std::size_t level = 0; level < file->detail_levels(); ++level)
                search_level(file, level, {step, isovalue});
            changes({step, isovalue}, {(step + 1) % 2, isovalue});
            if (file->color())
                file->load_color(step);
        }
}

TEST(IndexDamage, WithMatchingChecksumsIsRefusedOrHarmless) {
    std::mt19937 random(test_seed());
    TestFolder folder;
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({35, 18, 17}, 2, type, scaled(turbulence(random), 60, 128));
        const TestField heat({35, 18, 17}, 2, ValueType::i16, moving_sphere);
        MemorySeries series(field.view()), colors(heat.view());
        colors.info().array = "heat";
        build_index(series, folder.path() / "a", {.color = &colors});
        const std::string good = read_file(folder.path() / "a");
        const auto sound = IndexFile::open(folder.path() / "a");
        int refused = 0, usable = 0;
        for (int i = 0; i < 3000; ++i) {
            auto damaged = std::make_unique<DamagedIndex>(good, *sound);
            for (int hits = 1 + static_cast<int>(random() % 3); hits > 0; --hits) {
                // Half of the damage goes where little is: into the sections and the steps' ends.
                std::size_t at = kDataBegin + random() % (good.size() - kDataBegin);
                if (random() % 2) {
                    const StepEntry& step =
                        sound->step_entries()[random() % sound->step_entries().size()];
                    at = step.offset + step.tables + random() % (step.bytes - step.tables);
                }
                if (random() % 4 == 0) {
                    const Section& steps = sound->header().section(SectionKind::steps);
                    at = steps.offset + random() % steps.bytes;
                }
                damaged->bytes()[at] = random() % 2 ? char(random()) : char(0xff);
            }
            damaged->repair();
            try {
                use(IndexFile::open(std::move(damaged)));
                ++usable;
            } catch (const Error& error) {
                ++refused;
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            }
        }
        EXPECT_GT(refused, 100);
        EXPECT_GT(usable, 100);
    }
}

} // namespace
} // namespace isochron::index
