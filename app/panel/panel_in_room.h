// The panel that stands in the room: laid out once a frame, operated by the wand's ray, seen by
// every eye.
//
//     const auto wand = panel.outcome(input, state.room_panel);   // before the frame
//     const auto commands = commands_of(wand.rest, wand.commands);
//     panel.update(input, state.room_panel);                      // in the frame, before commands
//     panel.lay_out(model, input.time);
//     scene.set_panel(panel.shown(state.room_panel));
#pragma once

#include "app/config/panel_config.h"
#include "app/panel/panel_layer.h"
#include "app/scene/shown_panel.h"
#include "interaction/panel_pointer.h"
#include "render/passes/panel_picture.h"

#include <optional>

namespace isochron::app {

/// A layer of its own, beside the operator's panel: its mouse is the wand, which a recording holds,
/// so that devices alone explain what it does. What one frame lays out, the next one's commands
/// hold.
class PanelInRoom {
  public:
    static constexpr glm::vec2 kPixels{400.0f, 540.0f}; ///< of the panel's own, width and height

    PanelInRoom(const render::Gl& gl, const PanelConfig& config);

    interaction::PanelSize size() const { return size_; }
    float distance() const { return distance_; } ///< [m] from the eyes at which it appears

    struct Outcome {
        interaction::InputState rest;   ///< of the input, for everything but the panel
        bool touched = false;           ///< the wand's ray ends on it
        interaction::Commands commands; ///< of the frame before, and where the panel is carried
    };
    /// What devices lead to; hands the commands out once.
    Outcome outcome(const interaction::InputState& input, const interaction::RoomPanel& panel);

    /// Once a frame, with the panel as it stood in the frame before.
    /// @return what is left of the input
    interaction::InputState update(const interaction::InputState& input,
                                   const interaction::RoomPanel& panel);
    /// Then one of these: draws its picture where it has changed, or does without.
    void lay_out(const PanelModel& model, interaction::Seconds time);
    void leave_out();

    /// The wand's ray ended on it in the frame that was laid out last.
    bool touched() const { return pointer_.touch().hit.has_value(); }

    /// Nothing where it does not stand.
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
    interaction::Commands pending_;
    std::optional<interaction::Seconds> laid_out_;
    std::size_t digest_ = 0;               ///< of what the picture holds
    std::uint32_t hovered_ = 0, held_ = 0; ///< widgets that the hand has felt
};

} // namespace isochron::app
