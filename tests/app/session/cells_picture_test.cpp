// What changes no surface drops no picture of one: its cells are kept, and lines are drawn over them.
#include "tests/app/session/quality_session.h"

#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using render::Footprint;

class CellsPictureTest : public SessionQuality {
  protected:
    /// Commands that change what lies over the cells, or nothing that is seen.
    static std::vector<std::pair<std::string, Commands>> over_cells() {
        std::vector<std::pair<std::string, Commands>> all;
        Commands& speed = all.emplace_back("twice as fast", Commands{}).second;
        speed.playback.emplace();
        speed.playback->speed = 2;
        Commands& grid = all.emplace_back("the floor", Commands{}).second;
        grid.grid = true;
        Commands& mark = all.emplace_back("a mark", Commands{}).second;
        mark.mark.emplace();
        mark.mark->point.emplace();
        mark.mark->point->position = {12, 15, 15};
        Commands& box = all.emplace_back("no box", Commands{}).second;
        box.bounding_box = false;
        return all;
    }
};
INSTANTIATE_TEST_SUITE_P(Contexts, CellsPictureTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(CellsPictureTest, WhatChangesNoSurfaceDropsNoPictureAndGivesThatOfASessionThatBeganSo) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    const auto before = shown(session);
    for (const auto& [name, commands] : over_cells()) {
        SCOPED_TRACE(name);
        for (int i = 0; i < 40; ++i) {
            const FrameReport report = rest(session, 1, i == 0 ? commands : Commands{});
            EXPECT_EQ(report.footprint, Footprint::surface) << i;
        }
    }
    const auto after = shown(session);
    EXPECT_TRUE(before != after) << "lines have changed";
    Session other(config_in_parts(), file_, *context_);
    Commands all;
    for (const auto& [name, commands] : over_cells())
        interaction::merge(all, commands);
    rest(other, 1, all);
    rest_until(other, is_exact);
    EXPECT_TRUE(shown(other) == after) << "to the bit";
}

TEST_P(CellsPictureTest, AButtonThatMovesNothingDropsNoPictureAndAMotionDoes) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    const auto pressed = [&](float x) {
        interaction::InputState input = head_at_rest(now().count());
        ++frame_;
        input.devices[0].pose->position.x = x;
        interaction::DeviceState wand;
        wand.name = "wand";
        wand.pose = interaction::Pose{{0.0f, 1.0f, -0.5f}, {1, 0, 0, 0}};
        wand.buttons = 1 << 11; // which no action has
        input.devices.push_back(wand);
        return session.frame(input, {}, Waiting::never);
    };
    for (int i = 0; i < 40; ++i) {
        const FrameReport report = pressed(0);
        EXPECT_EQ(report.pace, interaction::Pace::moving) << i;
        EXPECT_EQ(report.footprint, Footprint::surface) << i;
    }
    EXPECT_LT(pressed(0.2f).footprint, Footprint::surface);
}

TEST_P(CellsPictureTest, AnythingThatTheCellsDependOnIsDrawnAnew) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    const auto before = shown(session);
    Commands look;
    look.isosurfaces = session.state().isosurfaces;
    look.isosurfaces->front().color = {0.1f, 0.9f, 0.2f};
    rest(session, 1, look);
    rest_until(session, is_exact);
    EXPECT_TRUE(shown(session) != before);
}

} // namespace
} // namespace isochron::app
