// What a newcomer is offered: the tour, which can be left at any point, and the session before.
#include "app/panel/panel_words.h"
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

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
    sessions_.push_back({.words = "draft, on Friday", .name = "draft"});
    sessions_.front().commands.instant.emplace(7);
    layer_.pages().offer_earlier();
    EXPECT_TRUE(shows("Start anew"));
    EXPECT_TRUE(shows("draft, on Friday"));
    EXPECT_EQ(click_on("Continue where you left off").instant, index::Instant(7));
    EXPECT_FALSE(shows("Start anew"));
    const auto continued = layer_.pages().take_continued();
    ASSERT_TRUE(continued);
    EXPECT_EQ(continued->name, "draft");
    layer_.pages().offer_earlier();
    EXPECT_EQ(click_on("Start anew"), Commands());
    EXPECT_FALSE(shows("Start anew"));
    EXPECT_FALSE(layer_.pages().take_continued());
}

TEST_F(TourTest, GoesOnWithAnySessionOfTheListsInCardAndPanel) {
    sessions_ = {{.words = "on Friday"}, {.words = "on Thursday"}};
    sessions_.back().commands.instant.emplace(3);
    layer_.pages().offer_earlier();
    click_on("2 sessions");
    EXPECT_EQ(click_on("on Thursday").instant, index::Instant(3));
    EXPECT_FALSE(shows("Start anew"));
    EXPECT_EQ(layer_.pages().take_continued()->words, "on Thursday");
    click_on("2 earlier");
    EXPECT_EQ(click_on("on Thursday").instant, index::Instant(3));
    EXPECT_EQ(layer_.pages().take_continued()->words, "on Thursday");
}

TEST_F(TourTest, ASessionIsFoundByTheSearch) {
    sessions_ = {{.words = "on Friday"},
                 {.words = "flow paper, on Thursday", .name = "flow paper"}};
    sessions_.back().commands.instant.emplace(3);
    press(interaction::Key{'K'}, static_cast<std::uint8_t>(interaction::Modifier::control));
    type("continue flow");
    frame({interaction::KeyEvent{interaction::Key::enter, true}});
    frame({interaction::KeyEvent{interaction::Key::enter, false}});
    EXPECT_EQ(layer_.pages().take_continued().value_or(OfferedSession{}).name, "flow paper");
}

TEST_F(TourTest, ACardWaitsWhileAPageOpensAndCloses) {
    using interaction::Key;
    constexpr auto kControl = static_cast<std::uint8_t>(interaction::Modifier::control);
    struct Card {
        const char* button;
        void (OpenPages::*open)();
    };
    struct Page {
        const char* name;
        Key key;
        std::uint8_t modifiers;
    };
    for (const Card& card :
         {Card{"Name it", &OpenPages::ask_session_name}, Card{"No, thanks", &OpenPages::introduce},
          Card{"I see (Enter)", &OpenPages::explain_room}})
        for (const Page& page : {Page{"###help", Key::f1, 0}, Page{"###search", Key{'K'}, kControl},
                                 Page{"###messages", {}, 0}}) {
            SCOPED_TRACE(testing::Message() << page.name << " over " << card.button);
            layer_.pages() = OpenPages();
            (layer_.pages().*card.open)();
            EXPECT_TRUE(shows(card.button));
            if (page.key == Key{})
                layer_.pages().open_messages();
            else
                press(page.key, page.modifiers);
            frame();
            EXPECT_TRUE(layer_.pages().any());
            EXPECT_FALSE(shows(card.button));
            press(Key::escape);
            EXPECT_FALSE(layer_.pages().any());
            EXPECT_TRUE(shows(card.button)) << "no answer to the card";
            EXPECT_EQ(layer_.pages().take_session_name(), std::nullopt);
        }
}

TEST_F(TourTest, EscapeLeavesWhatIsOpenOverThePictureBeforeItReachesTheSession) {
    const auto reaches = [&] {
        frame({interaction::KeyEvent{interaction::Key::escape, true}});
        const bool left = !left_.empty();
        frame({interaction::KeyEvent{interaction::Key::escape, false}});
        settle();
        return left;
    };
    const auto is_open = [](const char* window) {
        const ImGuiWindow* const found = ImGui::FindWindowByName(window);
        return found && found->Active && !found->Hidden;
    };
    for (const auto& [size, window] : {std::pair(glm::ivec2(1280, 800), "###statistics"),
                                       std::pair(glm::ivec2(640, 480), "###section")}) {
        SCOPED_TRACE(window);
        size_ = size;
        settle();
        EXPECT_TRUE(reaches()) << "nothing is open";
        const PanelLayout layout = layer_.layout();
        click(layout.folded ? layout.column.low + glm::vec2(20, 20)
                            : layout.picture.low + glm::vec2(30, 22));
        settle();
        ASSERT_TRUE(is_open(window));
        EXPECT_FALSE(reaches());
        EXPECT_FALSE(is_open(window));
        EXPECT_TRUE(reaches()) << "the next one is the tool's";
    }
}

TEST_F(TourTest, NoLineOfACardIsALoneWord) {
    frame();
    for (const char* const words :
         {"You look at the room from outside; each wall shows what its viewer's left eye sees.",
          "Hold C: drag to circle round the room, middle drag to move it, wheel to come nearer.",
          "Right drag turns the viewer's head, W A S D walk, left drag turns the data."}) {
        const float whole = ImGui::CalcTextSize(words).x;
        int narrowed = 0;
        for (float width = 0.55f * whole; width < whole + 8; width += 4) {
            const float narrow = width_without_widow(words, width);
            EXPECT_EQ(ImGui::CalcTextSize(words, nullptr, false, narrow).y,
                      ImGui::CalcTextSize(words, nullptr, false, width).y)
                << words << " at " << width;
            EXPECT_LE(narrow, width);
            narrowed += narrow < width;
            // As wide as all but the last word: that one would stand alone.
            if (width > whole - 20 && width < whole - 4)
                EXPECT_LT(narrow, width) << words;
        }
        EXPECT_GT(narrowed, 0);
        EXPECT_EQ(width_without_widow(words, whole + 8), whole + 8);
    }
    EXPECT_EQ(width_without_widow("Incomprehensibilities", 40), 40) << "one word";
}

TEST_F(TourTest, AskedForItsNameASessionGetsWhatIsTyped) {
    layer_.pages().ask_session_name();
    frame();
    type("  flow paper ");
    EXPECT_TRUE(shows("Name it"));
    press(interaction::Key::enter);
    EXPECT_EQ(layer_.pages().take_session_name(), "flow paper");
    EXPECT_FALSE(shows("Name it"));
    for (const bool types : {true, false}) { // Escape, and no name
        layer_.pages().ask_session_name();
        frame();
        if (types)
            type("other");
        press(types ? interaction::Key::escape : interaction::Key::enter);
        frame();
        EXPECT_FALSE(shows("Name it"));
        EXPECT_EQ(layer_.pages().take_session_name(), std::nullopt);
    }
}

} // namespace
} // namespace isochron::app
