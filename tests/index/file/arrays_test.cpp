// Several arrays in one index: each like an index of its own, in one file that grows as one.
#include "index/error.h"
#include "index/extraction/extraction.h"
#include "index/extraction/recent_extractions.h"
#include "index/file/color_source.h"
#include "index/file/index_series.h"
#include "index/file/index_states.h"
#include "index/file/index_watch.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/system/growing_file.h"
#include "tests/support/index_repair.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

using testing::HasSubstr;

constexpr std::array<std::uint32_t, 3> kShape{37, 18, 20};
constexpr std::size_t kTimes = 6;

/// One of the arrays, of its first steps.
std::unique_ptr<MemorySeries> array_series(const std::string& name, const TestField& field,
                                           std::size_t steps = kTimes) {
    StepValues values = field.view();
    values.steps = steps;
    auto series = std::make_unique<MemorySeries>(values);
    series->info().array = name;
    series->info().value_unit = "unit of " + name;
    return series;
}

class IndexArrays : public testing::Test {
  protected:
    /// As `build` would be given them.
    struct Given {
        std::vector<std::unique_ptr<VolumeSeries>> series;
        BuildOptions options;
        VolumeSeries& first() { return *series.front(); }
    };
    Given given(std::size_t steps = kTimes, BuildOptions options = {}) const {
        Given all{.series = {}, .options = std::move(options)};
        all.series.push_back(array_series("rho", rho_, steps));
        all.series.push_back(array_series("speed", speed_, steps));
        all.series.push_back(array_series("mask", mask_, steps));
        for (const auto* name : {"speed", "mask"})
            all.options.further.push_back(
                {.series = all.series[all.options.further.size() + 1].get(), .array = name});
        return all;
    }
    std::filesystem::path built(const std::string& name, std::size_t steps = kTimes,
                                const BuildOptions& options = {}) const {
        auto path = folder_.path() / name;
        Given all = given(steps, options);
        build_index(all.first(), path, all.options);
        return path;
    }
    const TestField& field(std::size_t number) const {
        return *std::array{&rho_, &speed_, &mask_}[number];
    }
    /// Appends all steps to an index of fewer, in place.
    void append(const std::filesystem::path& path, std::size_t steps) const {
        const auto held = IndexFile::open(path);
        GrowingFile file(path, true);
        Given all = given(steps);
        for (std::size_t number = 0; number < all.series.size(); ++number)
            all.series[number] =
                append_to(array_of(held, number), path.string(), std::move(all.series[number]));
        for (std::size_t number = 1; number < all.series.size(); ++number)
            all.options.further[number - 1].series = all.series[number].get();
        append_index(all.first(), *held, file, path, all.options, {}, *alone());
    }
    void expect_like_brute_force(const std::shared_ptr<const IndexFile>& file,
                                 std::size_t steps = kTimes) const {
        EXPECT_NO_THROW(file->verify());
        ASSERT_EQ(file->arrays(), 3u);
        for (std::size_t number = 0; number < 3; ++number) {
            const auto array = array_of(file, number);
            ASSERT_EQ(array->info().steps(), steps);
            const StepValues values = field(number).view();
            for (std::uint32_t step = 0; step < steps; ++step) {
                EXPECT_TRUE(std::ranges::equal(array->load(step).values.step_bytes(step),
                                               values.step_bytes(step)));
                const BruteForce expected(values, step);
                for (const double isovalue : quantiles(sorted_values(values), 3))
                    for (std::size_t i = 0; i < kSearchMethodNames.size(); ++i) {
                        const auto method = SearchMethod(i);
                        if (!can_search(*array, method))
                            continue;
                        EXPECT_EQ(search_in(array, method)({Instant(step), isovalue}, {})->ids,
                                  expected.active(isovalue))
                            << number << ' ' << step << ' ' << kSearchMethodNames[i];
                    }
            }
        }
    }

    TestFolder folder_;
    std::mt19937 random_{test_seed()};
    TestField rho_{kShape, kTimes, ValueType::f32, turbulence(random_)};
    TestField speed_{kShape, kTimes, ValueType::u8, scaled(turbulence(random_), 90, 128)};
    TestField mask_{kShape, kTimes, ValueType::i16, scaled(white_noise(random_), 5, 0), {0.5, 10}};
};

