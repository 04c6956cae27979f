// A step of which most is needed is read once, in order, and gives the cells of any other search.
#include "index/error.h"
#include "index/file/chunks/record_stream.h"
#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "index/scan/bricks.h"
#include "index/search/id_sort.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/search/whole_layers.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <random>

namespace isochron::index {
namespace {

constexpr std::uint64_t kRoom = std::uint64_t{1} << 30;

/// A file that counts how often each byte is read, and does something at each read.
class CountedSource final : public ByteSource {
  public:
    explicit CountedSource(const std::filesystem::path& path)
        : bytes_(read_file(path)), reads(bytes_.size()), announced(bytes_.size()) {}

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }

  private:
    std::string name_ = "counted.isochron", bytes_;

  public:
    void expect(std::uint64_t offset, std::uint64_t bytes) const override {
        count(announced, offset, bytes);
    }

    mutable std::vector<std::uint8_t> reads, announced; ///< read when no search runs
    mutable std::atomic<int> requests{0};
    std::function<void(int request)> at_read;

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        if (const int request = ++requests; at_read)
            at_read(request);
        std::memcpy(out.data(), bytes_.data() + offset, out.size());
        count(reads, offset, out.size());
        return out.size();
    }

  private:
    /// Under one lock, as an atomic count for each byte costs a sanitizer some hundred bytes.
    void count(std::vector<std::uint8_t>& counts, std::uint64_t offset, std::uint64_t bytes) const {
        const std::lock_guard lock(mutex_);
        for (std::uint64_t i = offset; i < offset + bytes; ++i)
            ++counts[i];
    }

    mutable std::mutex mutex_;
};

class WholeLayersTest : public testing::Test {
  protected:
    void index(const TestField& field) {
        MemorySeries series(field.view());
        build_index(series, path_, {.tiers = TierSet().with(Tier::bricks)});
        auto made = std::make_unique<CountedSource>(path_);
        source_ = made.get();
        file_ = IndexFile::open(std::move(made));
    }
    std::optional<LevelMap::Cut> cut(std::uint32_t step, double isovalue) const {
        return file_->chunks().levels(step)->cut(file_->info().scaling, isovalue);
    }
    std::optional<WholeLayers::Range> worth(double isovalue, std::uint64_t room = kRoom) const {
        const auto at = cut(0, isovalue);
        return at ? WholeLayers::worth(step(), *at, 2, room) : std::nullopt;
    }

    StepView step() const { return step_in_chunks(*file_, Instant(0)); }
    bool search(CellSet& set, const std::stop_token& stop = {}) const {
        return LayerSearch(file_).search(step(), set, true, true, stop);
    }

