// Appending in place: the same answers as after building anew, few bytes written, and an intact
// index if it is killed at any moment.
#include "index/error.h"
#include "index/file/index_states.h"
#include "index/file/index_watch.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/search/cell_change.h"
#include "index/search/index_search.h"
#include "index/system/growing_file.h"
#include "tests/support/files_in_memory.h"
#include "tests/support/index_repair.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <future>
#include <limits>
#include <random>
#include <set>

namespace isochron::index {
namespace {

using testing::HasSubstr;

/// The first steps of a series, which grows.
StepValues first_steps(StepValues values, std::size_t steps) {
    values.steps = steps;
    return values;
}

std::unique_ptr<MemorySeries> series_of(const StepValues& values, bool colors = false) {
    auto series = std::make_unique<MemorySeries>(values);
    if (colors)
        series->info().array = "heat";
    return series;
}

std::unique_ptr<MemorySeries> flow_series(const StepValues& values) {
    auto series = std::make_unique<MemorySeries>(values);
    series->info().array = "flow";
    return series;
}

std::shared_ptr<const IndexFile> opened(const std::string& bytes) {
    return IndexFile::open(std::make_unique<BytesInMemory>(bytes));
}

class IndexAppendTest : public testing::Test {
  protected:
    std::string built(const StepValues& values, const BuildOptions& options = {}) {
        build_index(*series_of(values), path, options);
        return read_file(path);
    }

    /// Appends to an index in memory; the bytes as they are then.
    /// @param further of a second array, called `flow`
    std::string appended(const std::string& before, const StepValues& values,
                         BuildOptions options = {}, const StepValues* colors = nullptr,
                         const StepValues* further = nullptr) {
        const auto held = opened(before);
        options.codec = held->codec();
        LoggedFile file(before);
        std::unique_ptr<VolumeSeries> of_colors;
        if (colors)
            of_colors = append_colors_to(held, "memory", series_of(*colors, true));
        options.color = of_colors.get();
        std::unique_ptr<VolumeSeries> of_further;
        if (further)
            of_further = append_to(array_of(held, 1), "memory", flow_series(*further));
        if (further)
            options.further.push_back({.series = of_further.get()});
        const auto series = append_to(held, "memory", series_of(values));
        append_index(*series, *held, file, path, options, {}, *alone());
        log = std::move(file.log);
        written = file.written;
        return file.bytes();
    }

    /// Every set of a file is that of brute force, and so is every change.
    void expect_answers(const std::shared_ptr<const IndexFile>& file, const StepValues& values,
                        std::span<const double> isovalues) {
        const Search search = search_in(file, std::nullopt, Shading::none);
        ChangeSearch changes(file);
        for (std::uint32_t step = 0; step < values.steps; ++step) {
            const BruteForce now(values, step);
            for (const double isovalue : isovalues) {
                const auto expected = now.active(isovalue);
                ASSERT_EQ(search({Instant(step), isovalue}, {})->ids, expected)
                    << step << ' ' << isovalue;
                if (step == 0)
                    continue;
                auto before = BruteForce(values, step - 1).active(isovalue);
                const CellChange change =
                    changes({Instant(step - 1), isovalue}, {Instant(step), isovalue});
                std::set<CellId> after(before.begin(), before.end());
                if (change.whole)
                    after.clear();
                for (const CellId id : change.removed)
                    after.erase(id);
                after.insert(change.added.begin(), change.added.end());
                ASSERT_EQ(std::vector<CellId>(after.begin(), after.end()), expected) << step;
            }
        }
    }

