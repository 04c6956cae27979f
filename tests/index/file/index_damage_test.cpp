// Damage that checksums do not show, at every depth of the file: refused in one line, or harmless.
#include "index/error.h"
#include "index/indexing/index_build.h"
#include "index/search/cell_change.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "tests/support/index_repair.h"
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
    explicit DamagedIndex(std::string bytes) : bytes_(std::move(bytes)) {}

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }
    std::string& bytes() { return bytes_; }

    void repair() { repair_checksums(std::as_writable_bytes(std::span(bytes_))); }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        if (offset >= bytes_.size())
            return 0;
        const std::size_t count = std::min<std::size_t>(out.size(), bytes_.size() - offset);
        std::memcpy(out.data(), bytes_.data() + offset, count);
        return count;
    }

  private:
    std::string name_ = "damaged", bytes_;
};

/// Everything that reads the file.
void use(const std::shared_ptr<const IndexFile>& file) {
    ChangeSearch changes(file);
    for (std::uint32_t step = 0; step < file->info().steps(); ++step) {
        const double isovalue = step % 2 ? 128.0 : 100.5;
        for (const SearchMethod method : {SearchMethod::bricks, SearchMethod::scan})
            if (can_search(*file, method))
                search_in(file, method)({Instant(step), isovalue}, {});
        for (std::size_t level = 0; level < file->detail_levels(); ++level)
            search_level(file, level, {Instant(step), isovalue});
        changes({Instant(step), isovalue}, {Instant((step + 1) % 2), isovalue});
        if (file->color())
            file->load_color(step);
    }
}

class IndexDamage : public testing::TestWithParam<ValueType> {};

TEST_P(IndexDamage, WithMatchingChecksumsIsRefusedOrHarmless) {
    std::mt19937 random(test_seed());
    TestFolder folder;
    const TestField field({35, 18, 17}, 2, GetParam(), scaled(turbulence(random), 60, 128));
    const TestField heat({35, 18, 17}, 2, ValueType::i16, moving_sphere);
    MemorySeries series(field.view()), colors(heat.view());
    colors.info().array = "heat";
    build_index(series, folder.path() / "a", {.color = &colors});
    const std::string good = read_file(folder.path() / "a");
    const auto sound = IndexFile::open(folder.path() / "a");
    int refused = 0, usable = 0;
    const int rounds = tries(1500);
    for (int i = 0; i < rounds; ++i) {
        auto damaged = std::make_unique<DamagedIndex>(good);
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
    EXPECT_GT(refused, rounds / 10);
    EXPECT_GT(usable, rounds / 10);
}
INSTANTIATE_TEST_SUITE_P(Types, IndexDamage, testing::Values(ValueType::u8, ValueType::f32));

} // namespace
} // namespace isochron::index
