// An empty picture says why it is empty, and where the way out leads.
#include "app/frame/empty_picture.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;

/// Values from 0.005 to 41.3, most of them low, with active cells everywhere between.
StepSurvey usual_step() {
    StepSurvey step;
    step.whole = true;
    step.low = 0.005;
    step.high = 41.3;
    step.histogram.assign(StepSurvey::kBins, 1);
    step.cells.assign(StepSurvey::kBins, 100);
    return step;
}

StepSurvey constant_step(double value) {
    StepSurvey step;
    step.whole = true;
    step.low = step.high = value;
    step.histogram.assign(StepSurvey::kBins, 0);
    step.cells.assign(StepSurvey::kBins, 0);
    return step;
}

/// A session with one surface, of which all is well.
struct OneSurface {
    interaction::Settings settings;
    StepSurvey step = usual_step();
    PictureFacts facts{.settings = settings,
                       .array = "FlowEnergy",
                       .unit = "J/m3",
                       .low = 0.005,
                       .high = 50,
                       .cells = {1000},
                       .step = &step,
                       .other_array = "Temperature",
                       .to_other_array = {},
                       .all_in_view = {}};
    OneSurface() {
        settings.isosurfaces[0].isovalue = 9.4;
        settings.steps = 12;
        facts.to_other_array.array = "Temperature";
        facts.all_in_view.scale = 7;
    }
    OneSurface(const OneSurface&) = delete;
};

/// A kind of empty picture: what makes it, and what is said.
struct Kind {
    EmptyBecause why;
    std::function<void(OneSurface&)> make;
    std::string sentence, way;
    std::function<bool(const Commands&)> leads; ///< whether the way leads out
    std::string chip;
};

std::vector<Kind> kinds() {
    using enum EmptyBecause;
    const auto to_array = [](const Commands& c) { return c.array == "Temperature"; };
    const auto to_all = [](const Commands& c) {
        return c.room_from_physical && c.room_from_physical->scale == 7;
    };
    const auto no_cells_at = [](double isovalue) {
        return [isovalue](OneSurface& s) {
            s.settings.isosurfaces[0].isovalue = isovalue;
            s.facts.cells = {0};
        };
    };
    const auto seen = [](Sight sight) { return [sight](OneSurface& s) { s.facts.sight = sight; }; };
    return {{no_values,
             [](OneSurface& s) {
                 s.facts.has_values = false;
                 s.facts.low = s.facts.high = 0;
                 s.facts.cells = {0};
             },
             "FlowEnergy has no values, so it has no surface.", "Show Temperature", to_array,
             "no values"},
            {constant,
             [](OneSurface& s) {
                 s.facts.low = s.facts.high = 1000;
                 s.facts.cells = {0};
             },
             "FlowEnergy is 1000 J/m3 everywhere, so it has no surface.", "Show Temperature",
             to_array, "no surface"},
            {hidden, [](OneSurface& s) { s.settings.isosurfaces[0].opacity = 0; },
             "The surface is hidden: its opacity is 0 %.", "Show it",
             [](const Commands& c) { return c.isosurfaces && (*c.isosurfaces)[0].opacity == 1; },
             "hidden"},
            {pieces_hidden,
             [](OneSurface& s) {
                 s.settings.pieces.dust = 50;
                 s.facts.cells = {0};
                 s.facts.pieces_hidden = true;
             },
             "All pieces of the surface are hidden.", "Show all pieces",
             [](const Commands& c) { return c.pieces && c.pieces->all(); }, "hidden"},
            {no_values_in_step,
             [](OneSurface& s) {
                 s.step = StepSurvey{.whole = true, .histogram = {}, .cells = {}, .other_step = 3};
                 s.facts.cells = {0};
             },
             "FlowEnergy has no values in step 1.", "Go to step 4",
             [](const Commands& c) { return c.instant == index::Instant(3); }, "no values"},
            {constant_in_step,
             [](OneSurface& s) {
                 s.step = constant_step(12);
                 s.step.other_step = 1;
                 s.facts.cells = {0};
             },
             "FlowEnergy is 12 J/m3 everywhere in step 1, so it has no surface.", "Go to step 2",
             [](const Commands& c) { return c.instant == index::Instant(1); }, "no surface"},
            {outside, no_cells_at(500), "No surface at 500: values are 0.005 to 41.3 J/m3.",
             "Go to 39.3", [](const Commands& c) { return c.isovalue == 39.3; }, "no surface"},
            {outside, no_cells_at(45), "No surface at 45: values are 0.005 to 41.3 J/m3.",
             "Go to 39.3", [](const Commands& c) { return c.isovalue == 39.3; }, "no surface"},
            {no_cells, no_cells_at(20), "No surface at 20: values are 0.005 to 41.3 J/m3.",
             "Go to 39.3", [](const Commands& c) { return c.isovalue == 39.3; }, "no surface"},
            {cut_away,
             [](OneSurface& s) {
                 s.facts.cut_away = true;
                 s.settings.clip.shown = true;
             },
             "The clip plane cuts everything away.", "Show the other side",
             [](const Commands& c) { return c.clip && c.clip->normal == glm::dvec3(0, 0, -1); },
             "cut away"},
            {behind, seen(Sight::behind), "The data are behind you.", "Show all", to_all,
             "out of view"},
            {out_of_view, seen(Sight::out_of_view), "The data are outside the view.", "Show all",
             to_all, "out of view"},
            {surface_aside, seen(Sight::surface_aside), "The surface is outside the view.",
             "Show all", to_all, "out of view"},
            {too_small, seen(Sight::too_small), "The data are too far away to be seen.", "Show all",
             to_all, "out of view"}};
}

