// A session with the panel in the room, and a wand that points at it.
#pragma once

#include "tests/support/session_fixture.h"

#include "interaction/controls/room_panel.h"

namespace isochron::app {

using interaction::Commands;
using interaction::InputState;
using interaction::Pose;

constexpr glm::ivec2 kWindow(1200, 600); ///< both eyes, side by side

/// A wall before the viewer, side by side, with the panel from the start.
inline Config panel_config(glm::ivec2 window) {
    Config config = small_config(stereo::StereoMode::side_by_side);
    config.installation.windows.front().size = window;
    stereo::Screen& screen = config.installation.windows.front().viewports.front().screen;
    screen = {{-1, 0.5f, -1}, {-1, 2.5f, -1}, {1, 2.5f, -1}, false, false};
    config.installation.viewers.front().position = {0.0f, 1.5f, 0.0f};
    config.start.room_panel.shown = true;
    config.rendering.samples = 1;
    config.rendering.blending = Blending::display;
    return config;
}

class RoomPanelTest : public SessionTest {
  protected:
    RoomPanelTest() { context_ = stereo::make_context(GetParam(), {.size = kWindow}); }

    /// A hand at the right of the viewer, whose ray meets the panel at fractions from the top left.
    static interaction::DeviceState wand_at(const Session& session, glm::vec2 at,
                                            std::uint64_t buttons = 0) {
        const glm::vec3 hand(0.22f, 1.2f, -0.3f);
        const glm::vec3 target =
            interaction::place_on(session.state().room_panel.pose, session.room_panel_size(), at);
        interaction::DeviceState wand;
        wand.name = "wand";
        wand.pose = Pose{hand, glm::quatLookAt(glm::normalize(target - hand), glm::vec3(0, 1, 0))};
        wand.buttons = buttons;
        return wand;
    }

    InputState input() { return head_at_rest(frame_++ / 60.0); }

    /// Frames until nothing in the picture changes any more.
    void settle(Session& session, const Commands& commands,
                const std::optional<glm::vec2>& at = glm::vec2(0.4f, 0.3f)) {
        Commands now = commands;
        for (int i = 0; i < 40; ++i, now = {}) {
            InputState state = input();
            if (at)
                state.devices.push_back(wand_at(session, *at));
            if (session.frame(state, now, Waiting::for_cells).final)
                break;
        }
    }

    int frame_ = 0;
};

} // namespace isochron::app