TEST_F(IndexArrays, AreEachSearchedExactlyByEveryTier) {
    expect_like_brute_force(IndexFile::open(built("chosen.isochron")));
    const TierSet all = TierSet().with(Tier::bricks).with(Tier::tree);
    expect_like_brute_force(
        IndexFile::open(built("all.isochron", kTimes, {.tiers = all, .with_tree = true})));
    expect_like_brute_force(IndexFile::open(built("none.isochron", kTimes, {.tiers = TierSet()})));
}

TEST_F(IndexArrays, EachIsLikeAnIndexOfItsOwn) {
    const auto file = IndexFile::open(built("all.isochron"));
    for (std::size_t number = 0; number < 3; ++number) {
        const auto path = folder_.path() / "alone.isochron";
        const std::string name = file->array(number).info().array;
        build_index(*array_series(name, field(number)), path, {});
        const auto alone = IndexFile::open(path);
        const IndexFile& array = file->array(number);
        EXPECT_EQ(array.content_hash(), alone->content_hash());
        EXPECT_EQ(array.stats().low, alone->stats().low);
        EXPECT_EQ(array.stats().high, alone->stats().high);
        EXPECT_EQ(array.stats().histogram, alone->stats().histogram);
        EXPECT_EQ(array.plan().tiers, alone->plan().tiers);
        EXPECT_EQ(array.plan().reasons, alone->plan().reasons);
        EXPECT_EQ(array.info().value_unit, "unit of " + name);
        EXPECT_EQ(file->array_called(name), number);
        EXPECT_EQ(array.array_called(name), number) << "whichever is asked";
    }
    EXPECT_EQ(file->array_called("pressure"), std::nullopt);
}

TEST_F(IndexArrays, GiveTheSameBytesForAnyNumberOfThreads) {
    EXPECT_EQ(read_file(built("one.isochron", kTimes, {.threads = 1})),
              read_file(built("three.isochron", kTimes, {.threads = 3})));
}

TEST_F(IndexArrays, ReadEachSeriesOnce) {
    Given all = given();
    std::vector<std::size_t> reads(all.series.size());
    for (std::size_t number = 0; number < all.series.size(); ++number)
        static_cast<MemorySeries&>(*all.series[number]).before_read = [&, number](std::size_t) {
            ++reads[number];
        };
    build_index(all.first(), folder_.path() / "a.isochron", all.options);
    EXPECT_THAT(reads, testing::Each(kTimes));
}

/// So that files that hold all arrays of a step come from their disk once.
TEST_F(IndexArrays, AreReadStepAfterStep) {
    Given all = given();
    all.series.push_back(array_series("colors", rho_));
    all.options.color = all.series.back().get();
    std::vector<std::pair<std::size_t, std::size_t>> reads, expected;
    for (std::size_t number = 0; number < all.series.size(); ++number)
        static_cast<MemorySeries&>(*all.series[number]).before_read =
            [&, number](std::size_t step) { reads.emplace_back(step, number); };
    build_index(all.first(), folder_.path() / "a.isochron", all.options);
    for (std::size_t step = 0; step < kTimes; ++step)
        for (const std::size_t number : {0u, 3u, 1u, 2u})
            expected.emplace_back(step, number);
    EXPECT_EQ(reads, expected);
    expect_like_brute_force(IndexFile::open(folder_.path() / "a.isochron"));
}

TEST_F(IndexArrays, AllGrowWithAnAppend) {
    const auto path = built("a.isochron", 2, {.tiers = TierSet().with(Tier::bricks)});
    const auto old = IndexFile::open(path);
    for (const std::size_t steps : {3u, 5u, 6u}) {
        append(path, steps);
        const auto now = IndexFile::open(path);
        expect_like_brute_force(now, steps);
        EXPECT_TRUE(has_had(*now, old->content_hash()));
    }
    const auto anew = IndexFile::open(built("anew.isochron"));
    for (std::size_t number = 0; number < 3; ++number)
        EXPECT_EQ(IndexFile::open(path)->array(number).content_hash(),
                  anew->array(number).content_hash());
    EXPECT_EQ(old->info().steps(), 2u);
    expect_like_brute_force(old, 2); // who has it open goes on with it
    const auto seen = grown(path, *old);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->array(2).info().steps(), kTimes);
}

