// Lets the wand operate the panel in the room, and keeps that input from the world.
//
//     pointer.update(input, panel);                 // once a frame
//     show(pointer.touch());                        // where it points, whether it presses
//     navigate(pointer.rest_of(input));             // without what the panel has taken
#pragma once

#include "interaction/controls/room_panel.h"
#include "interaction/input/device_reading.h"
#include "interaction/input/tracked_input.h"

#include <optional>

namespace isochron::interaction {

struct TouchedPanel {
    RoomPanel panel;
    PanelSize size;
    float title = 0;      ///< height of the title, by which it is carried, as a fraction of `size`
    glm::vec3 eyes{0.0f}; ///< the panel stays turned to them while it is carried
};

/// The wand's input for the panel in one frame.
struct PanelTouch {
    std::optional<PanelHit> hit; ///< may lie beside the panel while something is dragged
    bool pressed = false;
    double scroll = 0;  ///< rate by the stick, -1 to 1, up positive
    double notches = 0; ///< notches of the mouse's wheel, up positive
};

/// A button that goes down while the ray meets the panel belongs to the panel until it is let go;
/// any other belongs to the world. So a slider can be dragged with the ray off the panel, and a
/// volume that is held is kept when the ray passes over the panel. Depends only on its inputs.
class PanelPointer {
  public:
    void update(const InputState& input, const TouchedPanel& touched);

    const PanelTouch& touch() const { return touch_; }
    /// The panel's new pose while it is carried by its title; else none.
    const std::optional<Pose>& carried() const { return carried_; }
    /// The input without the buttons, stick and wheel that the panel has taken.
    InputState rest_of(InputState input) const;

  private:
    struct Grip {
        glm::vec2 at;   ///< place on the panel, as in `PanelHit`
        float distance; ///< [m] along the ray
    };

    ButtonLevels before_;
    std::uint64_t taken_ = 0;     ///< buttons that went down on the panel and still are
    bool stick_in_world_ = false; ///< the stick was pushed before the ray came to the panel
    bool takes_stick_ = false;
    std::optional<Grip> grip_;
    PanelTouch touch_;
    std::optional<Pose> carried_;
};

} // namespace isochron::interaction
