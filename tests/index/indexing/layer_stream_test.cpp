// Building from parts of steps: the same bytes as from whole steps, in memory that does not depend
// on their size.
#include "index/file/chunks/chunk_differences.h"
#include "index/indexing/index_build.h"
#include "index/indexing/layer_stream.h"
#include "index/indexing/level_chooser.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

#include <malloc.h>

namespace isochron::index {
namespace {

/// Gives its steps in pieces of any length.
class PiecewiseSeries final : public MemorySeries {
  public:
    PiecewiseSeries(const StepValues& values, std::mt19937& random)
        : MemorySeries(values), stored_(values), random_(random) {}

    void stream(std::size_t step, const TakePiece& take) override {
        const auto stored = stored_.step_bytes(step);
        const std::size_t size = size_of(stored_.type), values = stored.size() / size;
        for (std::size_t at = 0, count = 0; at < values; at += count) {
            count = std::min<std::size_t>(1 + random_() % (values / 3 + 1), values - at);
            // What a piece was in is used again.
            std::vector<std::byte> piece(stored.begin() + at * size,
                                         stored.begin() + (at + count) * size);
            take(piece);
            std::ranges::fill(piece, std::byte{0xa5});
        }
    }

  private:
    StepValues stored_;
    std::mt19937& random_;
};

std::vector<VolumeSeries*> only(VolumeSeries& series) {
    return {&series};
}

TEST(LayerStream, GivesEveryLayerWithItsNeighborsHoweverAStepComes) {
    std::mt19937 random(test_seed());
    for (const std::uint32_t planes : {2u, 3u, 15u, 16u, 17u, 18u, 31u, 32u, 33u, 34u, 49u, 50u}) {
        const TestField field({3, 5, planes}, 3, ValueType::i16, white_noise(random));
        PiecewiseSeries series(field.view(), random);
        std::vector<std::size_t> seen(3);
        stream_layers(only(series), 0, 3, 2,
                      [&](std::size_t, std::size_t step, const LayerView& layer) {
                          EXPECT_EQ(layer.begin, seen[step]);
                          EXPECT_EQ(layer.begin % 16, 0u);
                          EXPECT_EQ(layer.end, std::min(layer.begin + 16, planes));
                          EXPECT_EQ(layer.first, layer.begin == 0 ? 0 : layer.begin - 1);
                          EXPECT_EQ(layer.last, std::min(layer.end + 1, planes));
                          const auto held = layer.planes(layer.first, layer.last);
                          const auto all = field.view().step_bytes(step);
                          EXPECT_TRUE(std::ranges::equal(
                              held, all.subspan(layer.first * layer.plane, held.size())));
                          seen[step] = layer.end;
                      },
                      {});
        EXPECT_EQ(seen, std::vector<std::size_t>(3, planes));
    }
}

/// Can be read by several, which tell each other that they do.
class SharedSeries final : public MemorySeries {
  public:
    struct Readers {
        std::mutex mutex;
        std::condition_variable came;
        unsigned reading = 0, most = 0, expected = 1;
        std::size_t bad = ~std::size_t{0}; ///< a step that cannot be read
    };
    SharedSeries(const StepValues& values, std::shared_ptr<Readers> readers)
        : MemorySeries(values), stored_(values), readers_(std::move(readers)) {}

    std::unique_ptr<VolumeSeries> another() const override {
        return std::make_unique<SharedSeries>(stored_, readers_);
    }
    void read(std::size_t step, std::span<std::byte> out) override {
        std::unique_lock lock(readers_->mutex);
        readers_->most = std::max(readers_->most, ++readers_->reading);
        readers_->came.notify_all();
        // Until as many as expected have read at the same time; who reads alone gives up.
        test_support::is_told(readers_->came, lock,
                              [&] { return readers_->most >= readers_->expected; });
        --readers_->reading;
        if (step == readers_->bad)
            throw std::runtime_error("step " + std::to_string(step));
        MemorySeries::read(step, out);
    }