TEST_F(IndexArrays, RoomOfEarlierSectionsIsUsedAgain) {
    const auto path = built("a.isochron", 1, {.tiers = TierSet().with(Tier::bricks)});
    std::set<std::uint64_t> places;
    for (std::size_t steps = 2; steps <= kTimes; ++steps) {
        append(path, steps);
        places.insert(IndexFile::open(path)->header().section(SectionKind::steps).offset);
    }
    EXPECT_LT(places.size(), kTimes - 1) << "sections lie where older ones lay";
    expect_like_brute_force(IndexFile::open(path));
}

TEST_F(IndexArrays, WithAChangedSourceAreNotAppendedTo) {
    const auto path = built("a.isochron", 3);
    mask_.at<std::int16_t>(1, 77) ^= 1;
    const std::string before = read_file(path);
    try {
        append(path, kTimes);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("has changed under step 1"));
    }
    EXPECT_EQ(read_file(path), before);
}

TEST_F(IndexArrays, OfOneValueColorNothingAsLongAsAnotherCan) {
    for (std::size_t step = 0; step < kTimes; ++step)
        for (std::size_t vertex = 0; vertex < 37 * 18 * 20; ++vertex)
            speed_.at<std::uint8_t>(step, vertex) = 128;
    const auto file = IndexFile::open(built("all.isochron"));
    EXPECT_EQ(color_source_called(*file, "", 0), 2u) << "speed says nothing";
    EXPECT_EQ(color_source_called(*file, "", 2), 0u);
    EXPECT_EQ(color_source_called(*file, "speed", 0), 1u) << "as who asks for it wants";
}

TEST_F(IndexArrays, ColorTheSurfacesOfOthers) {
    const auto file = IndexFile::open(built("all.isochron"));
    ASSERT_EQ(ColorSource::count(*file), 3u);
    EXPECT_EQ(color_source_called(*file, "mask", 0), 2u);
    EXPECT_EQ(color_source_called(*file, "", 0), 1u) << "not the surfaces' own";
    EXPECT_EQ(color_source_called(*file, "", 1), 0u);
    EXPECT_EQ(color_source_called(*file, "none", 2), 0u);
    // Colors are equal to those of an index that carries the array for colors only.
    const auto newest = std::make_shared<NewestIndex>(file);
    const Extract extract = extract_from_newest(newest, Shading::none);
    for (std::uint32_t surfaces = 0; surfaces < 3; ++surfaces)
        for (std::uint32_t colors = 0; colors < 3; ++colors) {
            const auto path = folder_.path() / "pair.isochron";
            const auto of_colors = array_series("colors", field(colors));
            build_index(*array_series("surfaces", field(surfaces)), path,
                        {.color = of_colors.get()});
            const auto pair = IndexFile::open(path);
            SurfacesQuery query{.instant = Instant(3),
                                .isovalues = quantiles(sorted_values(field(surfaces).view()), 2),
                                .coloring = CellColoring::value};
            const auto expected = extract_from(pair)(query, {});
            query.array = surfaces;
            query.colors = colors;
            const auto found = extract(query, {});
            ASSERT_GT(expected->cells(), 100u);
            EXPECT_EQ(found->colors, expected->colors) << surfaces << ' ' << colors;
            EXPECT_EQ(found->surfaces[1].ids, expected->surfaces[1].ids);
            EXPECT_EQ(found->query, query);
        }
}

TEST_F(IndexArrays, WhatWasExtractedOfOneIsNotTakenForAnother) {
    const SurfacesQuery query{
        .instant = Instant(3), .isovalues = {0.5}, .coloring = CellColoring::value};
    SurfacesQuery surfaces = query, colors = query, step = query;
    surfaces.array = 1;
    colors.colors = 1;
    step.instant = Instant(4);
    EXPECT_TRUE(same_but_for_step(query, step));
    EXPECT_FALSE(same_but_for_step(query, surfaces));
    EXPECT_FALSE(same_but_for_step(query, colors));
}

