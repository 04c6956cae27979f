// What lies over the picture never overlaps anything that it does not belong to.
#include "tests/app/panel/layer_fixture.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

struct Screen {
    glm::ivec2 size;
    float scale;
};
void PrintTo(const Screen& screen, std::ostream* out) {
    *out << screen.size.x << " x " << screen.size.y << " at " << screen.scale;
}

class Placement : public LayerTest, public testing::WithParamInterface<Screen> {
  protected:
    Placement() {
        size_ = GetParam().size;
        layer_.set_scale(GetParam().scale);
        info_.grid.vertices = {64, 64, 64};
        offer_three_arrays(); // slices are of one of them
        info_.array = "vorticity";
        info_.value_unit = "1/s";
        info_.length_unit = "m";
        info_.time_unit = "s";
        asked_.between = interaction::BetweenSteps::blend;
        asked_.instant = index::Instant(7);
        asked_.instant.fraction = index::Instant::kFractions / 3;
        report_.footprint = render::Footprint::gaussian;
    }

    /// The windows over the picture in their order, the lowest first: name and place.
    struct Over {
        std::string name;
        ImRect place;
    };
    std::vector<Over> over_the_picture() const {
        std::vector<Over> over;
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
            const std::string name = window->Name;
            const bool part = name == "###top" || name == "###column" || name == "###time" ||
                              name == "###film" || name == "###curves";
            constexpr ImGuiWindowFlags kAbove =
                ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_Popup;
            if (!window->Active || window->Hidden || part || name.starts_with("Debug") ||
                (window->Flags & kAbove))
                continue;
            if (name == "###dim") // a question follows, and what is below cannot be used
                over.clear();
            else
                over.push_back({name, window->Rect()});
        }
        return over;
    }
    /// Lays out some frames, as windows take some to know their size, and looks for overlaps.
    void expect_apart(const std::string& state) {
        for (int i = 0; i < 5; ++i)
            frame();
        const PanelBox& box = layer_.layout().picture;
        const ImRect picture(box.low.x, box.low.y, box.high.x, box.high.y);
        const std::vector<Over> over = over_the_picture();
        for (std::size_t i = 0; i < over.size(); ++i) {
            const ImRect& place = over[i].place;
            EXPECT_TRUE(picture.Contains(place))
                << state << ": " << over[i].name << " from " << place.Min.x << ", " << place.Min.y
                << " to " << place.Max.x << ", " << place.Max.y << " leaves the picture";
            for (std::size_t other = 0; other < i; ++other)
                EXPECT_FALSE(over[other].place.Overlaps(place))
                    << state << ": " << over[i].name << " from " << place.Min.x << ", "
                    << place.Min.y << " over " << over[other].name << " to "
                    << over[other].place.Max.x << ", " << over[other].place.Max.y;
        }
    }
};

TEST_P(Placement, NothingOverlapsInAHundredStates) {
    struct State {
        const char* name;
        std::function<void()> begin;
    };
    const auto nothing = [] {};
    const auto mark = [this] {
        asked_.mark.point = interaction::MarkedPoint{{1.5, 2.5, 3.5}, {}, 12.25};
    };
    const auto clip = [this] { asked_.clip = {true, {1, 2, 3}, {0, 0, 1}}; };
    const auto slices = [this] {
        asked_.slices.planes = {{{1, 2, 3}, {0, 0, 1}}, {{1, 2, 3}, {1, 0, 0}}};
    };
    const auto box = [&] {
        clip();
        asked_.clip_box = {true, {0, 0, 0}, {9, 9, 9}};
    };
    const std::array<State, 6> tools{{{"no tool", nothing},
                                      {"mark", mark},
                                      {"clip", clip},
                                      {"clip box", box},
                                      {"slices", slices},
                                      {"all tools", [&] {
                                           mark();
                                           clip();
                                           asked_.rulers.list = {
                                               {.name = "1", .places = {{1, 2, 3}, {2, 3, 4}}}};
                                       }}}};
    const std::array<PastMessage, 1> past{
        {{"14:06:10", "saved /home/somebody/a rather long name of a folder, as disks have "
                      "them/isochron_0001.png"}}};
    const auto says = [&] {
        notes_.past = past;
        ++notes_.messages;
    };
    const std::array<State, 3> said{
        {{"no message", nothing},
         {"message", says},
         {"failure", [&] {
              says();
              notes_.standing = "indexing: step 12 of 64, 3 minutes left";
              notes_.failure = "/data/flow.isochron: block 17 cannot be read: Input/output error";
          }}}};
    const auto section = [this] { // where it opens over the picture
        if (layer_.layout().folded)
            click(layer_.layout().column.low + glm::vec2(20, 20));
    };
    const std::array<State, 6> cards{
        {{"no card", nothing},
         {"statistics", [this] { click(layer_.layout().picture.low + glm::vec2(30, 22)); }},
         {"section", section},
         {"hint", [this] { layer_.pages().introduce(); }},
         {"room", [this] { layer_.pages().explain_room(); }},
         {"sessions", [this] {
              sessions_ = {{.words = "2026-11-28 10:00:00"}, {.words = "2026-11-27"}};
              layer_.pages().offer_earlier();
          }}}};
    int states = 0;
    for (const State& tool : tools)
        for (const State& words : said)
            for (const State& card : cards) {
                asked_.mark = {};
                asked_.clip = {};
                asked_.clip_box = {};
                asked_.slices = {};
                asked_.rulers = {};
                notes_ = {.messages = notes_.messages};
                frame();
                tool.begin();
                card.begin();
                words.begin();
                expect_apart(fmt::format("{}, {}, {}", tool.name, words.name, card.name));
                if (const std::string_view name = card.name;
                    name == "statistics" || name == "section")
                    card.begin(); // closes it
                layer_.pages() = OpenPages();
                ++states;
            }
    EXPECT_GE(states, 100);
}