    std::mt19937 random_{test_seed()};
    test_support::TestFolder folder_;
    std::filesystem::path path_ = folder_.path() / "a.isochron";
    CountedSource* source_ = nullptr; ///< source of the file
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(WholeLayersTest, GiveTheCellsAndPlanesOfAWholeStepForEveryTypeAndGrid) {
    for (const auto& vertices : std::array<std::array<std::uint32_t, 3>, 6>{
             {{5, 4, 3}, {16, 16, 16}, {17, 17, 17}, {37, 23, 50}, {35, 70, 97}, {20, 3, 130}}})
        for (const ValueType type : kAllTypes) {
            const TestField field(vertices, 2, type, scaled(white_noise(random_), 100, 10),
                                  {random_() % 2 ? -0.5 : 2.0, 1.0});
            index(field);
            const double isovalue = quantiles(sorted_values(field.view()), 3)[1];
            CellSet found, wanted;
            found.query = wanted.query = {Instant(0), isovalue};
            wanted.ids = BruteForce(field.view(), 0).active(isovalue);
            ASSERT_EQ(!worth(isovalue), wanted.ids.empty());
            const std::uint64_t before = file_->reading().held;
            ASSERT_TRUE(search(found));
            EXPECT_LT(file_->reading().held - before, std::uint64_t{4096})
                << "chunks have been kept";
            shade_cells(field.view(), wanted);
            ASSERT_EQ(found.ids, wanted.ids) << name_of(type) << " " << vertices[2];
            ASSERT_EQ(found.points.size(), wanted.points.size());
            for (std::size_t i = 0; i < found.points.size(); ++i) {
                const CellPoint &p = found.points[i], &q = wanted.points[i];
                ASSERT_TRUE(p.x == q.x && p.y == q.y && p.z == q.z && p.plane == q.plane) << i;
            }
            ASSERT_EQ(found.rows.size(), wanted.rows.size());
            for (std::size_t i = 0; i < found.rows.size(); ++i)
                ASSERT_TRUE(found.rows[i].y == wanted.rows[i].y &&
                            found.rows[i].z == wanted.rows[i].z &&
                            found.rows[i].begin == wanted.rows[i].begin);
        }
}

TEST_F(WholeLayersTest, AreReadOnceAndOnlyTheFirstTimeThatAStepIsLookedAt) {
    const TestField field({60, 60, 90}, 1, ValueType::u8, scaled(white_noise(random_), 100, 128));
    index(field);
    CellSet set;
    set.query = {Instant(0), 128.5};
    ASSERT_TRUE(worth(128.5));
    for (auto& reads : source_->reads)
        reads = 0;
    ASSERT_TRUE(search(set));
    const ChunkStore& store = file_->chunks();
    for (std::uint64_t i = store.layer(0, 0)->offsets.front();
         i < store.layer(0, 5)->offsets.back(); ++i)
        ASSERT_EQ(source_->reads[i], 1) << i;
    store.worked_on(0);
    ASSERT_TRUE(search(set));
    EXPECT_GT(file_->reading().held, field.view().grid.vertex_count()) << "chunks are kept";
    EXPECT_EQ(set.ids, BruteForce(field.view(), 0).active(128.5));
}

TEST_F(WholeLayersTest, AreAnnouncedOnceEachAndNothingBehindTheirStep) {
    // With a step behind it.
    const TestField field({150, 150, 260}, 2, ValueType::u16,
                          scaled(white_noise(random_), 10'000, 30'000));
    index(field);
    CellSet set;
    set.query = {Instant(0), 30'000.5};
    ASSERT_TRUE(worth(30'000.5));
    const ChunkStore& store = file_->chunks();
    const std::uint32_t layers = store.grid().layers();
    const std::uint64_t first = store.layer(0, 0)->offsets.front(),
                        end = store.layer(0, layers - 1)->offsets.back();
    ASSERT_GT(end - first, std::uint64_t{9} << 20);
    for (auto* counts : {&source_->reads, &source_->announced})
        for (auto& count : *counts)
            count = 0;
    ASSERT_TRUE(search(set));
    for (std::uint64_t i = 0; i < source_->size(); ++i) {
        const int once = i >= first && i < end ? 1 : 0;
        ASSERT_EQ(source_->announced[i], once) << i << " of " << first << " to " << end;
        ASSERT_EQ(source_->reads[i], once) << i;
    }
}

TEST_F(WholeLayersTest, OfASmallStepComeInOneRequestWithItsTablesAndLevels) {
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({60, 50, 40}, 3, type, scaled(white_noise(random_), 100, 128));
        index(field);
        for (const std::uint32_t step : {1u, 0u, 2u}) {
            source_->requests = 0;
            const CellSetPtr found =
                search_in(file_, {}, Shading::cells)({Instant(step), 128.5}, {});
            EXPECT_EQ(source_->requests, 1) << name_of(type);
            EXPECT_EQ(found->ids, BruteForce(field.view(), step).active(128.5));
        }
    }
}

TEST_F(WholeLayersTest, AreOnlyTakenWhereMostIsNeededAndThereIsRoom) {
    const TestField noise({60, 60, 90}, 1, ValueType::u8, scaled(white_noise(random_), 100, 128));
    index(noise);
    const auto all = worth(128.5);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->first, 0u);
    EXPECT_EQ(all->end, 6u);
    EXPECT_FALSE(worth(128.5, 9 * StepSlab::bytes(step().grid(), step().type())));
    EXPECT_TRUE(worth(128.5, 10 * StepSlab::bytes(step().grid(), step().type())));
    EXPECT_FALSE(worth(20.5)) << "no cell is active";
    index(TestField({130, 20, 90}, 1, ValueType::u8, [](double x, double, double z, double) {
        return x < 8 || z < 40 ? 10.0 : x + 100;
    }));
    EXPECT_FALSE(worth(90.5)) << "a ninth is needed of all layers but one";
    index(TestField({60, 60, 90}, 1, ValueType::u8, [](double x, double y, double z, double) {
        return z < 40 || z > 70 ? 10.0 : std::fmod(7 * x + 5 * y + z, 13) * 10;
    }));
    const auto some = worth(60.5);
    ASSERT_TRUE(some);
    EXPECT_EQ(some->first, 2u);
    EXPECT_EQ(some->end, 5u);
}

TEST_F(WholeLayersTest, AreWorkedOnOnceEachByAnyNumberOfThreads) {
    const TestField field({24, 24, 300}, 1, ValueType::u8, scaled(white_noise(random_), 100, 128));
    index(field);
    const auto wanted = BruteForce(field.view(), 0).active(128.5);
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        std::mutex mutex;
        std::map<std::uint32_t, std::vector<CellId>> of_layer;
        const StepView whole = step();
        WholeLayers layers(whole, *worth(128.5), *cut(0, 128.5), threads);
        EXPECT_TRUE(layers.for_each(
            [&](StepSlab& slab, std::uint32_t layer, std::chrono::nanoseconds) {
                std::vector<CellId> ids;
                test_bricks(slab.cells(), *file_->chunks().levels(0), slab.bricks(),
                            {Instant(0), 128.5}, ids);
                sort_ids(ids, slab.cells().grid.cell_count());
                for (CellId& id : ids)
                    id += slab.first_cell();
                const std::scoped_lock lock(mutex);
                EXPECT_TRUE(of_layer.emplace(layer, std::move(ids)).second);
            },
            {}));
        EXPECT_EQ(of_layer.size(), 19u);
        std::vector<CellId> found;
        for (const auto& [layer, ids] : of_layer)
            found.insert(found.end(), ids.begin(), ids.end());
        EXPECT_EQ(found, wanted) << threads;
    }
}

TEST_F(WholeLayersTest, EndWhenTheyAreStoppedAtAnyReadOrTheFileFails) {
    const TestField field({60, 60, 200}, 1, ValueType::f32, white_noise(random_));
    index(field);
    ASSERT_TRUE(worth(0.1));
    source_->requests = 0;
    const auto wanted = BruteForce(field.view(), 0).active(0.1);
    const auto search = [&](const std::stop_token& stop) {
        CellSet set;
        set.query = {Instant(0), 0.1};
        source_->requests = 0;
        const bool finished = this->search(set, stop);
        if (finished) {
            EXPECT_EQ(set.ids, wanted);
        }
        return finished;
    };
    EXPECT_TRUE(search({}));
    const int requests = source_->requests;
    ASSERT_GT(requests, 10);
    for (int at = 1; at <= requests; at += 1 + at / 4) {
        std::stop_source stop;
        source_->at_read = [&](int request) {
            if (request == at)
                stop.request_stop();
        };
        EXPECT_FALSE(search(stop.get_token())) << at;
        source_->at_read = [&](int request) {
            if (request == at)
                throw Error("counted.isochron: cannot be read");
        };
        EXPECT_THROW(search({}), Error) << at;
        source_->at_read = {};
    }
    EXPECT_TRUE(search({}));
    const StepView whole = step();
    WholeLayers layers(whole, *worth(0.1), *cut(0, 0.1), 3);
    EXPECT_THROW(layers.for_each(
                     [](StepSlab&, std::uint32_t layer, std::chrono::nanoseconds) {
                         if (layer == 4)
                             throw Error("the work fails");
                     },
                     {}),
                 Error);
}

TEST_F(WholeLayersTest, ADamagedChunkIsOneLine) {
    const TestField field({60, 60, 60}, 1, ValueType::u8, scaled(white_noise(random_), 100, 128));
    index(field);
    std::string bytes = read_file(path_);
    bytes[file_->chunks().layer(0, 2)->offsets[5] + 100] ^= 1;
    const auto damaged = folder_.path() / "b.isochron";
    std::ofstream(damaged, std::ios::binary) << bytes;
    CellSet set;
    set.query = {Instant(0), 128.5};
    try {
        const auto file = IndexFile::open(damaged);
        LayerSearch(file).search(step_in_chunks(*file, Instant(0)), set, true, true, {});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), damaged.string() + ": damaged: volume, step 0: chunk 3 0 2: its "
                                                   "checksum does not match");
    }
}

