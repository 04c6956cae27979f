// What a search of a layer reads is announced before, when its candidates are read.
#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "index/search/cube_search.h"
#include "index/search/layer_search.h"
#include "index/search/step_slab.h"
#include "index/surface/cell_set.h"
#include "index/volume/stored_cut.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// A file that remembers what it has been asked for.
class WatchedSource final : public ByteSource {
  public:
    explicit WatchedSource(const std::filesystem::path& path)
        : bytes_(read_file(path)), announced_(bytes_.size()) {}

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }
    void expect(std::uint64_t offset, std::uint64_t bytes) const override {
        const std::lock_guard lock(mutex_);
        std::fill_n(announced_.begin() + static_cast<std::ptrdiff_t>(offset), bytes, true);
        announcements += bytes;
        ++requests;
    }
    void expect_each(std::span<const ByteRange> ranges) const override {
        {
            const std::lock_guard lock(mutex_);
            calls += ranges.empty() ? 0 : 1;
            pieces += ranges.size();
        }
        ByteSource::expect_each(ranges);
    }
    void fetch(std::uint64_t offset, std::uint64_t bytes, const std::stop_token&) const override {
        expect(offset, bytes);
    }
    void forget() const {
        const std::lock_guard lock(mutex_);
        std::fill(announced_.begin(), announced_.end(), false);
    }

    mutable std::uint64_t announcements = 0;         ///< bytes
    mutable std::uint32_t requests = 0;              ///< for these bytes
    mutable std::uint64_t calls = 0, pieces = 0;     ///< pieces that were asked for in these calls
    mutable std::uint64_t ends = 0;                  ///< bytes from here on are not watched
    mutable std::uint64_t read = 0, unannounced = 0; ///< bytes

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        const std::lock_guard lock(mutex_);
        ++calls;
        ++pieces;
        return take(offset, out);
    }
    void read_together(std::span<const RangeRead> reads,
                       std::span<std::size_t> got) const override {
        const std::lock_guard lock(mutex_);
        ++calls;
        pieces += reads.size();
        for (std::size_t i = 0; i < reads.size(); ++i)
            got[i] = take(reads[i].offset, reads[i].out);
    }

  private:
    std::size_t take(std::uint64_t offset, std::span<std::byte> out) const {
        std::memcpy(out.data(), bytes_.data() + offset, out.size());
        for (std::uint64_t i = offset; i < std::min(offset + out.size(), ends); ++i) {
            ++read;
            unannounced += announced_[i] ? 0 : 1;
        }
        return out.size();
    }

    std::string name_ = "watched.isochron", bytes_;
    mutable std::mutex mutex_; ///< guards all that is counted: other threads read ahead
    mutable std::vector<bool> announced_;
};

class LayerCandidatesTest : public testing::TestWithParam<bool> {};

