// The panel in the room, as a desktop's window shows it: beside the data.
#include "tests/support/session_fixture.h"

#include "interaction/controls/room_panel.h"
#include "interaction/input/actions.h"
#include "interaction/navigation/navigation.h"
#include "stereo/screen.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using interaction::InputState;
using interaction::Pose;

class DeskPanelTest : public SessionTest {
  protected:
    struct Seen {
        glm::vec2 low{1e9f}, high{-1e9f};
        void add(glm::vec2 at) {
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    };
    /// In the picture of the middle between the eyes, from the lower left.
    static glm::vec2 pixel_of(const Session& session, const glm::vec3& place) {
        const stereo::Display& display = session.outputs().display();
        const glm::vec2 size(display.size());
        const render::View view =
            stereo::view_of(display.window().viewports.front().screen, head().pose.value(),
                            stereo::Eye::center, 0, 0.05f, 50, display.size());
        const glm::vec4 clip = view.clip_from_eye * view.eye_from_room * glm::vec4(place, 1);
        return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size;
    }
    static interaction::DeviceState head() {
        return {.name = "head", .pose = Pose{{0, 1.6f, 0}, {1, 0, 0, 0}}, .valuators = {}};
    }
    static InputState with_keys(double time, const interaction::ActionSet& keys) {
        InputState input{interaction::Seconds(time), {head()}};
        input.devices.push_back({.name = "keys", .pose = {}, .valuators = {}, .actions = keys});
        return input;
    }
};

TEST_P(DeskPanelTest, TheKeyPutsThePanelBesideTheDataWhateverTheWindowsShape) {
    Config config = read_config("desktop");
    config.rendering.samples = 1;
    for (const glm::ivec2 window : {glm::ivec2(1280, 720), glm::ivec2(640, 480),
                                    glm::ivec2(320, 240), glm::ivec2(500, 900)}) {
        SCOPED_TRACE(testing::Message() << window.x << " x " << window.y);
        config.installation.windows.front().size = window;
        const auto context = stereo::make_context(GetParam(), {.size = window});
        Session session(config, file_, *context);
        session.frame(with_keys(0, 0), {}, Waiting::for_cells);
        const InputState pressed = with_keys(1, interaction::bit(interaction::Action::room_panel));
        session.frame(pressed, session.commands_from(pressed), Waiting::for_cells);
        ASSERT_TRUE(session.state().room_panel.shown);
        Seen panel, data;
        for (const glm::vec3& corner :
             corners_of(session.state().room_panel.pose, session.room_panel_size()))
            panel.add(pixel_of(session, corner));
        const auto vertices = glm::dvec3(31);
        for (int corner = 0; corner < 8; ++corner)
            data.add(pixel_of(
                session, glm::vec3(interaction::transform(
                             session.state().room_from_physical,
                             glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) * vertices))));
        EXPECT_GE(panel.low.x, 0);
        EXPECT_GE(panel.low.y, 0);
        EXPECT_LE(panel.high.y, window.y);
        EXPECT_LT(panel.high.x, data.low.x) << "it covers none of the data";
        EXPECT_LE(data.high.x, window.x) << "all of which are there";
        EXPECT_GT(panel.high.x - panel.low.x, 0.33 * window.x) << "and can be read";
        InputState away = with_keys(1.5, 0);
        away.devices.front().pose->orientation = glm::angleAxis(-1.5f, glm::vec3(0, 1, 0));
        session.frame(away, {}, Waiting::for_cells);
        EXPECT_EQ(session.outputs().display().window().viewports.front().screen.aside, 0)
            << "who turns away from it has the window to themselves";
        const InputState released = with_keys(2, 0);
        session.frame(released, session.commands_from(released), Waiting::for_cells);
        InputState again = pressed;
        again.time = interaction::Seconds(3);
        session.frame(again, session.commands_from(again), Waiting::for_cells);
        EXPECT_FALSE(session.state().room_panel.shown);
        EXPECT_EQ(session.outputs().display().window().viewports.front().screen.aside, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, DeskPanelTest, testing::Values(stereo::ContextKind::egl),
                         context_name);

} // namespace
} // namespace isochron::app