TEST_F(IndexArrays, AnIndexWithOneKeepsItsBytesAndHasNoList) {
    const auto path = folder_.path() / "one.isochron";
    build_index(*array_series("rho", rho_), path, {});
    const auto file = IndexFile::open(path);
    EXPECT_EQ(file->arrays(), 1u);
    EXPECT_EQ(&file->array(0), file.get());
    EXPECT_EQ(ColorSource::count(*file), 0u);
    EXPECT_THAT(to_json(file->metadata()), testing::Not(HasSubstr("\"arrays\"")));
}

TEST_F(IndexArrays, AreAllSeriesOfAnIndexThatIsReadAsOne) {
    const auto path = built("all.isochron");
    EXPECT_THAT(arrays_of_index(path), testing::ElementsAre("rho", "speed", "mask"));
    for (std::size_t number = 0; number < 3; ++number) {
        ReadOptions options;
        options.array = arrays_of_index(path)[number];
        const auto series = open_index_series(path, options);
        std::vector<std::byte> step(series->info().step_bytes());
        series->read(4, step);
        EXPECT_TRUE(std::ranges::equal(step, field(number).view().step_bytes(4)));
    }
    ReadOptions none;
    none.array = "pressure";
    EXPECT_THROW(open_index_series(path, none), Error);
}

TEST_F(IndexArrays, ThatDoNotGoTogetherAreRefused) {
    const auto path = folder_.path() / "a.isochron";
    const auto complaint = [&](VolumeSeries& other) -> std::string {
        try {
            build_index(*array_series("rho", rho_), path, {.further = {{.series = &other}}});
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_THAT(complaint(*array_series("rho", speed_)), HasSubstr("array rho is given twice"));
    EXPECT_THAT(complaint(*array_series("speed", speed_, 5)), HasSubstr("vertices and 5 steps"));
    const TestField larger({37, 18, 21}, kTimes, ValueType::u8, moving_sphere);
    EXPECT_THAT(complaint(*array_series("speed", larger)), HasSubstr("vertices and 6 steps"));
    auto moved = array_series("speed", speed_);
    moved->info().grid.origin.x += 1;
    EXPECT_THAT(complaint(*moved), HasSubstr("lie at different places"));
    EXPECT_FALSE(std::filesystem::exists(path));
}

/// What a list of arrays may say that is not true: each is one line.
TEST_F(IndexArrays, AListThatLiesIsOneLine) {
    const std::string good = read_file(built("all.isochron"));
    const auto opens = [](std::string bytes) -> std::string {
        repair_checksums(std::as_writable_bytes(std::span(bytes)));
        const TestFolder folder;
        try {
            IndexFile::open(folder.write("a.isochron", bytes))->verify();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(opens(good), "");
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string bytes = good;
        const auto at = bytes.rfind(from); // in the list, which is at the end
        EXPECT_NE(at, bytes.npos) << from;
        EXPECT_EQ(from.size(), to.size());
        return opens(bytes.replace(at, from.size(), to));
    };
    const FileHeader header = IndexFile::open(built("all.isochron"))->header();
    const std::string list = good.substr(header.section(SectionKind::metadata).offset);
    const auto offset_after = [&](const std::string& key) {
        const std::size_t at =
            list.find("\"" + key + "\":[", list.find("\"arrays\"")) + key.size() + 4;
        return list.substr(at, list.find(',', at) - at);
    };
    for (const auto* section : {"steps", "directory", "checksums", "metadata"}) {
        const std::string offset = offset_after(section);
        EXPECT_THAT(
            replaced("\"" + std::string(section) + "\":[" + offset,
                     "\"" + std::string(section) + "\":[" + std::string(offset.size(), '9')),
            HasSubstr("damaged list of arrays: section " + std::string(section) +
                      " lies outside the file"));
    }
    EXPECT_THAT(replaced("\"content_hash\":\"", "\"content_hush\":\""), HasSubstr("metadata"));
    EXPECT_THAT(replaced("\"array\":\"mask\"", "\"array\":\"rho\" "),
                testing::AnyOf(HasSubstr("two arrays are called rho"), HasSubstr("metadata")));
}

} // namespace
} // namespace isochron::index
