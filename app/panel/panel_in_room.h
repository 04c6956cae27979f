// The panel in the room: laid out once a frame, operated by the wand's ray, visible to every eye.
//
//     const auto& wand = panel.update(input, state.room_panel);
//     const auto commands = commands_of(wand.rest, wand.commands);
//     panel.lay_out(model, input.time);
//     picture.audience.panel = panel.shown(state.room_panel);
#pragma once

#include "app/config/config.h"
#include "app/panel/imgui/panel_layer.h"
#include "app/scene/shown_panel.h"
#include "interaction/controls/panel_pointer.h"
#include "render/passes/panel_picture.h"

#include <optional>

namespace isochron::app {

/// It has its own PanelLayer, apart from the operator's panel, with the wand as its mouse.
/// Recordings hold the wand, so a replay repeats what this panel does. Commands from the layout of
/// one frame belong to the next frame.
class PanelInRoom {
  public:
    static constexpr glm::vec2 kPixels{400.0f, 540.0f}; ///< width and height in panel pixels

    PanelInRoom(const render::Gl& gl, const PanelConfig& config);

    interaction::PanelSize size() const { return size_; }
    float distance() const { return distance_; } ///< [m] from the eyes, at which it appears

    struct Outcome {
        interaction::InputState rest; ///< input that the panel does not use
        /// What the last layout led to, and the move of a carried panel.
        interaction::Commands commands;
    };
    /// Advances by one frame: what the input means for the panel, with its pose in the previous
    /// frame. Worked out once for the input of a frame: whoever asks again gets the same.
    const Outcome& update(const interaction::InputState& input,
                          const interaction::RoomPanel& panel);
    /// Then one of these: `lay_out` draws the panel's picture if it has changed; `leave_out` if the
    /// panel is not shown.
    void lay_out(const PanelModel& model, interaction::Seconds time);
    void leave_out();

    /// What the last frame tells about the next one.
    FrameOutlook outlook() const;

    /// Whether the wand's ray ended on the panel in the last `update`.
    bool touched() const { return pointer_.touch().hit.has_value(); }

    /// The panel as the eyes see it; empty if it is not shown.
    std::optional<ShownPanel> shown(const interaction::RoomPanel& panel) const;

  private:
    interaction::TouchedPanel touched(const interaction::InputState& input,
                                      const interaction::RoomPanel& panel) const;
    void feel(interaction::Commands& commands);

    const interaction::PanelSize size_;
    const float distance_;
    PanelLayer layer_;
    render::PanelPicture picture_;
    interaction::PanelPointer pointer_;
    std::optional<Outcome> outcome_; ///< what the frame's input led to, until the panel is laid out
    interaction::Commands pending_;  ///< what the last layout led to, for the next `update`
    /// The action that the search found in the last layout.
    std::optional<interaction::Action> wanted_;
    std::optional<interaction::Seconds> laid_out_;
    std::size_t digest_ = 0;               ///< digest of the picture's contents
    std::uint32_t hovered_ = 0, held_ = 0; ///< widgets for which the hand has felt a pulse
};

} // namespace isochron::app
