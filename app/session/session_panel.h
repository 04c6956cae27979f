// A session's panels, over the window and in the room: their places, their commands, and what they
// tell.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/output/outputs.h"
#include "app/panel/operator_panel.h"
#include "app/panel/panel_in_room.h"
#include "app/session/window_contents.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Kinds of devices that the help names: mouse and keyboard, hands if there are any, and a gamepad
/// that is connected.
std::vector<interaction::DeviceKind> kinds_at_hand(bool hands,
                                                   const interaction::InputState& input);

class SessionPanel {
  public:
    /// Share of a window's width for the panel in the room, if the head is emulated.
    static constexpr float kShare = 0.4f;

    /// What a session shows in its panels, without what `tell` adds.
    using Facts = std::function<PanelModel()>;

    /// @param config, outputs outlive the panel
    SessionPanel(const Config& config, const Outputs& outputs);

    OperatorPanel& over() { return over_; }
    const OperatorPanel& over() const { return over_; }
    PanelInRoom& in_room() { return in_room_; }
    const PanelInRoom& in_room() const { return in_room_; }

    /// Messages that can be read again.
    static constexpr std::size_t kMessagesKept = 50;
    /// Shows the last of these messages on the panel until there is a newer one.
    void show_messages(std::vector<std::string> messages);
    /// Shows this on the picture as long as it is not empty.
    void set_standing(std::string note) { standing_ = std::move(note); }
    void set_recording(bool recording) { recording_ = recording; }
    void set_movies(const MovieState& movies) { movies_ = movies; }
    /// Sets the sessions that the user can go on with, the last one first.
    void set_sessions(std::vector<OfferedSession> sessions) { sessions_ = std::move(sessions); }

    /// The commands since the last call that a replay could not compute from the devices.
    interaction::Commands take_commands();
    void add(const interaction::Commands& commands) { merge(commands_, commands); }
    /// Passes window events to the panel over the window. @return the events that it does not use
    std::vector<interaction::WindowEvent> feed(std::span<const interaction::WindowEvent> events,
                                               const ExplorerState& state);

    /// Lays the panel in the room out, if it is shown.
    void lay_out_room(const ExplorerState& state, const Facts& facts, interaction::Seconds time);
    /// Lays the panel over the first window out, unless this frame has done so.
    void lay_out_over(const ExplorerState& state, const Facts& facts, interaction::Seconds time);
    /// Lays the panel over the first window out and draws it. @param size of the window, pixels
    void draw_over(glm::ivec2 size, const ExplorerState& state, const Facts& facts,
                   interaction::Seconds time);
    /// Draws it in its own window, if it has one.
    void draw_alone(const Facts& facts, interaction::Seconds time);
    /// @param again even if they look the same, as the window system has lost what it showed
    void present(bool again) { over_.present(again); }
    /// What lies over the last picture. @param aids beside the panel
    PictureOverlay overlay(const Aids& aids) const;
    /// What the last frame tells about the next one.
    FrameOutlook outlook() const;

    /// The panel over the window is shown: the panel in the room replaces it.
    static bool is_flat(const ExplorerState& state) {
        return state.panel && !state.room_panel.shown;
    }
    /// Pixels that it covers at the edges of the first window, in each eye's part.
    stereo::Margins covered(const ExplorerState& state) const;
    /// What lies over the upper corners of the picture beside these margins, see `PictureLayout`.
    std::array<glm::vec2, 2> corners(const ExplorerState& state) const;
    /// Height of its words, as a share of the height that it leaves free in each eye's part.
    float text_share(const ExplorerState& state) const;
    /// Whether mouse and keyboard play the head, before a screen that it carries along.
    bool head_is_emulated() const;
    /// Where the panel in the room stands beside such a screen, in the head's frame: so far away
    /// that it fills its share of the window.
    std::optional<interaction::Pose> place() const;
    /// Whether the panel in the room stands where such a window has room for it. A user who turns
    /// away from the panel has the whole window for the data.
    bool stands_beside(const interaction::Pose& head, const ExplorerState& state) const;

  private:
    OperatorPanel::Model models(const Facts& facts) const;
    PanelModel told(PanelModel model, PanelPlace place) const;
    glm::ivec2 places(const ExplorerState& state) const;

    const Config& config_;
    const Outputs& outputs_;
    OperatorPanel over_;
    PanelInRoom in_room_;
    interaction::Commands commands_;
    std::vector<PastMessage> past_; ///< the last messages, newest last
    std::string standing_;
    std::size_t messages_ = 0;
    bool recording_ = false;
    MovieState movies_;
    std::vector<OfferedSession> sessions_;
};

} // namespace isochron::app