TEST_P(Placement, NothingOverlapsWhereRowsAreOpenAndStoriesAreTold) {
    interaction::KeyFrame first, second;
    first.name = "Before";
    first.text = "Warm air lies over the sea. It comes from the left, and is held back by the "
                 "hills, which are higher than the layer is deep.";
    second.time = 4;
    second.text = first.text;
    for (int way = 0; way < 36; ++way) {
        const bool film = way % 3 > 0, told = way % 3 == 2, curves = way / 3 % 2 == 1;
        const bool tools = way / 6 % 2 == 1;
        const int said = way / 12;
        asked_.keys.clear();
        if (film)
            asked_.keys = {first, second};
        asked_.story = told ? 1 : 0;
        asked_.curves.shown = curves;
        asked_.clip = {tools, {1, 2, 3}, {0, 0, 1}};
        asked_.mark = {};
        if (tools)
            asked_.mark.point = interaction::MarkedPoint{{1.5, 2.5, 3.5}, {}, 12.25};
        notes_ = {.messages = notes_.messages + (said > 0)};
        const std::array<PastMessage, 1> past{{"14:06:10", "saved /home/somebody/isochron_1.png"}};
        if (said > 0)
            notes_.past = past;
        if (said > 1)
            notes_.standing = "indexing: step 12 of 64, 3 minutes left";
        frame();
        expect_apart(fmt::format("film {}, story {}, curves {}, tools {}, said {}", film, told,
                                 curves, tools, said));
        notes_.past = {};
    }
}

TEST_P(Placement, TheChipAndTheCubeStayInTheCornersThatWordsOfThePictureAvoid) {
    report_.footprint = render::Footprint::gaussian; // "preview 4 of 4"
    for (int i = 0; i < 3; ++i)
        frame();
    const PanelBox& picture = layer_.layout().picture;
    for (const Over& over : over_the_picture())
        if (over.name == "###chip") {
            EXPECT_LE(over.place.Max.x, picture.low.x + kChipEnd.x);
            EXPECT_LE(over.place.Max.y, picture.low.y + kChipEnd.y);
        } else if (over.name == "###cube") {
            EXPECT_GE(over.place.Min.x, picture.high.x - kCubeEnd.x);
            EXPECT_LE(over.place.Max.y, picture.low.y + kCubeEnd.y);
        }
}

INSTANTIATE_TEST_SUITE_P(Screens, Placement,
                         testing::Values(Screen{{640, 480}, 1}, Screen{{1280, 720}, 1},
                                         Screen{{1920, 1080}, 1}, Screen{{1920, 1080}, 2},
                                         Screen{{1280, 720}, 2}));

/// What is asked darkens the rest and has the keyboard.
class Questions : public LayerTest {
  protected:
    bool is_dark() const {
        const ImGuiWindow* const dim = ImGui::FindWindowByName("###dim");
        return dim && dim->Active;
    }
};

