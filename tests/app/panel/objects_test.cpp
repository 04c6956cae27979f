// The list of what is in the picture: its table of kinds, its lines on the panel, and in the search.
#include "app/panel/item_table.h"

#include "app/panel/panel_in_room.h"
#include "app/panel/search_table.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/navigation.h"
#include "tests/app/panel/layer_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using testing::ElementsAre;

/// A session with one thing of each kind at least.
class Objects : public LayerTest {
  protected:
    Objects() {
        offer_three_arrays(); // slices are of one of them
        info_.array = "vorticity";
        info_.value_unit = "1/s";
        asked_.isosurfaces = {{.isovalue = 9.5, .opacity = 0.4f}, {.isovalue = 12}};
        asked_.slices.planes = {{{1, 2, 3}, {0, 0, 1}}, {{1, 2, 3}, {1, 0, 0}}};
        asked_.clip = {true, {1, 2, 3}, {0, 1, 0}};
        asked_.clip_box = {true, {0, 0, 0}, {1, 1, 1}};
        asked_.models = {{.path = "models/hull.stl"}};
        asked_.ghosts = {.earlier = 2};
        asked_.pieces.only = {{1, {1, 1, 1}}};
        asked_.pieces.hidden = {{0, {2, 2, 2}}};
        asked_.pieces.dust = 20;
        asked_.marks = {{"eye", {.position = {1, 1, 1}, .instant = {}, .value = 4.25}},
                        {"tail", {.position = {2, 1, 1}, .instant = {}, .value = 5}}};
        asked_.mark.point =
            interaction::MarkedPoint{.position = {3, 1, 1}, .instant = {}, .value = 6};
        asked_.rulers.list = {{.name = "1", .places = {{0, 0, 0}, {3, 4, 0}}},
                              {.name = "2", .places = {{0, 0, 0}}, .angle = true}};
        asked_.curves.shown = true;
    }
    PanelModel model() const {
        return {.info = info_,
                .stats = stats_,
                .data = data_,
                .asked = asked_,
                .frame = report_,
                .models = {.lines = {{.words = "12 triangles",
                                      .box = {{glm::dvec3(2, 0, 0), glm::dvec3(6, 3, 3)}}}}},
                .controls = controls_,
                .head = head_};
    }
    std::vector<std::string> words() const {
        std::vector<std::string> all;
        for (const ItemKind& kind : item_kinds())
            for (std::size_t i = 0; i < kind.count(model()); ++i)
                all.push_back(words_of_item(kind.item(model(), i)));
        return all;
    }
    interaction::DataFrame data_;
    interaction::Pose head_;
    void obey(const Commands& commands) { EXPECT_TRUE(asked_.apply(commands, info_.steps())); }
    static const ItemKind& kind(std::string_view name) {
        return *std::ranges::find(item_kinds(), name, &ItemKind::name);
    }
    Item item(std::string_view name, std::size_t i) const { return kind(name).item(model(), i); }
};

TEST_F(Objects, SayWhatThereIsWithItsValue) {
    EXPECT_THAT(words(),
                ElementsAre("vorticity 9.5 1/s", "vorticity 12 1/s", "slice z = 3", "slice x = 1",
                            "clip plane y = 2", "clip box", "hull.stl",
                            "ghosts: 2 earlier, 0 later", "piece alone of vorticity 12 1/s",
                            "piece of vorticity 9.5 1/s", "dust below 20 cells",
                            "mark eye 4.25 1/s", "mark tail 5 1/s", "mark here 6 1/s", "ruler 1 5",
                            "angle 2 1 of 3 places", "curve: area over time"));
    EXPECT_EQ(words_for_items(model()), "15 of 17 shown");
    asked_ = {};
    EXPECT_EQ(words_for_items(model()), "1 of 1 shown") << "a plain session has its surface";
}

