// What a newcomer is offered: the tour, which can be left at any point, and the session before.
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"

#include <gmock/gmock.h>

#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;

class TourTest : public LayerTest {
  protected:
    /// Windows take some frames to know their size.
    void settle() {
        point({2, 400});
        for (int i = 0; i < 4; ++i)
            frame();
    }
    bool shows(const std::string& words) {
        settle();
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words)
            .has_value();
    }
    Commands click_on(const std::string& words) {
        settle();
        const auto at =
            place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words);
        EXPECT_TRUE(at) << words;
        return at ? click({at->x, at->y}) : Commands();
    }
};

TEST_F(TourTest, LeadsThroughSixStepsAndNoticesWhatIsDone) {
    layer_.pages().introduce();
    for (int i = 0; i < 70; ++i) // longer than the hint stays once the user has begun
        frame();
    click_on("Take the tour: six steps");
    EXPECT_TRUE(layer_.pages().introduced()) << "it is offered once";
    EXPECT_TRUE(shows("1 of 6 Isovalue"));
    asked_.set_isovalue(17);
    EXPECT_TRUE(shows("1 of 6 Isovalue done"));
    for (const char* const next :
         {"2 of 6 Time", "3 of 6 Turn", "4 of 6 Pick", "5 of 6 Clip", "6 of 6 Save"}) {
        click_on("Next");
        EXPECT_TRUE(shows(next));
    }
    click_on("Finish");
    EXPECT_FALSE(shows("Leave the tour"));
}

TEST_F(TourTest, CanBeLeftAtAnyStepAndTakenAgainFromTheHelp) {
    layer_.pages().introduce();
    frame();
    click_on("No, thanks");
    EXPECT_TRUE(layer_.pages().introduced());
    EXPECT_FALSE(shows("No, thanks"));
    press(interaction::Key::f1);
    click_on("Take the tour: six steps");
    EXPECT_TRUE(shows("1 of 6 Isovalue"));
    click_on("Next");
    click_on("Leave the tour");
    EXPECT_FALSE(shows("2 of 6 Time"));
    EXPECT_FALSE(shows("Leave the tour"));
}

TEST_F(TourTest, GoesOnWithTheSessionBeforeOnlyIfTheUserSaysSo) {
    std::vector<OfferedSession> earlier(1);
    earlier.front().commands.instant.emplace(7);
    layer_.pages().offer_earlier(earlier);
    EXPECT_TRUE(shows("Start anew"));
    EXPECT_EQ(click_on("Continue where you left off").instant, index::Instant(7));
    EXPECT_FALSE(shows("Start anew"));
    layer_.pages().offer_earlier(earlier);
    EXPECT_EQ(click_on("Start anew"), Commands());
    EXPECT_FALSE(shows("Start anew"));
}

TEST_F(TourTest, GoesOnWithAnySessionOfTheList) {
    std::vector<OfferedSession> earlier{{"on Friday", {}}, {"on Thursday", {}}};
    earlier.back().commands.instant.emplace(3);
    layer_.pages().offer_earlier(earlier);
    click_on("on Friday");
    EXPECT_EQ(click_on("on Thursday").instant, index::Instant(3));
    EXPECT_FALSE(shows("Start anew"));
}

} // namespace
} // namespace isochron::app