    void expect_like_new(const std::string& bytes, const StepValues& values,
                         const BuildOptions& options = {}) {
        const auto file = opened(bytes);
        const auto anew = opened(built(values, options));
        EXPECT_NO_THROW(file->verify());
        EXPECT_EQ(file->content_hash(), anew->content_hash());
        EXPECT_EQ(file->stats().low, anew->stats().low);
        EXPECT_EQ(file->stats().high, anew->stats().high);
        EXPECT_EQ(file->stats().nan_values, anew->stats().nan_values);
        EXPECT_EQ(file->stats().counts, anew->stats().counts);
        EXPECT_EQ(file->stats().histogram, anew->stats().histogram);
        EXPECT_EQ(file->info().times, anew->info().times);
        EXPECT_EQ(file->info().sources, anew->info().sources);
        for (std::uint32_t step = 0; step < values.steps; ++step) {
            EXPECT_TRUE(std::ranges::equal(file->load(step).values.step_bytes(step),
                                           values.step_bytes(step)));
            if (file->plan().tiers.has(Tier::bricks)) {
                EXPECT_EQ(*file->chunks().levels(step), *anew->chunks().levels(step));
                EXPECT_TRUE(std::ranges::equal(file->load(step).bricks, anew->load(step).bricks));
            }
        }
    }

    TestFolder folder;
    std::filesystem::path path = folder.path() / "a.isochron";
    std::vector<Write> log;
    std::uint64_t written = 0;
};

TEST_F(IndexAppendTest, GivesTheAnswersOfBuildingAnewForEveryTypeTierAndCodec) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const std::optional<TierSet>& tiers :
             {std::optional<TierSet>(), std::optional(TierSet())}) {
            // Later steps go beyond what earlier ones know, of a few values only.
            TestField field({18, 11, 7}, 7, type, [&](double x, double y, double z, double t) {
                return std::round(9 * std::sin(0.4 * x + t) * std::cos(0.5 * y + 0.3 * z)) *
                       (1 + std::floor(t / 3));
            });
            if (type == ValueType::f32)
                field.at<float>(5, 17) = std::numeric_limits<float>::quiet_NaN();
            const BuildOptions options{.tiers = tiers, .codec = Codec(random() % 4)};
            std::string bytes = built(first_steps(field.view(), 2), options);
            for (const std::size_t steps : {3, 4, 7})
                bytes = appended(bytes, first_steps(field.view(), steps));
            expect_like_new(bytes, field.view(), options);
            const std::vector<double> isovalues{-17.5, -3, 0, 0.5, 4, 8.5, 13};
            expect_answers(opened(bytes), field.view(), isovalues);
        }
}

TEST_F(IndexAppendTest, WritesLittleMoreThanTheShareOfTheNewSteps) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({64, 64, 32}, 32, type, scaled(turbulence(random), 60, 128));
        const std::string before = built(first_steps(field.view(), 31));
        const std::string after = appended(before, field.view());
        const double share = double(built(field.view()).size()) / 32;
        // All sections are written again, which counts most where a step takes least.
        EXPECT_LT(double(written), 1.15 * share) << name_of(type);
        RecordProperty(fmt::format("{}_ratio", name_of(type)),
                       fmt::format("{:.3f}", double(written) / share));
    }
}