TEST_F(Objects, SayValuesInTheDigitsThatTellThoseOfTheirArrayApart) {
    info_.digits = 8;
    asked_.isosurfaces = {{.isovalue = 101325.546}};
    asked_.mark.point->value = 101321.25;
    EXPECT_EQ(item("surface", 0).value, "101325.55 1/s");
    EXPECT_EQ(item("mark", 2).value, "101321.25 1/s");
    asked_.panel = true;
    frame();
    frame();
    EXPECT_TRUE(
        place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), "101325.55 1/s"))
        << "in the field of the isovalue, too";
}

TEST_F(Objects, AreHiddenByTheirEyesWhichBringThemBackAsTheyWere) {
    const ExplorerState before = asked_;
    for (const ItemKind& kind : item_kinds()) {
        if (kind.name == "piece") // its eye frees it: it leaves the list
            continue;
        for (std::size_t i = 0; i < kind.count(model()); ++i) {
            const float opacity = kind.item(model(), i).opacity.value_or(1.0f);
            Commands hide, show;
            show_item(kind, model(), i, false, hide);
            obey(hide);
            EXPECT_FALSE(kind.item(model(), i).shown) << kind.name << i;
            EXPECT_NE(asked_, before) << kind.name << i;
            show_item(kind, model(), i, true, show, opacity);
            obey(show);
            EXPECT_EQ(asked_, before) << kind.name << i;
        }
    }
}

TEST_F(Objects, OfPiecesAreFreedByTheirEyes) {
    const ItemKind& pieces = kind("piece");
    for (std::size_t left = 3; left > 0; --left) {
        ASSERT_EQ(pieces.count(model()), left);
        Commands free;
        show_item(pieces, model(), left / 2, true, free);
        obey(free);
    }
    EXPECT_TRUE(asked_.pieces.all());
}

TEST_F(Objects, OfPiecesThatStandAloneGetAColorOfTheirOwn) {
    const ItemAct& color = kind("piece").acts[0];
    ASSERT_TRUE(color.offered(model(), 0));
    EXPECT_FALSE(color.offered(model(), 1)) << "a hidden one";
    EXPECT_FALSE(color.offered(model(), 2)) << "dust";
    Commands commands;
    color.run(model(), 0, commands);
    obey(commands);
    EXPECT_EQ(item("surface", 2).value, item("surface", 1).value);
    EXPECT_NE(item("surface", 2).color, item("surface", 1).color);
    EXPECT_TRUE(item("surface", 2).picked);
    EXPECT_EQ(asked_.pieces.only.back(), (interaction::PlacedPiece{2, {1, 1, 1}}));
    EXPECT_EQ(asked_.pieces.hidden.back(), (interaction::PlacedPiece{1, {1, 1, 1}}));
}

TEST_F(Objects, AreRemovedOneByOneButForTheLastSurface) {
    for (const ItemKind& kind : item_kinds())
        for (std::size_t left = kind.count(model()); left > kind.least; --left) {
            Commands commands;
            kind.remove(model(), left / 2, commands);
            obey(commands);
            EXPECT_EQ(kind.count(model()), left - 1) << kind.name;
        }
    EXPECT_THAT(words(), ElementsAre("vorticity 9.5 1/s"));
}

TEST_F(Objects, AreShownAloneAmongTheirKind) {
    for (const std::string_view name : {"surface", "slice", "mark", "ruler"}) {
        const ItemKind& kind = this->kind(name);
        Commands commands;
        show_alone(kind, model(), 1, commands);
        obey(commands);
        for (std::size_t i = 0; i < kind.count(model()); ++i)
            EXPECT_EQ(kind.item(model(), i).shown, i == 1) << name << i;
    }
}

TEST_F(Objects, AHiddenMarkIsTheSameInBothLists) {
    asked_.mark.point = asked_.marks[1].point;
    EXPECT_EQ(kind("mark").count(model()), 2u) << "a mark that was kept is one line";
    Commands commands;
    show_item(kind("mark"), model(), 1, false, commands);
    obey(commands);
    EXPECT_FALSE(asked_.mark.point->shown);
    EXPECT_FALSE(asked_.marks[1].point.shown);
}