  private:
    StepValues stored_;
    std::shared_ptr<Readers> readers_;
};

TEST(LayerStream, ReadsStepsSideBySideWhereTheSeriesAllowsItAndGivesThemInOrder) {
    std::mt19937 random(test_seed());
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
        const TestField field({4, 3, 20}, 12, ValueType::u8, white_noise(random));
        const auto readers = std::make_shared<SharedSeries::Readers>();
        readers->expected = threads;
        SharedSeries series(field.view(), readers);
        std::vector<std::size_t> order;
        stream_layers(only(series), 2, 12, threads,
                      [&](std::size_t, std::size_t step, const LayerView& layer) {
                          if (layer.begin == 0)
                              order.push_back(step);
                          EXPECT_TRUE(std::ranges::equal(
                              layer.own(), field.view().step_bytes(step).subspan(
                                               layer.begin * layer.plane, layer.own().size())));
                      },
                      {});
        EXPECT_EQ(order, (std::vector<std::size_t>{2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
        EXPECT_EQ(readers->most, threads) << "at the same time";
    }
}

/// Notes which of its steps it begins to read.
class NotedSeries final : public MemorySeries {
  public:
    NotedSeries(const StepValues& values, std::string name, std::vector<std::string>& notes)
        : MemorySeries(values), name_(std::move(name)), notes_(notes) {}

    void stream(std::size_t step, const TakePiece& take) override {
        notes_.push_back(name_ + std::to_string(step));
        MemorySeries::stream(step, take);
    }

  private:
    std::string name_;
    std::vector<std::string>& notes_;
};

TEST(LayerStream, ABuildReadsTheColorsOfAStepRightAfterItsVolume) {
    std::mt19937 random(test_seed());
    const TestField volume({5, 4, 20}, 3, ValueType::u8, white_noise(random)),
        color({5, 4, 20}, 3, ValueType::f32, white_noise(random));
    std::vector<std::string> read;
    NotedSeries series(volume.view(), "volume ", read), colors(color.view(), "colors ", read);
    const TestFolder folder;
    build_index(series, folder.path() / "a.isochron", {.color = &colors});
    EXPECT_EQ(read, (std::vector<std::string>{"volume 0", "colors 0", "volume 1", "colors 1",
                                              "volume 2", "colors 2"}));
}

TEST(LayerStream, GivesTheArraysOfEveryStepAlsoWhenTheyAreReadSideBySide) {
    std::mt19937 random(test_seed());
    const TestField first({4, 3, 20}, 9, ValueType::u8, white_noise(random)),
        second({4, 3, 20}, 9, ValueType::f64, white_noise(random));
    const std::array<const TestField*, 2> fields{&first, &second};
    for (const unsigned threads : {1u, 3u}) {
        const auto readers = std::make_shared<SharedSeries::Readers>();
        SharedSeries a(first.view(), readers), b(second.view(), readers);
        const std::array<VolumeSeries*, 2> arrays{&a, &b};
        std::vector<std::size_t> order;
        double done = 0;
        stream_layers(
            arrays, 1, 9, threads,
            [&](std::size_t array, std::size_t step, const LayerView& layer) {
                if (layer.begin == 0)
                    order.push_back(2 * step + array);
                EXPECT_TRUE(std::ranges::equal(layer.own(),
                                               fields[array]->view().step_bytes(step).subspan(
                                                   layer.begin * layer.plane, layer.own().size())));
            },
            [&](double fraction) {
                EXPECT_GE(fraction, done);
                EXPECT_LT(done = fraction, 1.0);
            });
        std::vector<std::size_t> expected(16);
        std::iota(expected.begin(), expected.end(), 2);
        EXPECT_EQ(order, expected);
    }
}

TEST(LayerStream, TheFirstStepThatCannotBeReadEndsIt) {
    const TestField field({4, 3, 20}, 30, ValueType::u8, moving_sphere);
    const auto readers = std::make_shared<SharedSeries::Readers>();
    readers->bad = 5;
    SharedSeries series(field.view(), readers);
    std::size_t seen = 0;
    try {
        stream_layers(
            only(series), 0, 30, 3,
            [&](std::size_t, std::size_t step, const LayerView&) { seen = std::max(seen, step); },
            {});
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "step 5");
    }
    EXPECT_EQ(seen, 4u);
}

TEST(LayerStream, TheBytesOfAnIndexDependNeitherOnPiecesNorOnThreadsNorOnWhatWaitsInFiles) {
    std::mt19937 random(test_seed());
    TestFolder folder;
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64})
        for (const std::array<std::uint32_t, 3> n :
             {std::array<std::uint32_t, 3>{40, 37, 33}, {5, 90, 48}, {17, 2, 2}}) {
            TestField field(n, 3, type, scaled(turbulence(random), 900, 0));
            if (type == ValueType::f32)
                for (std::size_t v = 0; v < field.view().grid.vertex_count();
                     v += 1 + random() % 90)
                    field.at<float>(1, v) = std::numeric_limits<float>::quiet_NaN();
            MemorySeries whole(field.view());
            PiecewiseSeries pieces(field.view(), random), colors(field.view(), random);
            for (const bool colored : {false, true}) {
                BuildOptions options;
                options.threads = 1;
                options.color = colored ? &whole : nullptr;
                build_index(whole, folder.path() / "a", options);
                options.threads = 3;
                options.waiting_bytes = 0;
                options.color = colored ? &colors : nullptr;
                build_index(pieces, folder.path() / "b", options);
                EXPECT_EQ(read_file(folder.path() / "a"), read_file(folder.path() / "b"))
                    << name_of(type) << " " << n[0];
            }
        }
}

/// A step of many planes that is nowhere in memory.
class TallSeries final : public VolumeSeries {
  public:
    TallSeries(std::uint32_t planes, ValueType type) {
        info_.array = "tall";
        info_.grid.vertices = {64, 64, planes};
        info_.type = type;
        info_.times = {0};
        info_.sources = {"tall"};
    }
    const SeriesInfo& info() const override { return info_; }
    void read(std::size_t, std::span<std::byte>) override { FAIL() << "read as a whole"; }
    void stream(std::size_t, const TakePiece& take) override {
        std::vector<std::byte> plane(64 * 64 * size_of(info_.type));
        for (std::uint32_t z = 0; z < info_.grid.vertices[2]; ++z) {
            for (std::size_t i = 0; i < plane.size(); i += size_of(info_.type))
                plane[i] = static_cast<std::byte>((i * 7 + z) % 251);
            take(plane);
        }
    }

