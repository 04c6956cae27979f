// The agreement of several processes on the cells that all of them show.
#include "app/cluster/cell_agreement.h"

#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace isochron::app {
namespace {

/// A process whose cells come some frames after they were asked for, and take some to upload.
struct Member {
    SharedCells cells;
    std::unique_ptr<index::Extractor> extractor;
    index::ExtractionPtr shown;
};

index::Extract extraction_that_fails_at(const std::set<std::uint32_t>& steps) {
    return [steps](const index::SurfacesQuery& query, const std::stop_token&) {
        if (steps.contains(query.instant.step))
            throw std::runtime_error("no such step");
        auto extraction = std::make_shared<index::Extraction>();
        extraction->query = query;
        return extraction;
    };
}

/// Members that go through frames in step, as a cluster's processes do.
class Members {
  public:
    explicit Members(const std::vector<std::set<std::uint32_t>>& failing) {
        for (const auto& steps : failing) {
            members_.emplace_back();
            members_.back().extractor =
                std::make_unique<index::Extractor>(extraction_that_fails_at(steps));
        }
    }

    /// One frame, in which this step is wanted.
    /// @param late members that are not seen to have got any further in it
    /// @return the step that all show, nothing before the first
    std::optional<std::uint32_t> frame(std::uint32_t wanted, const std::set<std::size_t>& late) {
        std::vector<CellProgress> all;
        for (const Member& member : members_)
            all.push_back(member.cells.progress());
        const CellOrder order = agreement_.decide(all);
        std::set<std::optional<std::uint32_t>> shown;
        for (std::size_t i = 0; i < members_.size(); ++i) {
            Member& member = members_[i];
            member.cells.obey(order);
            member.extractor->request(
                {member.cells.ask({index::Instant(wanted), {1.0}}), std::nullopt});
            if (!late.contains(i)) {
                member.extractor->wait();
                member.cells.look_at(*member.extractor);
                if (member.cells.to_stage())
                    member.cells.staged();
            }
            member.shown = member.cells.to_show();
            shown.insert(member.shown ? std::optional(member.shown->query.instant.step)
                                      : std::nullopt);
        }
        EXPECT_EQ(shown.size(), 1u) << "all show the same";
        return *shown.begin();
    }

  private:
    CellAgreement agreement_;
    std::vector<Member> members_;
};

TEST(CellAgreement, ASetAppearsInTheSameFrameEverywhereHoweverLateSomeAre) {
    std::mt19937 random(test_seed());
    Members members({{}, {}, {}});
    std::uint32_t wanted = 0, newest = 0;
    for (int frame = 0; frame < 400; ++frame) {
        wanted += random() % 3 == 0;
        std::set<std::size_t> late;
        for (std::size_t i = 0; i < 3; ++i)
            if (random() % 2 == 0)
                late.insert(i);
        const auto shown = members.frame(wanted, late);
        EXPECT_GE(shown.value_or(0), newest) << "never back to older cells";
        newest = std::max(newest, shown.value_or(0));
    }
    for (int frame = 0; frame < 4; ++frame)
        members.frame(wanted, {});
    EXPECT_EQ(members.frame(wanted, {}), wanted) << "and in the end what is wanted";
}

TEST(CellAgreement, NothingIsShownThatTheLastOneLacks) {
    Members members({{}, {}});
    for (int frame = 0; frame < 10; ++frame)
        EXPECT_EQ(members.frame(7, {1}), std::nullopt);
    members.frame(7, {});
    members.frame(7, {});
    EXPECT_EQ(members.frame(7, {}), 7u);
}

TEST(CellAgreement, PlaybackShowsASetInEveryFrameTwoFramesLate) {
    Members members({{}, {}, {}});
    for (std::uint32_t step = 0; step < 50; ++step) {
        const auto shown = members.frame(step, {});
        if (step >= 2) {
            EXPECT_EQ(shown, step - 2);
        }
    }
}

TEST(CellAgreement, CellsThatOneProcessCannotGetAreShownByNoneAndPassedOver) {
    Members members({{}, {3}, {}});
    for (int frame = 0; frame < 5; ++frame)
        members.frame(2, {});
    for (int frame = 0; frame < 10; ++frame)
        EXPECT_EQ(members.frame(3, {}), 2u);
    for (int frame = 0; frame < 5; ++frame)
        members.frame(4, {});
    EXPECT_EQ(members.frame(4, {}), 4u);
}

} // namespace
} // namespace isochron::app
