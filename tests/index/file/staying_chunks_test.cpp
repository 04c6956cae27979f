// Chunks that are as in the step before: stored once, the same for everybody who builds, and read.
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/search/index_search.h"
#include "index/system/growing_file.h"
#include "tests/support/building_team.h"
#include "tests/support/files_in_memory.h"
#include "tests/support/memory_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"
#include "tests/support/staying_field.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace isochron::index {
namespace {

using test_support::BuildingTeam;
using test_support::TestFolder;
using testing::HasSubstr;

constexpr std::size_t kSteps = 9;

TestField slow_field(ValueType type, std::mt19937& random, double share = 0.8) {
    return {{37, 34, 33},
            kSteps,
            type,
            scaled(staying_field(random, turbulence(random), share, kSteps), 60, 3)};
}

/// By layer and place: the first step from which on a chunk has had the bytes of a step.
std::vector<std::uint32_t> since_by_brute_force(const StepValues& values, const ChunkGrid& grid,
                                                std::uint32_t step) {
    const auto [nx, ny, nz] = values.grid.vertices;
    const std::size_t size = size_of(values.type);
    const auto same = [&](std::uint32_t layer, std::uint32_t place, std::uint32_t t) {
        const auto [cx, cy] = grid.at(place);
        const auto extent = grid.size(layer, place);
        for (std::uint32_t z = 0; z < extent[2]; ++z)
            for (std::uint32_t y = 0; y < extent[1]; ++y) {
                const std::size_t at =
                    ((std::size_t{layer} * kChunkEdge + z) * ny + cy * kChunkEdge + y) * nx +
                    cx * kChunkEdge;
                if (std::memcmp(values.step_bytes(t).data() + at * size,
                                values.step_bytes(t - 1).data() + at * size, extent[0] * size) != 0)
                    return false;
            }
        return true;
    };
    std::vector<std::uint32_t> since;
    for (std::uint32_t layer = 0; layer < grid.layers(); ++layer)
        for (std::uint32_t place = 0; place < grid.chunks_of_layer(); ++place) {
            std::uint32_t t = step;
            while (t > 0 && same(layer, place, t))
                --t;
            since.push_back(t);
        }
    return since;
}

void expect_values(const IndexFile& file, const StepValues& values) {
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        ASSERT_TRUE(
            std::ranges::equal(file.load(step).values.step_bytes(step), values.step_bytes(step)))
            << step;
        const ChunkStore& store = file.chunks();
        const auto expected = since_by_brute_force(values, store.grid(), step);
        std::vector<std::uint32_t> since;
        for (std::uint32_t layer = 0; layer < store.grid().layers(); ++layer) {
            const ChunkLayerPtr table = store.layer(step, layer);
            since.insert(since.end(), table->since.begin(), table->since.end());
        }
        ASSERT_EQ(since, expected) << step;
    }
}

TEST(StayingChunks, HaveTheirBytesOnceAndAreReadByChunksAndAsAWhole) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes) {
        const TestFolder folder;
        const TestField field = slow_field(type, random);
        MemorySeries series(field.view());
        build_index(series, folder.path() / "a", {});
        const auto file = IndexFile::open(folder.path() / "a");
        ASSERT_NO_FATAL_FAILURE(expect_values(*file, field.view())) << name_of(type);
        EXPECT_NO_THROW(file->verify());
        std::uint64_t staying = 0;
        for (std::uint32_t step = 0; step < kSteps; ++step)
            for (const std::uint32_t since :
                 since_by_brute_force(field.view(), file->chunks().grid(), step))
                staying += since < step ? 1 : 0;
        EXPECT_EQ(file->stats().staying, staying);
        // As a source of another index it gives the same file.
        build_index(*open_index_series(folder.path() / "a", {}), folder.path() / "b", {});
        EXPECT_EQ(read_file(folder.path() / "a").size(), read_file(folder.path() / "b").size());
        const auto small_cache = IndexFile::open(folder.path() / "a", 1);
        for (std::uint32_t step = kSteps; step-- > 0;)
            for (std::uint32_t layer = 0; layer < file->chunks().grid().layers(); ++layer) {
                std::vector<std::uint32_t> places(file->chunks().grid().chunks_of_layer());
                std::iota(places.begin(), places.end(), 0u);
                const auto once = file->chunks().chunks(step, layer, places);
                const auto again = small_cache->chunks().chunks(step, layer, places);
                for (std::size_t i = 0; i < places.size(); ++i)
                    ASSERT_TRUE(std::ranges::equal(once[i]->values, again[i]->values) &&
                                once[i]->bricks == again[i]->bricks);
            }
    }
}