TEST_P(LayerCandidatesTest, NothingIsReadThatWasNotAnnouncedWithTheCandidates) {
    const bool normals = GetParam();
    std::mt19937 random(test_seed());
    const test_support::TestFolder folder;
    const TestField field({83, 70, 67}, 1, ValueType::u8, scaled(turbulence(random), 60, 120));
    MemorySeries series(field.view());
    const auto path = folder.path() / "a.isochron";
    build_index(series, path, {.tiers = TierSet().with(Tier::bricks), .codec = Codec::none});
    auto made = std::make_unique<WatchedSource>(path);
    const WatchedSource& source = *made;
    const auto file = IndexFile::open(std::move(made), 1); // keeps nothing
    const ChunkStore& store = file->chunks();
    const std::uint32_t layers = StepSlab::layers(store.info().grid);
    const auto sorted = sorted_values(field.view());
    for (const double isovalue : {sorted[sorted.size() / 200] + 0.5, quantiles(sorted, 3)[1]}) {
        const auto cut = *store.levels(0)->cut(store.info().scaling, isovalue);
        std::uint64_t found = 0, wanted = BruteForce(field.view(), 0).active(isovalue).size();
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
            source.ends = store.layer(0, store.grid().layers() - 1)->offsets.back();
            source.forget();
            for (std::uint32_t near = layer - std::min(layer, 1u);
                 near < std::min(layer + 2, store.grid().layers()); ++near)
                store.fetch(0, near, LayerCandidates::places_of(*store.layer(0, near), cut), {});
            const StepView step = step_in_chunks(*file, Instant(0));
            const LayerCandidates candidates(step, layer, cut, normals, {});
            const std::uint64_t announced = source.announcements;
            source.unannounced = 0;
            CellSet set;
            std::chrono::nanoseconds shading{0};
            const auto divided = *stored_cut(store.info().type, store.info().scaling, isovalue);
            CubeSearch().search(step, candidates, {Instant(0), isovalue}, divided, normals, {}, set,
                                shading);
            found += set.ids.size();
            EXPECT_EQ(set.points.size(), normals ? set.ids.size() : 0);
            EXPECT_EQ(source.unannounced, 0u)
                << "of " << source.read << " bytes so far, in layer " << layer;
            EXPECT_EQ(source.announcements, announced) << "announced twice";
        }
        EXPECT_EQ(found, wanted);
        EXPECT_GT(source.read, 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutNormals, LayerCandidatesTest, testing::Bool());

TEST(LayersOfAStep, AreReadInOneGoEachWhereMostOfThemIsNeeded) {
    std::mt19937 random(test_seed());
    const test_support::TestFolder folder;
    const auto path = folder.path() / "a.isochron";
    // Number of requests where they are for all bytes of all layers, else 0.
    const auto fetched = [&](const TestField& field, double isovalue) {
        MemorySeries series(field.view());
        build_index(series, path, {.tiers = TierSet().with(Tier::bricks), .codec = Codec::none});
        auto made = std::make_unique<WatchedSource>(path);
        const WatchedSource& source = *made;
        const auto file = IndexFile::open(std::move(made), 1);
        const ChunkStore& store = file->chunks();
        const auto cut = *store.levels(0)->cut(store.info().scaling, isovalue);
        std::uint64_t bytes = 0;
        for (std::uint32_t layer = 0; layer < StepSlab::layers(store.info().grid); ++layer)
            bytes +=
                store.fetch(0, layer, LayerCandidates::places_of(*store.layer(0, layer), cut), {});
        EXPECT_EQ(source.announcements, bytes);
        std::uint64_t whole = 0;
        for (std::uint32_t layer = 0; layer < StepSlab::layers(store.info().grid); ++layer)
            whole += store.layer(0, layer)->offsets.back() - store.layer(0, layer)->offsets.front();
        const std::uint32_t in_one_go = bytes == whole ? source.requests : 0;
        CellSet set;
        set.query = {Instant(0), isovalue};
        EXPECT_TRUE(
            LayerSearch(file).search(step_in_chunks(*file, Instant(0)), set, true, true, {}));
        EXPECT_EQ(set.ids, BruteForce(field.view(), 0).active(isovalue));
        return in_one_go;
    };
    const TestField rough({83, 70, 67}, 1, ValueType::u8, scaled(turbulence(random), 60, 120));
    EXPECT_EQ(fetched(rough, quantiles(sorted_values(rough.view()), 3)[1]), 5u);
    const TestField corner(
        {83, 70, 67}, 1, ValueType::u8,
        [](double x, double y, double z, double) { return x < 20 && y < 20 ? 10 + z : 0.0; });
    EXPECT_EQ(fetched(corner, 5.5), 0u);
}

TEST(LayersOfAStep, AreAskedForInFewCallsWhereTheirCandidatesLieApart) {
    const test_support::TestFolder folder;
    const auto path = folder.path() / "a.isochron";
    const TestField field({400, 400, 20}, 1, ValueType::f32,
                          [](double x, double y, double z, double) {
                              const double dx = std::fmod(x, 57) - 20, dy = std::fmod(y, 57) - 20;
                              return dx * dx + dy * dy + (z - 10) * (z - 10) < 8 ? 200.0 : 10.0;
                          });
    MemorySeries series(field.view());
    build_index(series, path, {.tiers = TierSet().with(Tier::bricks), .codec = Codec::none});
    auto made = std::make_unique<WatchedSource>(path);
    const WatchedSource& source = *made;
    const auto file = IndexFile::open(std::move(made));
    source.calls = source.pieces = 0;
    CellSet set;
    set.query = {Instant(0), 100};
    EXPECT_TRUE(LayerSearch(file).search(step_in_chunks(*file, Instant(0)), set, true, true, {}));
    EXPECT_EQ(set.ids, BruteForce(field.view(), 0).active(100));
    EXPECT_GT(source.pieces, 100u);
    EXPECT_LT(4 * source.calls, source.pieces) << source.calls << " calls";
}

TEST(PreparedCandidates, AreReadOnceByWhoeverComesFirst) {
    std::array<std::atomic<int>, 50> reads{};
    PreparedCandidates prepared(reads.size(), [&](std::uint32_t layer) {
        ++reads[layer];
        return LayerCandidates();
    });
    {
        std::jthread other([&] {
            for (std::uint32_t layer = 0; layer < reads.size(); ++layer)
                prepared.prepare(layer);
        });
        for (std::uint32_t layer = 0; layer < reads.size(); ++layer)
            prepared.take(layer);
    }
    for (const auto& count : reads)
        EXPECT_EQ(count, 1);
}

} // namespace
} // namespace isochron::index