TEST_F(Objects, GoWhereAMarkWasMade) {
    asked_.marks[1].point.instant = index::Instant(7);
    asked_.playback.playing = true;
    Commands commands;
    kind("mark").go(model(), 1, commands);
    obey(commands);
    EXPECT_EQ(asked_.shown_instant(), index::Instant(7));
    EXPECT_EQ(asked_.mark.point, asked_.marks[1].point);
    EXPECT_FALSE(asked_.playback.playing);
    commands = {};
    kind("mark").acts[0].run(model(), 0, commands);
    EXPECT_EQ(commands.marks->back().name, "1") << "the first free number";
}

TEST_F(Objects, OutOfSightAreBroughtIntoViewByTheirLinesAndInSightStay) {
    const interaction::Pose head{{0, 1.6f, 0}, {1, 0, 0, 0}};
    data_.cells = {4, 4, 4};
    data_.physical_from_box = glm::dmat4(glm::dmat3(4.0));
    head_ = head;
    for (const std::string_view name : {"slice", "clip", "model", "piece", "mark", "ruler"}) {
        const ItemKind& kind = this->kind(name);
        for (std::size_t i = 0; i < kind.count(model()); ++i) {
            if (kind.places(model(), i).empty()) // dust lies nowhere
                continue;
            SCOPED_TRACE(testing::Message() << name << i);
            asked_.room_from_physical = {{0.5, 1.0, 3.0}, {1, 0, 0, 0}, 0.1}; // behind the head
            const double scale = asked_.room_from_physical.scale;
            Commands go;
            go_to_item(kind, model(), i, go);
            ASSERT_TRUE(go.room_from_physical);
            EXPECT_EQ(go.room_from_physical->scale, scale);
            obey(go);
            glm::dvec3 middle(0.0);
            const std::vector<glm::dvec3> places = kind.places(model(), i);
            for (const glm::dvec3& place : places)
                middle += transform(asked_.room_from_physical, place) /
                          static_cast<double>(places.size());
            EXPECT_NEAR(middle.x, head.position.x, 0.2);
            EXPECT_LT(middle.z, -0.1) << "ahead";
            Commands again;
            go_to_item(kind, model(), i, again);
            EXPECT_FALSE(again.room_from_physical) << "it is in sight";
        }
    }
}

TEST_F(Objects, ThatAreKeyFramesAreShownNamedAndRemovedButNotHidden) {
    const interaction::Pose head{{0, 1.6f, 0}, {1, 0, 0, 0}};
    const std::string before = words_for_items(model());
    asked_.keys = interaction::with_key({}, interaction::key_of(asked_, head));
    asked_.keys = interaction::with_key(asked_.keys, asked_.keys[0]);
    asked_.keys[1].name = "end";
    asked_.bounding_box = !asked_.bounding_box;
    const bool boxed = asked_.bounding_box;
    const ItemKind& keys = kind("key");
    ASSERT_EQ(keys.count(model()), 2u);
    EXPECT_EQ(words_of_item(keys.item(model(), 0)), "key frame 1 0 s");
    EXPECT_EQ(keys.item(model(), 1).words, "key frame end");
    EXPECT_FALSE(keys.has_eye());
    EXPECT_EQ(words_for_items(model()), before) << "they are no things in the picture";
    Commands shown, named, removed;
    go_to_item(keys, model(), 0, shown);
    obey(shown);
    EXPECT_NE(asked_.bounding_box, boxed);
    keys.rename(model(), 0, "begin", named);
    obey(named);
    EXPECT_EQ(asked_.keys[0].name, "begin");
    keys.remove(model(), 0, removed);
    obey(removed);
    ASSERT_EQ(asked_.keys.size(), 1u);
    EXPECT_EQ(asked_.keys[0].name, "end");
    EXPECT_EQ(asked_.keys[0].time, 0) << "the first one is where the film begins";
}

