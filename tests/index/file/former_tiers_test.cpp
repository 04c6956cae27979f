// Indices with the tiers `cells` and `deltas`, which earlier programs built, are searched without
// them, checked, and appended to.
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/file/index_states.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/search/cell_change.h"
#include "index/search/index_search.h"
#include "index/system/growing_file.h"
#include "tests/support/memory_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace isochron::index {
namespace {

using testing::HasSubstr;

/// The steps of a file, and then its first step again.
TestField continued(const IndexFile& file, std::uint32_t more) {
    const SeriesInfo& info = file.info();
    const auto held = static_cast<std::uint32_t>(info.steps());
    TestField field(info.grid.vertices, held + more, info.type,
                    [](double, double, double, double) { return 0.0; });
    for (std::uint32_t step = 0; step < held + more; ++step) {
        const std::uint32_t of = step < held ? step : 0;
        const auto from = file.load(of).values.step_bytes(of);
        std::memcpy(&field.at<std::uint8_t>(step, 0), from.data(), from.size());
    }
    return field;
}

struct FormerFile {
    const char* name;
    TierSet tiers; ///< that are still used
    SearchMethod method;
};

class FormerTiers : public testing::TestWithParam<FormerFile> {
  protected:
    FormerTiers() {
        std::filesystem::copy_file(
            std::filesystem::path(test_support::test_data()) / "old" / GetParam().name, path_);
    }

    std::shared_ptr<const IndexFile> opened() const { return IndexFile::open(path_); }

    void append_one() const {
        const auto held = opened();
        const TestField field = continued(*held, 1);
        StepValues values = field.view();
        values.grid = held->info().grid;
        auto more = std::make_unique<MemorySeries>(values);
        more->info() = held->info();
        more->info().times.push_back(more->info().times.back() + 1);
        more->info().sources.push_back("later");
        const auto all = append_to(held, "a", std::move(more));
        GrowingFile file(path_, true);
        append_index(*all, *held, file, path_, {}, {}, *alone());
        const auto grown = opened();
        const auto last = static_cast<std::uint32_t>(values.steps - 1);
        EXPECT_TRUE(
            std::ranges::equal(grown->load(last).values.step_bytes(last), values.step_bytes(last)));
    }

    void flip(std::uint64_t offset) const {
        std::string bytes = read_file(path_);
        bytes[offset] = static_cast<char>(bytes[offset] ^ 4);
        folder_.write("a.isochron", bytes);
    }

    static void expect_answers(const std::shared_ptr<const IndexFile>& file) {
        const StepValues& values = file->values();
        EXPECT_EQ(file->plan().tiers, GetParam().tiers);
        EXPECT_EQ(cheapest_method(*file), GetParam().method);
        EXPECT_NO_THROW(file->verify());
        const Search search = search_in(file);
        ChangeSearch changes(file);
        for (const double isovalue : quantiles(sorted_values(values), 15))
            for (std::uint32_t step = 0; step < values.steps; ++step) {
                const auto expected = BruteForce(values, step).active(isovalue);
                ASSERT_EQ(search({Instant(step), isovalue}, {})->ids, expected)
                    << step << ' ' << isovalue;
                const auto before = BruteForce(values, step > 0 ? step - 1 : 0).active(isovalue);
                const CellChange change = changes({Instant(step > 0 ? step - 1 : 0), isovalue},
                                                  {Instant(step), isovalue});
                std::vector<CellId> kept, after(change.added.begin(), change.added.end()),
                    gone(change.removed.begin(), change.removed.end());
                std::ranges::sort(gone);
                if (!change.whole)
                    std::ranges::set_difference(before, gone, std::back_inserter(kept));
                after.insert(after.end(), kept.begin(), kept.end());
                std::ranges::sort(after);
                ASSERT_EQ(after, expected) << step << ' ' << isovalue;
            }
    }