TEST(StayingChunks, AreTheSameBytesForAnyNumberOfThreadsAndProcesses) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field = slow_field(type, random), hue = slow_field(ValueType::i16, random);
        const auto build = [&](Team& team, unsigned threads) {
            MemorySeries series(field.view()), colors(hue.view()), further(hue.view());
            colors.info().array = "hue";
            further.info().array = "flow";
            BuildOptions options;
            options.threads = threads;
            options.color = &colors;
            options.further.push_back({.series = &further});
            build_index(series, folder.path() / "a", options, {}, team);
        };
        build(*alone(), 1);
        const std::string expected = read_file(folder.path() / "a");
        build(*alone(), 5);
        EXPECT_EQ(read_file(folder.path() / "a"), expected);
        for (const unsigned members : {2u, 3u, 5u, 12u}) {
            BuildingTeam::run(members, [&](Team& team) { build(team, 2); });
            ASSERT_EQ(read_file(folder.path() / "a"), expected) << members << " processes";
        }
    }
}

TEST(StayingChunks, GoOnWhereAnIndexGrows) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    for (const ValueType type : {ValueType::u8, ValueType::f64}) {
        const TestField field = slow_field(type, random, 0.9), hue = slow_field(type, random, 0.9);
        const auto first_steps = [](StepValues values, std::size_t steps) {
            values.steps = steps;
            return values;
        };
        for (const unsigned members : {1u, 3u}) {
            MemorySeries begun(first_steps(field.view(), 2)), colors(first_steps(hue.view(), 2));
            colors.info().array = "hue";
            BuildOptions options;
            options.color = &colors;
            build_index(begun, folder.path() / "a", options);
            for (const std::size_t steps : {std::size_t{3}, kSteps}) {
                const auto append = [&](Team& team) {
                    const std::shared_ptr<const IndexFile> held =
                        IndexFile::open(folder.path() / "a");
                    auto more = std::make_unique<MemorySeries>(first_steps(field.view(), steps));
                    auto hues = std::make_unique<MemorySeries>(first_steps(hue.view(), steps));
                    hues->info().array = "hue";
                    const auto all_colors = append_colors_to(held, "a", std::move(hues));
                    const auto all = append_to(held, "a", std::move(more));
                    BuildOptions appending;
                    appending.color = all_colors.get();
                    GrowingFile file(folder.path() / "a", team.rank() == 0);
                    append_index(*all, *held, file, folder.path() / "a", appending, {}, team);
                };
                if (members == 1)
                    append(*alone());
                else
                    BuildingTeam::run(members, append);
                const auto file = IndexFile::open(folder.path() / "a");
                ASSERT_NO_FATAL_FAILURE(expect_values(*file, first_steps(field.view(), steps)));
                EXPECT_NO_THROW(file->verify());
                for (std::uint32_t step = 0; step < steps; ++step)
                    ASSERT_TRUE(std::ranges::equal(file->load_color(step).values.step_bytes(step),
                                                   hue.view().step_bytes(step)));
            }
        }
    }
}

TEST(StayingChunks, TakeHardlyAnyBytes) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    const auto size_with = [&](double share) {
        const TestField field({65, 64, 66}, 16, ValueType::f32,
                              staying_field(random, turbulence(random), share, 16));
        MemorySeries series(field.view());
        build_index(series, folder.path() / "a", {.tiers = TierSet().with(Tier::bricks)});
        return static_cast<double>(IndexFile::open(folder.path() / "a")->stats().file_bytes);
    };
    const double changing = size_with(0.0);
    EXPECT_LT(size_with(1.0), changing / 8);
    EXPECT_LT(size_with(0.9), changing / 3);
}