TEST_F(Objects, HaveLinesInTheSearchByTheirNames) {
    const PanelModel now = model();
    std::map<std::string, const SearchLine*> by_name;
    const std::vector<SearchLine> lines = search_lines(now);
    for (const SearchLine& line : lines)
        by_name[line.name] = &line;
    ASSERT_TRUE(by_name.contains("mark=tail"));
    EXPECT_EQ(by_name["mark=tail"]->words, "hide mark tail 5 1/s");
    EXPECT_FALSE(by_name["mark=tail"]->commands.marks->at(1).point.shown);
    EXPECT_EQ(by_name["objects"]->value, "15 of 17 shown");
    for (const char* name :
         {"surface=1", "slice=2", "clip=box", "model=hull.stl", "ghosts=all", "piece=1", "ruler=2",
          "curve=drawer", "see_ruler=1", "see_clip=box", "see_model=hull.stl", "see_piece=2"})
        EXPECT_TRUE(by_name.contains(name)) << name;
    EXPECT_FALSE(by_name.contains("see_piece=3")) << "dust lies nowhere";
}

TEST_F(Objects, AreLinesOfThePanelWhoseWordsPickAndGo) {
    asked_.pieces = {}; // whose lines name surfaces, too
    asked_.slices.picked = 1;
    const Commands picked = click_word("z = 3");
    ASSERT_TRUE(picked.slices);
    EXPECT_EQ(picked.slices->picked, 0u);
    const Commands chosen = click_word("12 1/s");
    EXPECT_EQ(chosen.picked, 1u);
}

/// On the panel in the room the names of the pages and the lines of the tools keep their places; what is
/// between them, and lines for which there is no room, come by the stick.
TEST_F(Objects, InTheRoomAreScrolledBetweenTheNamesOfThePagesAndTheLinesOfTheTools) {
    asked_.marks.clear();
    const glm::ivec2 size(PanelInRoom::kPixels);
    const auto at = [&](const char* word) {
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), word);
    };
    const auto lay_out = [&](std::optional<glm::vec2> pointed, bool pressed, float notches) {
        PanelModel room = model();
        room.place = PanelPlace::in_room;
        layer_.point(pointed, pressed, notches);
        layer_.lay_out(size, room, time_ += interaction::Seconds(0.1));
    };
    const auto scroll_down = [&](glm::vec2 pointed) {
        for (int i = 0; i < 12; ++i)
            lay_out(pointed, false, i < 8 ? -1.0f : 0.0f);
    };
    for (int i = 0; i < 4; ++i)
        lay_out({}, false, 0);
    const auto first = at("clip across");
    ASSERT_TRUE(first) << "the first line of the tools";
    EXPECT_FALSE(at("keep")) << "the line of the mark, for which there is no room";
    EXPECT_FALSE(at("pieces")) << "the page's last row";
    scroll_down({first->x, first->y});
    EXPECT_TRUE(at("keep"));
    EXPECT_FALSE(at("clip across"));
    scroll_down({first->x, first->y - 24}); // below the histogram, which the stick zooms
    EXPECT_TRUE(at("pieces"));
    EXPECT_FALSE(at("log")) << "what the page began with";
    EXPECT_TRUE(at("Surfaces")) << "its name stays";
    EXPECT_TRUE(at("keep"));
    asked_.slices = {};
    asked_.clip = {};
    asked_.clip_box = {};
    asked_.rulers = {};
    for (int i = 0; i < 4; ++i)
        lay_out({}, false, 0);
    EXPECT_TRUE(at("keep")) << "one line is seen whole";
}

TEST_F(Objects, AllStandInAListThatScrolls) {
    asked_.marks.assign(interaction::kMostMarks, {"m", {.position = {9, 9, 9}, .instant = {}}});
    frame();
    frame();
    const auto at = [&](const char* word) {
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), word);
    };
    EXPECT_TRUE(at("9.5 1/s"));
    EXPECT_FALSE(at("curve: area over time"));
    EXPECT_TRUE(at("Surfaces")) << "the next section is not pushed out";
}

} // namespace
} // namespace isochron::app
