// The search over an open index finds exactly the active cells, by tree and by scan.
#include "index/error.h"
#include "index/extraction/extractor.h"
#include "index/indexing/index_build.h"
#include "index/readers/formats/open_series.h"
#include "tests/support/indexed.h"
#include "tests/support/memory_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace isochron::index {
namespace {

constexpr std::array kMethods{SearchMethod::bricks, SearchMethod::tree, SearchMethod::scan};
const BuildOptions kEveryMethod{.tiers = TierSet().with(Tier::bricks).with(Tier::tree)};

TEST(IndexSearch, FindsTheActiveCellsOfEveryTypeByEveryMethod) {
    const TestFolder folder;
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const SearchMethod method : kMethods) {
            const TestField field({9, 8, 11}, 7, type, scaled(turbulence(random), 100, 10),
                                  {method == SearchMethod::bricks ? -0.5 : 2.0, 1.0});
            const StepValues values = field.view();
            const Search search = search_in(indexed(folder, values, kEveryMethod), method);
            const auto isovalues = quantiles(sorted_values(values), 9);
            std::optional<Query> before;
            for (int i = 0; i < 60; ++i) {
                // Mostly the same isovalue, as in playback: the incremental search is used.
                const Query query{Instant(static_cast<std::uint32_t>(random() % values.steps)),
                                  isovalues[static_cast<std::size_t>(i) / 7]};
                const CellSetPtr set = search(query, {});
                ASSERT_NE(set, nullptr);
                EXPECT_EQ(set->query, query);
                EXPECT_EQ(set->method, method);
                ASSERT_EQ(set->ids, BruteForce(values, query.instant.step).active(query.isovalue))
                    << name_of(type) << " step " << query.instant.step << " isovalue "
                    << query.isovalue;
                EXPECT_EQ(set->points.size(), set->ids.size());
                EXPECT_GE(set->candidates, set->ids.size());
                EXPECT_LE(set->reused, set->ids.size());
                if (method != SearchMethod::tree || before == query) {
                    EXPECT_EQ(set->reused, method == SearchMethod::tree ? set->ids.size() : 0);
                }
                before = query;
            }
        }
}

/// The whole way of a real series: reader, file, tree, incremental search, exact test.
TEST(IndexSearch, FindsInTheFmriSeriesWhatTheScanFindsAtEveryStepAnd64Quantiles) {
    const TestFolder folder;
    const auto series =
        open_series({test_support::test_data() + "/fmri/filtered_func_data.nii.gz"});
    build_index(*series, folder.path() / "a.isochron", {.with_tree = true});
    const auto file = IndexFile::open(folder.path() / "a.isochron");
    const Search by_bricks = search_in(file), by_tree = search_in(file, SearchMethod::tree),
                 by_scan = search_in(file, SearchMethod::scan);
    ASSERT_EQ(cheapest_method(*file), SearchMethod::bricks);
    const auto isovalues = quantiles(sorted_values(file->values()), 64);
    std::uint64_t active = 0;
    for (const double isovalue : isovalues)
        for (std::uint32_t step = 0; step < file->info().steps(); ++step) {
            const CellSetPtr found = by_tree({Instant(step), isovalue}, {});
            const CellSetPtr expected = by_scan({Instant(step), isovalue}, {});
            ASSERT_EQ(found->ids, expected->ids) << "step " << step << " isovalue " << isovalue;
            ASSERT_EQ(by_bricks({Instant(step), isovalue}, {})->ids, expected->ids)
                << "step " << step << " isovalue " << isovalue;
            active += found->ids.size();
        }
    EXPECT_GT(active, 1'000'000u);
    // The scan itself against the slowest way, where it is affordable.
    for (const std::uint32_t step : {0u, 31u, 63u})
        for (const std::size_t i : {5u, 33u, 60u})
            EXPECT_EQ(by_scan({Instant(step), isovalues[i]}, {})->ids,
                      BruteForce(file->values(), step).active(isovalues[i]));
}

TEST(IndexSearch, AStepThatIsSearchedAgainAndAgainGivesTheSameCellsAndTakesNoMoreMemory) {
    const TestFolder folder;
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64}) {
        const TestField field({33, 18, 13}, 2, type, scaled(turbulence(random), 100, 10));
        const StepValues values = field.view();
        const auto file = indexed(folder, values, {.tiers = TierSet().with(Tier::bricks)});
        const Search search = search_in(file);
        const BruteForce oracle(values, 1);
        const auto isovalues = quantiles(sorted_values(values), 21);
        std::uint64_t held_before = 0;
        for (std::size_t i = 0; i < isovalues.size(); ++i) {
            if (i == 16)
                held_before = file->cache().held;
            ASSERT_EQ(search({Instant(1), isovalues[i]}, {})->ids, oracle.active(isovalues[i]))
                << name_of(type) << ", search " << i;
        }
        EXPECT_EQ(file->cache().held, held_before);
    }
}

