// The track of the time where steps are blended: a tick at each true step, and gaps that are open.
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"

#include "app/panel/parts/time_track.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using index::Instant;
using interaction::BetweenSteps;

class TimeTrack : public LayerTest {
  protected:
    TimeTrack() { info_.times.resize(20); }

    /// The upright rectangles that are drawn between the ends of the track, from left to right.
    std::vector<ImRect> rectangles() {
        frame();
        frame();
        const PanelBox& bar = layer_.layout().time;
        std::vector<ImRect> found;
        const ImDrawData& data = *ImGui::GetDrawData();
        for (int n = 0; n < data.CmdListsCount; ++n) {
            const ImDrawList& list = *data.CmdLists[n];
            if (std::string(list._OwnerName).find("###time") != 0)
                continue;
            for (int i = 0; i + 3 < list.VtxBuffer.Size; ++i) {
                const ImDrawVert* at = list.VtxBuffer.Data + i;
                const bool upright = at[0].pos.y == at[1].pos.y && at[1].pos.x == at[2].pos.x &&
                                     at[2].pos.y == at[3].pos.y && at[3].pos.x == at[0].pos.x;
                const bool plain = at[0].uv.x == at[2].uv.x && at[0].uv.y == at[2].uv.y;
                if (upright && plain && at[2].pos.x > at[0].pos.x &&
                    at[0].pos.y >= bar.low.y + kLaneHeight)
                    found.emplace_back(at[0].pos, at[2].pos);
            }
        }
        std::ranges::sort(found, {}, [](const ImRect& one) { return one.Min.x; });
        return found;
    }
    /// Ticks of one pixel's width. @param least height
    std::vector<float> ticks(float least = 1) {
        std::vector<float> places;
        for (const ImRect& one : rectangles())
            if (one.GetWidth() == 1.0f && one.GetHeight() >= least)
                places.push_back(one.Min.x);
        return places;
    }
    /// Where the track is open between two steps that are held.
    std::ptrdiff_t openings() {
        return std::ranges::count_if(rectangles(), [](const ImRect& one) {
            return one.GetWidth() == 4.0f && one.GetHeight() == kTrackHeight;
        });
    }
    void point_at_word(const std::string& word) {
        frame();
        const auto at =
            place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), word);
        ASSERT_TRUE(at) << word;
        point({at->x, at->y});
    }
    bool says(const std::string& words) {
        frame();
        frame();
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words)
            .has_value();
    }
};

TEST_F(TimeTrack, HasATickAtEachTrueStepWhereStepsAreBlended) {
    EXPECT_THAT(ticks(), testing::IsEmpty()) << "steps are held";
    asked_.between = BetweenSteps::blend;
    const std::vector<float> all = ticks();
    ASSERT_EQ(all.size(), info_.times.size());
    const float apart = (all.back() - all.front()) / static_cast<float>(all.size() - 1);
    for (std::size_t i = 1; i < all.size(); ++i)
        EXPECT_NEAR(all[i] - all[i - 1], apart, 1.0f);
    EXPECT_THAT(ticks(kTrackHeight), testing::IsEmpty()) << "a step itself is shown";
    asked_.instant = {7, Instant::kFractions / 2};
    EXPECT_THAT(ticks(kTrackHeight), testing::ElementsAre(all[7], all[8]))
        << "the two that are blended";
    asked_.quality = interaction::QualityMode::paper; // always holds
    EXPECT_THAT(ticks(), testing::IsEmpty());
}

TEST_F(TimeTrack, NumbersHaveAsManyDecimalsAsThoseBesideThem) {
    for (const char* const unit : {"", "s"}) {
        info_.time_unit = unit;
        info_.times.assign({0, 0.03, 0.06, 0.1});
        for (int i = 0; i < 2; ++i)
            frame();
        const std::string after = *unit ? std::string(" ") + unit : "";
        EXPECT_TRUE(says("0.03" + after) && says("0.10" + after)) << unit;
        EXPECT_FALSE(says("0.1" + after)) << unit;
    }
}

TEST_F(TimeTrack, HasFewerTicksWhereStepsLieClose) {
    info_.times.resize(100'000);
    asked_.between = BetweenSteps::blend;
    const std::vector<float> some = ticks();
    EXPECT_GT(some.size(), 50u);
    for (std::size_t i = 1; i < some.size(); ++i)
        EXPECT_GE(some[i] - some[i - 1], 3.0f);
}

TEST_F(TimeTrack, AFlagBetweenTwoStepsSaysItsOwnTime) {
    std::iota(info_.times.begin(), info_.times.end(), 0.0);
    info_.time_unit = "s";
    asked_.between = BetweenSteps::blend;
    const std::vector<float> all = ticks();
    ASSERT_EQ(all.size(), info_.times.size());
    asked_.bookmarks = {{"turn", {7, Instant::kFractions / 2}}};
    point({(all[7] + all[8]) / 2 + 3, layer_.layout().time.low.y + 8});
    EXPECT_TRUE(says("turn: 7.5 s"));
}

TEST_F(TimeTrack, IsOpenAtGapsAndTheyAreSaidWhileTheyAreHeld) {
    const std::string held = "held: a gap between steps 12 and 13";
    gaps_ = {11};
    asked_.instant = index::Instant(11);
    EXPECT_FALSE(says(held)) << "all steps are held";
    EXPECT_TRUE(says("step 12 of 20"));
    EXPECT_EQ(openings(), 1) << "also where steps are held";
    asked_.between = BetweenSteps::blend;
    EXPECT_TRUE(says(held));
    EXPECT_TRUE(says("gap: 12 to 13"));
    const std::vector<float> all = ticks();
    ASSERT_EQ(all.size(), info_.times.size());
    const auto is_open = [&](std::size_t step) {
        for (const ImRect& one : rectangles())
            if (std::abs(one.Min.x - all[step]) <= 1 && std::abs(one.Max.x - all[step + 1]) <= 1 &&
                one.GetHeight() == kTrackHeight)
                return true;
        return false;
    };
    EXPECT_TRUE(is_open(11));
    EXPECT_FALSE(is_open(10));
    asked_.instant.fraction = 5;
    EXPECT_FALSE(says(held)) << "somebody has asked for the moment";
    EXPECT_TRUE(says("between steps 12 and 13"));
    asked_.instant = {10, 0};
    EXPECT_FALSE(says(held));
}

TEST_F(TimeTrack, TheDataSayWhereNumbersOfFilesAreMissing) {
    EXPECT_FALSE(says("gaps"));
    gaps_ = {1};
    info_.missing_after = {1};
    EXPECT_TRUE(says("1: after step 2"));
    point_at_word("1: after step 2");
    EXPECT_TRUE(says("numbers are missing in the names of the files:"));
    gaps_ = {1, 4, 8, 13};
    info_.missing_after = {};
    EXPECT_TRUE(says("4: after steps 2, 5, 9 ..."));
    EXPECT_EQ(openings(), 4);
    point_at_word("4: after steps 2, 5, 9 ...");
    EXPECT_TRUE(says("some steps are more than three times as far apart as usual:"));
    info_.times.resize(10'000); // narrower than a pixel each
    gaps_.resize(5'000);
    std::iota(gaps_.begin(), gaps_.end(), 0u);
    frame();
    EXPECT_TRUE(says("5000: after steps 1, 2, 3 ..."));
}

} // namespace
} // namespace isochron::app