/// All values of a file, as a field that may have more steps: the first step again.
TestField continued(const IndexFile& file, std::size_t more) {
    const SeriesInfo& info = file.info();
    TestField field(info.grid.vertices, info.steps() + more, info.type,
                    [](double, double, double, double) { return 0.0; });
    for (std::uint32_t step = 0; step < info.steps() + more; ++step) {
        const std::uint32_t of = step < info.steps() ? step : 0;
        const auto from = file.load(of).values.step_bytes(of);
        std::memcpy(&field.at<std::uint8_t>(step, 0), from.data(), from.size());
    }
    return field;
}

/// Whether a step has values of several bytes in packed rows, which files of version 4 have not.
bool has_wide_rows(const IndexFile& file, std::uint32_t step) {
    const ChunkStore& store = file.chunks();
    bool any = false;
    for (std::uint32_t layer = 0; layer < store.grid().layers(); ++layer) {
        const ChunkLayerPtr table = store.layer(step, layer);
        for (std::uint32_t place = 0; place < table->low.size(); ++place) {
            std::array<std::byte, 1> head{};
            const std::uint64_t before = sizeof(RecordChecksum) + sizeof(ChunkBricks);
            if (table->bytes(place) <= before)
                continue;
            store.source().read(table->offsets[place] + before, head);
            any |= (head[0] & std::byte{64}) != std::byte{0};
        }
    }
    return any;
}

TEST(StayingChunks, OfFilesOfEarlierVersionsAreStillReadAndAppendedTo) {
    for (const auto& [name, version] : {std::pair{"version3_u8.isochron", 3u},
                                        {"version3_f32.isochron", 3u},
                                        {"version4_f32.isochron", 4u}}) {
        const TestFolder folder;
        const std::filesystem::path path = folder.path() / "a";
        std::filesystem::copy_file(std::filesystem::path(test_support::test_data()) / "old" / name,
                                   path);
        const auto old = IndexFile::open(path);
        EXPECT_EQ(old->header().version, version);
        EXPECT_EQ(old->has_since(), version > 3);
        EXPECT_NO_THROW(old->verify());
        // As a source it gives the content of now, where the second half stays.
        build_index(*open_index_series(path, {}), folder.path() / "new", {});
        const auto now = IndexFile::open(folder.path() / "new");
        EXPECT_EQ(now->header().version, kFileVersion);
        EXPECT_EQ(now->content_hash(), old->content_hash());
        EXPECT_GT(now->stats().staying, 0u);
        const TestField field = continued(*old, 2);
        StepValues values = field.view();
        values.grid = old->info().grid;
        const auto expect_cells = [&](const std::shared_ptr<const IndexFile>& file) {
            for (std::uint32_t step = 0; step < file->info().steps(); ++step)
                for (const double isovalue : quantiles(sorted_values(values), 5))
                    ASSERT_EQ(search_in(file)({Instant(step), isovalue}, {})->ids,
                              BruteForce(values, step).active(isovalue));
        };
        ASSERT_NO_FATAL_FAILURE(expect_cells(old));
        ASSERT_NO_FATAL_FAILURE(expect_cells(now));
        auto more = std::make_unique<MemorySeries>(values);
        more->info() = old->info();
        for (int i = 0; i < 2; ++i) {
            more->info().times.push_back(more->info().times.back() + 1);
            more->info().sources.push_back("later");
        }
        const auto all = append_to(old, "a", std::move(more));
        {
            GrowingFile file(path, true);
            append_index(*all, *old, file, path, {}, {}, *alone());
        }
        const auto grown = IndexFile::open(path);
        EXPECT_EQ(grown->header().version, version);
        if (old->info().type == ValueType::f32) {
            EXPECT_FALSE(has_wide_rows(*grown, static_cast<std::uint32_t>(values.steps - 2)));
            EXPECT_TRUE(has_wide_rows(*now, 0));
        }
        EXPECT_EQ(grown->info().steps(), values.steps);
        EXPECT_NO_THROW(grown->verify());
        ASSERT_NO_FATAL_FAILURE(expect_cells(grown));
    }
}

} // namespace
} // namespace isochron::index