TEST(EmptyPicture, SaysWhyAndOffersTheWayOutOfEveryKind) {
    std::set<EmptyBecause> all;
    for (const Kind& kind : kinds()) {
        OneSurface shown;
        kind.make(shown);
        const auto empty = why_empty(shown.facts);
        ASSERT_TRUE(empty) << kind.sentence;
        EXPECT_EQ(empty->why, kind.why) << kind.sentence;
        EXPECT_EQ(empty->sentence, kind.sentence);
        EXPECT_EQ(empty->way, kind.way) << kind.sentence;
        EXPECT_TRUE(kind.leads(empty->commands)) << kind.sentence;
        EXPECT_EQ(short_words(empty->why), kind.chip);
        all.insert(empty->why);
    }
    EXPECT_EQ(all.size(), kEmptyBecause) << "each kind has a row";
}

TEST(EmptyPicture, APictureThatShowsSomethingSaysNothing) {
    OneSurface shown;
    EXPECT_FALSE(why_empty(shown.facts));
    shown.facts.step = nullptr;
    EXPECT_FALSE(why_empty(shown.facts)) << "nothing need be known of the step";
    shown.settings.isosurfaces.push_back({.isovalue = 500});
    shown.facts.cells = {1000, 0};
    EXPECT_FALSE(why_empty(shown.facts)) << "one of two surfaces is seen";
}

TEST(EmptyPicture, WhatIsKnownLaterIsNotSaidBefore) {
    OneSurface shown;
    shown.settings.isosurfaces[0].isovalue = 45;
    shown.facts.cells = {0};
    shown.facts.step = nullptr;
    const auto before = why_empty(shown.facts);
    ASSERT_TRUE(before);
    EXPECT_EQ(before->sentence, "No surface at 45: values are 0.005 to 50 J/m3 at all steps.");
    shown.facts.step = &shown.step;
    shown.step.whole = false;
    EXPECT_EQ(why_empty(shown.facts)->sentence,
              "No surface at 45: values are about 0.005 to 41.3 J/m3.");
    shown.settings.between = interaction::BetweenSteps::blend;
    shown.settings.instant = {3, 1000};
    EXPECT_EQ(why_empty(shown.facts)->sentence, before->sentence) << "between two steps";
}

TEST(EmptyPicture, SpeaksOfTheSurfacesThatAreNotHidden) {
    OneSurface shown;
    shown.settings.isosurfaces = {
        {.isovalue = 10, .opacity = 0}, {.isovalue = 60}, {.isovalue = 70}};
    shown.facts.cells = {1000, 0, 0};
    const auto empty = why_empty(shown.facts);
    ASSERT_TRUE(empty);
    EXPECT_EQ(empty->sentence, "No surface at 60 or 70: values are 0.005 to 41.3 J/m3.");
    EXPECT_EQ(empty->commands.picked, 1u) << "the picked one is hidden";
    for (auto& surface : shown.settings.isosurfaces)
        surface.opacity = 0;
    EXPECT_EQ(why_empty(shown.facts)->sentence, "All surfaces are hidden: their opacity is 0 %.");
}

TEST(EmptyPicture, WithoutAnotherArrayOrStepOffersNone) {
    OneSurface shown;
    shown.facts.low = shown.facts.high = 5;
    shown.facts.other_array.clear();
    const auto empty = why_empty(shown.facts);
    ASSERT_TRUE(empty);
    EXPECT_EQ(empty->way, "");
    EXPECT_EQ(empty->commands, Commands());
}

} // namespace
} // namespace isochron::app