TEST_F(WholeLayersTest, RecordsComeInTheirOrderAndAStreamEndsWhenItIsClosed) {
    const TestField field({100, 100, 60}, 1, ValueType::f64, white_noise(random_));
    index(field);
    const ChunkStore& store = file_->chunks();
    {
        RecordStream stream(store, 0, 1, 3, {});
        RecordPiece piece;
        std::uint32_t layer = 1, place = 0, pieces = 0;
        for (; stream.next(piece); ++pieces) {
            if (place == store.grid().chunks_of_layer()) {
                EXPECT_EQ(pieces, RecordStream::pieces_of(*store.layer(0, layer)));
                ++layer;
                place = pieces = 0;
            }
            ASSERT_EQ(piece.layer, layer);
            ASSERT_EQ(piece.first, place);
            ASSERT_GT(piece.end, place);
            place = piece.end;
            std::vector<std::byte> values(store.bytes_of(store.grid().size(layer, piece.first)));
            ChunkBricks bricks;
            store.decoder().chunk(0, layer, piece.first, piece.record(piece.first), bricks, values);
        }
        EXPECT_EQ(layer, 2u);
        EXPECT_EQ(place, store.grid().chunks_of_layer());
        EXPECT_FALSE(stream.next(piece)) << "the end stays the end";
    }
    RecordStream stream(store, 0, 0, 4, {});
    RecordPiece piece;
    EXPECT_TRUE(stream.next(piece));
    stream.close();
    EXPECT_FALSE(stream.next(piece));
}

} // namespace
} // namespace isochron::index
