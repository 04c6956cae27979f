// Picking and reading between two steps: marks keep the moment.
#include "tests/app/panel/room_panel_fixture.h"

#include "interaction/input/actions.h"
#include "interaction/navigation/navigation.h"

namespace isochron::app {
namespace {

class PickBetweenSteps : public RoomPanelTest {};

TEST_P(PickBetweenSteps, AMarkKeepsTheMoment) {
    Config config = panel_config(kWindow);
    config.start.room_panel.shown = false;
    Session session(config, file_, *context_);
    settle(session, {}, std::nullopt);
    interaction::Commands commands;
    commands.between = interaction::BetweenSteps::blend;
    commands.instant = {0, 24576};
    session.frame(input(), commands, Waiting::for_cells);
    session.frame(input(), {}, Waiting::for_cells);
    const auto frame = [&](std::uint64_t buttons, double seconds) {
        interaction::InputState state = input();
        const glm::vec3 hand(0.22f, 1.2f, -0.3f);
        const glm::vec3 target(interaction::transform(session.state().room_from_physical,
                                                      glm::dvec3(12.0, 15.5, 15.5)));
        interaction::DeviceState wand;
        wand.name = "wand";
        wand.pose = interaction::Pose{
            hand, glm::quatLookAt(glm::normalize(target - hand), glm::vec3(0, 1, 0))};
        wand.buttons = buttons;
        state.devices.push_back(wand);
        state.time += interaction::Seconds(seconds);
        interaction::Commands all = session.commands_from(state);
        interaction::merge(all, session.take_panel_commands());
        session.frame(state, all, Waiting::for_cells);
        return all;
    };
    frame(0, 1);
    const interaction::Commands picked = frame(bit(interaction::WandButton::pick), 2);
    const auto mark = session.state().mark.point;
    ASSERT_TRUE(mark);
    EXPECT_EQ(mark->instant, index::Instant(0, 24576));
    EXPECT_EQ(picked.mark, session.state().mark) << "so it is recorded";
}

INSTANTIATE_TEST_SUITE_P(Contexts, PickBetweenSteps,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