  private:
    SeriesInfo info_;
};

/// The most memory that was allocated at any of the times when a build reports.
std::size_t most_allocated(std::uint32_t planes, ValueType type, const std::filesystem::path& out) {
    TallSeries series(planes, type);
    BuildOptions options;
    options.tiers = TierSet().with(Tier::bricks);
    options.threads = 1;
    options.waiting_bytes = 1 << 16;
    const auto allocated = [] {
        const struct mallinfo2 info = ::mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    const std::size_t before = allocated();
    std::size_t most = before;
    build_index(series, out, options,
                [&](std::string_view, double) { most = std::max(most, allocated()); });
    return most - before;
}

TEST(LayerStream, TheMemoryOfABuildDoesNotFollowTheSizeOfAStep) {
    TestFolder folder;
    for (const ValueType type : {ValueType::u8, ValueType::i16}) {
        const std::size_t small = most_allocated(64, type, folder.path() / "a");
        const std::size_t large = most_allocated(2048, type, folder.path() / "a");
        const std::size_t more = (2048 - 64) * 64 * 64 * size_of(type); // bytes of values
        EXPECT_LT(large, small + more / 16) << name_of(type) << ": " << small << " for 64 planes";
    }
}

TEST(LayerStream, LevelsAreTheSameHoweverAStepIsCut) {
    std::mt19937 random(test_seed());
    for (const double factor : {20.0, 3e4}) {
        const TestField field({31, 29, 23}, 1, ValueType::i16,
                              scaled(turbulence(random), factor, 0));
        LevelChooser whole(ValueType::i16), cut(ValueType::i16);
        const std::size_t all = field.view().grid.vertex_count();
        const auto stored = field.view().step_bytes(0);
        whole.add(stored);
        for (std::size_t first = 0, end = 0; first < all; first = end) {
            end = std::min(all, first + 1 + random() % 5000);
            cut.add({first, end, all}, stored.subspan(2 * first, 2 * (end - first)));
        }
        EXPECT_EQ(whole.choose(), cut.choose());
        EXPECT_EQ(whole.choose().lossless(), factor < 100);
    }
}

template <class T>
void expect_least_differences(const std::array<std::uint32_t, 3>& size, std::mt19937& random) {
    const std::size_t count = std::size_t{size[0]} * size[1] * size[2];
    std::vector<T> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = static_cast<T>(i * i * (random() % 3) + random() % 5);
    // By axis, then value by value: the slow way.
    std::array<std::vector<T>, 3> taken;
    std::array<std::uint64_t, 3> cost{};
    const std::array<std::size_t, 3> step{1, size[0], std::size_t{size[0]} * size[1]};
    std::vector<T> now = values;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<T> next = now;
        for (std::size_t i = 0; i < count; ++i)
            if (i / step[axis] % size[axis] > 0)
                next[i] = static_cast<T>(now[i] - now[i - step[axis]]);
        for (const T d : next) {
            const auto as_signed = static_cast<std::make_signed_t<T>>(d);
            const T folded = static_cast<T>(as_signed < 0 ? ~(d << 1) : d << 1);
            cost[axis] += sizeof(T) == 1 ? folded : static_cast<unsigned>(std::bit_width(folded));
        }
        taken[axis] = now = std::move(next);
    }
    const auto best = static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin());
    ChunkDifferences differences;
    EXPECT_EQ(differences.find(size, sizeof(T), std::as_bytes(std::span(values)), false).axes,
              best + 1);
    const auto shuffled = differences.shuffled();
    ASSERT_EQ(shuffled.size(), count * sizeof(T));
    const auto expected = std::as_bytes(std::span(taken[best]));
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t byte = 0; byte < sizeof(T); ++byte)
            ASSERT_EQ(shuffled[byte * count + i], expected[i * sizeof(T) + byte]);
}

TEST(ChunkDifferences, AreTheLeastOfThoseAlongOneTwoAndThreeAxes) {
    std::mt19937 random(test_seed());
    for (const std::array<std::uint32_t, 3> size : {std::array<std::uint32_t, 3>{16, 16, 16},
                                                    {16, 16, 1},
                                                    {1, 16, 16},
                                                    {3, 1, 16},
                                                    {7, 5, 3},
                                                    {2, 1, 1}}) {
        expect_least_differences<std::uint8_t>(size, random);
        expect_least_differences<std::uint16_t>(size, random);
        expect_least_differences<std::uint32_t>(size, random);
        expect_least_differences<std::uint64_t>(size, random);
    }
}

} // namespace
} // namespace isochron::index