    test_support::TestFolder folder_;
    std::filesystem::path path_ = folder_.path() / "a.isochron";
};

TEST_P(FormerTiers, AreNotNeededForExactAnswers) {
    const auto file = opened();
    EXPECT_GT(file->stats().unused_bytes, 0u);
    EXPECT_THAT(file->plan().reasons, testing::Each(testing::Not(HasSubstr("deltas"))));
    expect_answers(file);
    build_index(*open_index_series(path_, {}), folder_.path() / "new", {});
    const auto anew = IndexFile::open(folder_.path() / "new");
    EXPECT_EQ(anew->content_hash(), file->content_hash());
    EXPECT_EQ(anew->stats().unused_bytes, 0u);
}

TEST_P(FormerTiers, AreNotNamedByAStateThatIsAppended) {
    const auto before = opened();
    for (int times = 0; times < 3; ++times) {
        append_one();
        const auto file = opened();
        EXPECT_EQ(file->header().version, before->header().version);
        EXPECT_TRUE(file->unused().empty());
        EXPECT_EQ(lost_state(*file), std::nullopt);
        expect_answers(file);
        ASSERT_TRUE(has_had(*file, before->content_hash()));
    }
}

TEST_P(FormerTiers, AreWholeInTheStateBeforeIfTheNewestIsLost) {
    const std::size_t steps = opened()->info().steps();
    append_one();
    const std::string grown = read_file(path_);
    const std::uint64_t newest = slot_of(opened()->header());
    flip(newest + 40); // the content hash
    const auto left = opened();
    ASSERT_EQ(left->info().steps(), steps);
    EXPECT_GT(left->stats().unused_bytes, 0u);
    EXPECT_TRUE(lost_state(*left));
    expect_answers(left);
    // The older header has more bytes in some sections, but is not newer.
    folder_.write("a.isochron", grown);
    flip(kHeaderBytes - newest + 40);
    EXPECT_EQ(opened()->info().steps(), steps + 1);
    EXPECT_EQ(lost_state(*opened()), std::nullopt);
}

TEST_P(FormerTiers, AreCheckedAndMustLieInTheFile) {
    const auto good = opened();
    const std::string bytes = read_file(path_);
    for (const UnusedParts& two : good->unused())
        for (const auto& [offset, size] : two.parts) {
            if (size == 0)
                continue;
            folder_.write("a.isochron", bytes);
            flip(offset + size / 2);
            const auto damaged = opened();
            EXPECT_THAT([&] { damaged->verify(); },
                        testing::ThrowsMessage<Error>(HasSubstr("no longer used does not match")));
        }
    for (const std::uint64_t offset :
         {std::uint64_t{64}, good->header().file_bytes, ~std::uint64_t{63}}) {
        std::string moved = bytes;
        const Section& rows = good->header().section(SectionKind::directory);
        std::memcpy(moved.data() + rows.offset, &offset, sizeof offset);
        const std::uint64_t sum =
            checksum_of(std::as_bytes(std::span(moved).subspan(rows.offset, rows.bytes)));
        FileHeader header = good->header();
        header.section(SectionKind::directory).checksum = sum;
        const HeaderSlot sealed = header_bytes(header);
        std::memcpy(moved.data() + slot_of(header), sealed.data(), sealed.size());
        folder_.write("a.isochron", moved);
        EXPECT_THAT([&] { opened(); },
                    testing::ThrowsMessage<Error>(HasSubstr("lies outside the file")));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Files, FormerTiers,
    testing::Values(
        FormerFile{"former_grown.isochron", TierSet().with(Tier::bricks), SearchMethod::bricks},
        FormerFile{"former_alone.isochron", TierSet(), SearchMethod::scan},
        FormerFile{"former_f32.isochron", TierSet().with(Tier::bricks), SearchMethod::bricks},
        FormerFile{"version3_u8.isochron", TierSet().with(Tier::bricks), SearchMethod::bricks}),
    [](const auto& one) {
        const std::string name = one.param.name;
        return name.substr(0, name.find('.'));
    });

} // namespace
} // namespace isochron::index