TEST_F(IndexAppendTest, AnyPrefixOfWhatItWritesLeavesTheOldIndexOrTheNewOne) {
    std::mt19937 random(test_seed());
    const TestField field({18, 17, 9}, 6, ValueType::u8, scaled(turbulence(random), 60, 128));
    const TestField heat({18, 17, 9}, 6, ValueType::f32, turbulence(random));
    const auto series = series_of(first_steps(field.view(), 2));
    const auto colors = series_of(first_steps(heat.view(), 2), true);
    const TestField flow({18, 17, 9}, 6, ValueType::u8, scaled(turbulence(random), 50, 90));
    const auto further = flow_series(first_steps(flow.view(), 2));
    build_index(*series, path, {.color = colors.get(), .further = {{.series = further.get()}}});
    std::string before = read_file(path);
    for (const std::size_t steps : {4, 5, 6}) { // both slots, and one that was used before
        const StepValues more = first_steps(heat.view(), steps);
        before += std::string(random() % 300, 'x'); // what a killed append left
        const StepValues more_flow = first_steps(flow.view(), steps);
        const std::string after =
            appended(before, first_steps(field.view(), steps), {}, &more, &more_flow);
        const std::uint64_t old_hash = opened(before)->content_hash();
        const std::uint64_t new_hash = opened(after)->content_hash();
        ASSERT_NE(old_hash, new_hash);
        const std::uint64_t old_flow = opened(before)->array(1).content_hash();
        const std::uint64_t new_flow = opened(after)->array(1).content_hash();
        ASSERT_NE(old_flow, new_flow);
        int olds = 0, news = 0;
        const auto expect_one = [&](const std::string& file) {
            const auto index = opened(file);
            ASSERT_NO_THROW(index->verify());
            const std::uint64_t hash = index->content_hash();
            (hash == new_hash ? news : olds) += 1;
            ASSERT_TRUE(hash == old_hash || hash == new_hash);
            ASSERT_EQ(index->array(1).content_hash(), hash == new_hash ? new_flow : old_flow);
        };
        std::string durable = before; // what was flushed
        std::vector<Write> pending;
        for (const Write& write : log) {
            if (write.kind == Write::flush) {
                for (const Write& done : pending)
                    LoggedFile::apply(durable, done);
                pending.clear();
                expect_one(durable);
                continue;
            }
            pending.push_back(write);
            // All before this one, and a part of it: a process that was killed.
            std::string killed = durable;
            for (const Write& done : pending)
                if (&done != &pending.back())
                    LoggedFile::apply(killed, done);
            for (int i = 0; i < 3; ++i) {
                Write part = write;
                part.bytes.resize(part.bytes.empty() ? 0 : random() % part.bytes.size());
                std::string file = killed;
                LoggedFile::apply(file, part);
                expect_one(file);
            }
            // Any of those since the last flush: a machine that lost its power.
            for (int i = 0; i < 3; ++i) {
                std::string file = durable;
                for (const Write& some : pending)
                    if (random() % 2)
                        LoggedFile::apply(file, some);
                expect_one(file);
            }
        }
        EXPECT_TRUE(pending.empty()) << "it ends flushed";
        EXPECT_EQ(durable, after);
        EXPECT_GT(olds, 20);
        EXPECT_GT(news, 0);
        before = after;
    }
}

/// Its files are as they were, whatever they are read as.
class UnchangedSeries final : public MemorySeries {
  public:
    using MemorySeries::MemorySeries;
    std::uint64_t state(std::size_t /*step*/) const override { return 7; }
};

TEST_F(IndexAppendTest, WhereFilesWereReadOtherwiseTheirStepsAreReadAgain) {
    const TestField field({20, 19, 18}, 5, ValueType::u8, moving_sphere);
    const TestField other({20, 19, 18}, 5, ValueType::u8,
                          [](double x, double, double, double) { return x; });
    UnchangedSeries series(first_steps(field.view(), 3));
    build_index(series, path, {});
    const std::string now = read_file(path);
    const std::string key = "\"reading_number\":";
    const std::size_t at = now.rfind(key) + key.size();
    ASSERT_EQ(now[at], static_cast<char>('0' + kReading));
    std::string before = now;
    before[at] = static_cast<char>('0' + kReading - 1);
    repair_checksums(std::as_writable_bytes(std::span(before)));
    ASSERT_EQ(opened(before)->metadata().reading_number, kReading - 1);
    const auto steps_read = [](const StepValues& values, const std::string& index) {
        auto given = std::make_unique<UnchangedSeries>(values);
        std::set<std::size_t> steps;
        given->before_read = [&](std::size_t step) { steps.insert(step); };
        append_to(opened(index), "a", std::move(given));
        return steps;
    };
    EXPECT_THAT(steps_read(field.view(), now), testing::IsEmpty());
    EXPECT_THAT(steps_read(field.view(), before), testing::ElementsAre(0, 1, 2));
    EXPECT_NO_THROW(steps_read(other.view(), now));
    try {
        steps_read(other.view(), before);
        ADD_FAILURE() << "other values are taken for those of the index";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("read otherwise than by the version that built it: "
                                            "build it again without --append"));
    }
}