TEST(IndexSearch, SlabsOfALargeScanMeetWithoutGapOrRepetition) {
    const TestFolder folder;
    std::mt19937 random(test_seed());
    // More cells than one slab of the scan holds.
    const TestField field({300, 200, 120}, 1, ValueType::u8, white_noise(random));
    const StepValues values = field.view();
    const auto file = indexed(folder, values, {.tiers = TierSet{}});
    EXPECT_EQ(search_in(file)({Instant(0), 0.5}, {})->ids, BruteForce(values, 0).active(0.5));
}

TEST(IndexSearch, TheScanIsUsedWhenItIsAskedFor) {
    const TestFolder folder;
    const TestField field({12, 12, 12}, 4, ValueType::f32, moving_sphere);
    const auto file = indexed(folder, field.view());
    const Query query{Instant(2), 3.0};
    const CellSetPtr scanned = search_in(file, SearchMethod::scan)(query, {});
    EXPECT_EQ(scanned->candidates, scanned->ids.size());
    EXPECT_EQ(scanned->ids, search_in(file)(query, {})->ids);
}

TEST(IndexSearch, NoIsovalueOutsideTheNumbersHasActiveCells) {
    const TestFolder folder;
    const TestField field({5, 5, 5}, 2, ValueType::f32, moving_sphere);
    const Search search = search_in(indexed(folder, field.view()));
    for (const double isovalue : {std::nan(""), std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
        const CellSetPtr set = search({Instant(1), isovalue}, {});
        ASSERT_NE(set, nullptr);
        EXPECT_TRUE(set->ids.empty());
    }
}

TEST(IndexSearch, AStoppedSearchGivesNothingAndTheNextIsRight) {
    const TestFolder folder;
    const TestField field({20, 20, 20}, 4, ValueType::f32, moving_sphere);
    const StepValues values = field.view();
    for (const SearchMethod method : kMethods) {
        const Search search = search_in(indexed(folder, values, kEveryMethod), method);
        std::stop_source stop;
        stop.request_stop();
        EXPECT_EQ(search({Instant(1), 150.0}, stop.get_token()), nullptr);
        EXPECT_EQ(search({Instant(1), 150.0}, {})->ids, BruteForce(values, 1).active(150.0));
    }
}

TEST(IndexSearch, AnIsovalueBeyondTheValuesOfAStepLooksAtNoCell) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::i16, ValueType::f32, ValueType::f64}) {
        const TestFolder folder;
        const auto waves = turbulence(random);
        const TestField field({33, 18, 20}, 3, type, [&](double x, double y, double z, double t) {
            return 1000 * (waves(x, y, z, 0) + 3 * t);
        });
        const auto file = indexed(folder, field.view());
        ASSERT_FALSE(file->chunks().levels(0)->lossless());
        const Search search = search_in(file, SearchMethod::bricks);
        for (const double isovalue : {-1500.0, 1500.0, 3000.0, 9000.0}) {
            const CellSetPtr none = search({Instant(0), isovalue}, {});
            EXPECT_TRUE(none->ids.empty());
            EXPECT_EQ(none->candidates, 0u) << name_of(type) << ' ' << isovalue;
        }
        // The lowest and the highest value are no border that is crossed too early.
        const auto values = sorted_values([&] {
            StepValues first = field.view();
            first.steps = 1;
            return first;
        }());
        for (const double isovalue : {values.front(), values[1], values[values.size() / 2],
                                      values[values.size() - 2], values.back()})
            EXPECT_EQ(search({Instant(0), isovalue}, {})->ids,
                      BruteForce(field.view(), 0).active(isovalue));
    }
}

TEST(IndexSearch, AStepThatIsNotThereIsAFailure) {
    const TestFolder folder;
    const TestField field({5, 5, 5}, 2, ValueType::f32, moving_sphere);
    const Search search = search_in(indexed(folder, field.view()));
    EXPECT_THROW(search({Instant(2), 1.0}, {}), Error);
}

} // namespace
} // namespace isochron::index