TEST_F(Questions, OfSessionsAreAnsweredByKeysThatDoNothingElse) {
    std::vector<OfferedSession> earlier(1);
    earlier.front().commands.instant.emplace(7);
    for (const auto& [key, goes_on] :
         {std::pair(interaction::Key::enter, true), std::pair(interaction::Key::escape, false)}) {
        sessions_ = earlier;
        layer_.pages().offer_earlier();
        frame();
        frame();
        EXPECT_TRUE(is_dark());
        press(interaction::Key::space);
        EXPECT_TRUE(is_dark());
        left_.clear();
        frame({interaction::KeyEvent{interaction::Key::space, true}});
        EXPECT_TRUE(left_.empty()) << "no key reaches the session";
        interaction::Commands all = frame({interaction::KeyEvent{key, true}});
        merge(all, frame({interaction::KeyEvent{key, false}}));
        EXPECT_EQ(all.instant.has_value(), goes_on);
        frame();
        EXPECT_FALSE(is_dark());
    }
}

TEST_F(Questions, WhetherToQuitTakesTheMouseFromAllElse) {
    asked_.leaving = true;
    frame();
    frame();
    EXPECT_TRUE(is_dark());
    EXPECT_TRUE(layer_.covers({0.9f, 0.5f})) << "the picture below";
    press(interaction::Key::f1);
    EXPECT_EQ(ImGui::FindWindowByName("###help"), nullptr);
    asked_.leaving = false;
    frame();
    EXPECT_FALSE(is_dark());
}

/// The right button on the picture.
class PlaceMenu : public LayerTest {
  protected:
    PlaceMenu() {
        info_.grid.vertices = {64, 64, 64};
        info_.array = "flow";
        pointed_ = [] { return interaction::Pointed{{{10, 20, 30}, index::Instant(0), 12.5}, 0}; };
    }
    interaction::Commands right_click(glm::vec2 at, glm::vec2 up) {
        using interaction::MouseButton;
        using interaction::MouseButtonEvent;
        point(at);
        interaction::Commands all = frame({MouseButtonEvent{MouseButton::right, true}});
        point(up);
        merge(all, frame({MouseButtonEvent{MouseButton::right, false}}));
        merge(all, frame());
        return all;
    }
    bool is_open() const { return ImGui::GetCurrentContext()->OpenPopupStack.Size > 0; }
};

TEST_F(PlaceMenu, HasTheActionsOfThePlace) {
    const glm::vec2 at(700, 300);
    const auto choose = [&](const char* words) {
        right_click(at, at);
        EXPECT_TRUE(is_open());
        return click_word(words);
    };
    const auto marked = choose("mark here").mark;
    ASSERT_TRUE(marked && marked->point);
    EXPECT_EQ(marked->point->position, glm::dvec3(10, 20, 30));
    EXPECT_EQ(choose("isovalue here").isovalue, 12.5);
    const auto clip = choose("clip here").clip;
    ASSERT_TRUE(clip);
    EXPECT_TRUE(clip->shown);
    EXPECT_EQ(clip->point, glm::dvec3(10, 20, 30));
    EXPECT_NEAR(glm::length(clip->normal), 1, 1e-9);
    EXPECT_GT(glm::dot(clip->normal, -clip->point), 0) << "the side of the viewer is cut away";
    choose("copy value");
    EXPECT_EQ(layer_.pages().take_desktop_wish().text, "x 10.0 y 20.0 z 30.0, flow 12.5, t 0");
    choose("show all");
    EXPECT_TRUE(std::ranges::any_of(left_, [](const interaction::WindowEvent& event) {
        const auto* key = std::get_if<interaction::KeyEvent>(&event);
        return key && key->key == interaction::Key{'C'};
    })) << "as if C had been pressed";
}

TEST_F(PlaceMenu, OpensNeitherAfterADragNorOverThePanel) {
    right_click({700, 300}, {720, 300});
    EXPECT_FALSE(is_open()) << "a drag looks around";
    right_click({100, 300}, {100, 300});
    EXPECT_FALSE(is_open()) << "the panel is there";
    pointed_ = [] { return std::optional<interaction::Pointed>(); };
    right_click({700, 300}, {700, 300});
    EXPECT_TRUE(is_open());
    EXPECT_EQ(click_word("mark here"), interaction::Commands()) << "there is no surface";
}

TEST(DesktopWish, FindsThePathThatAMessageNames) {
    for (const auto& [message, path] : std::initializer_list<std::pair<const char*, const char*>>{
             {"saved /a/b c/isochron_0001.png", "/a/b c/isochron_0001.png"},
             {"session saved: /a/b.isosession", "/a/b.isosession"},
             {"exported /a/s.ply and 3 more: 12 triangles", "/a/s.ply"},
             {"stereo: mono", ""},
             {"1/s and m/s", ""}})
        EXPECT_EQ(path_in(message).value_or(""), path) << message;
}

} // namespace
} // namespace isochron::app