TEST_F(IndexAppendTest, WhoHasTheIndexOpenGoesOnWithIt) {
    const TestField field({20, 19, 18}, 6, ValueType::u8, moving_sphere);
    built(first_steps(field.view(), 3));
    const auto old = IndexFile::open(path);
    // Written long ago, so that it is not read for a second look.
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() -
                                               std::chrono::hours(1));
    GrowthLook looks(path);
    for (int i = 0; i < 2; ++i)
        EXPECT_FALSE(looks.look(*old));
    GrowingFile file(path, true);
    EXPECT_THROW(GrowingFile(path, true), Error) << "one appends at a time";
    const auto series = append_to(old, "a", series_of(field.view()));
    append_index(*series, *old, file, path, {}, {}, *alone());
    EXPECT_EQ(old->info().steps(), 3u);
    EXPECT_NO_THROW(old->verify());
    const auto now = IndexFile::open(path);
    EXPECT_EQ(now->info().steps(), 6u);
    EXPECT_TRUE(has_had(*now, old->content_hash()));
    EXPECT_TRUE(has_had(*now, now->content_hash()));
    EXPECT_FALSE(has_had(*now, old->content_hash() ^ 1));
    ASSERT_TRUE(grown(path, *old));
    EXPECT_EQ(grown(path, *old)->info().steps(), 6u);
    EXPECT_FALSE(grown(path, *now)) << "it is the same";
    EXPECT_FALSE(grown(folder.path() / "none", *old));
    ASSERT_TRUE(looks.look(*old));
    EXPECT_EQ(looks.look(*old)->info().steps(), 6u) << "as long as it is new";
    EXPECT_FALSE(looks.look(*now));
    std::promise<void> woken;
    IndexWatch watch(path, old, [&woken] { woken.set_value(); });
    woken.get_future().wait(); // the test's limit ends a hang
    const auto newer = watch.take();
    ASSERT_TRUE(newer);
    EXPECT_EQ(newer->info().steps(), 6u);
    EXPECT_FALSE(watch.take()) << "once";
    const TestField other({20, 19, 18}, 7, ValueType::u8,
                          [](double x, double, double, double) { return x; });
    build_index(*series_of(other.view()), folder.path() / "other", {});
    EXPECT_FALSE(grown(folder.path() / "other", *old)) << "other data";
    std::filesystem::remove(folder.path() / "other");
    EXPECT_FALSE(has_had(*old, now->content_hash()));
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("a.isochron"));
}

TEST_F(IndexAppendTest, ThatFailsOrIsCanceledLeavesTheFileAsItWas) {
    const TestField field({20, 19, 18}, 9, ValueType::u8, moving_sphere);
    const std::string before = built(first_steps(field.view(), 3));
    std::set<std::string> phases;
    for (int attempt = 0; attempt < 8; ++attempt) {
        const auto held = IndexFile::open(path);
        GrowingFile file(path, true);
        const auto series = append_to(held, "a", series_of(field.view()));
        try {
            append_index(
                *series, *held, file, path, {},
                [&](std::string_view phase, double) {
                    if (phases.insert(std::string(phase)).second)
                        throw Error("enough");
                },
                *alone());
            break;
        } catch (const Error&) {
            EXPECT_EQ(read_file(path), before);
        }
    }
    EXPECT_GE(phases.size(), 2u);
    EXPECT_EQ(IndexFile::open(path)->info().steps(), 9u);
}

TEST_F(IndexAppendTest, ASourceThatHasChangedUnderAStepIsRefused) {
    TestField field({9, 8, 7}, 4, ValueType::u8, moving_sphere);
    built(first_steps(field.view(), 3));
    const auto held = IndexFile::open(path);
    field.at<std::uint8_t>(1, 100) ^= 1;
    try {
        append_to(held, "a.isochron", series_of(field.view()));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("a.isochron: cannot be appended to: its source t1.raw "
                                            "has changed under step 1"));
    }
}

} // namespace
} // namespace isochron::index
