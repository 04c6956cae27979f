// A wand that operates the panel in the room, and what is left of it for the world.
//
//     pointer.update(input, panel);                 // once a frame
//     show(pointer.touch());                        // where it points, whether it presses
//     navigate(pointer.rest_of(input));             // the panel's share is taken out
#pragma once

#include "interaction/device_reading.h"
#include "interaction/room_panel.h"
#include "interaction/tracked_input.h"

#include <optional>

namespace isochron::interaction {

struct TouchedPanel {
    RoomPanel panel;
    PanelSize size;
    float title = 0;      ///< share of the height, at the top, by which it is carried
    glm::vec3 eyes{0.0f}; ///< to which it stays turned while it is carried
};

/// What a panel is told in a frame.
struct PanelTouch {
    std::optional<PanelHit> hit; ///< may lie beside the panel while something is dragged
    bool pressed = false;
    double scroll = 0;  ///< -1 to 1, up positive: a rate, of the stick
    double notches = 0; ///< of the mouse's wheel, up positive
};

/// A button belongs to what the ray met when it went down, until it is let go: a slider that is
/// dragged stays with the panel however far the hand strays, and a world that is held stays with
/// the hand when the ray passes over the panel. Pure function of what it is given.
class PanelPointer {
  public:
    void update(const InputState& input, const TouchedPanel& touched);

    const PanelTouch& touch() const { return touch_; }
    /// Where the panel comes to while it is carried by its title.
    const std::optional<Pose>& carried() const { return carried_; }
    /// The input without what the panel has taken of it.
    InputState rest_of(InputState input) const;

  private:
    struct Grip {
        glm::vec2 at;   ///< of the panel
        float distance; ///< [m] along the ray
    };

    ButtonLevels before_;
    std::uint64_t taken_ = 0;     ///< buttons that went down on the panel and still are
    bool stick_in_world_ = false; ///< it was pushed before the ray came to the panel
    bool takes_stick_ = false;
    std::optional<Grip> grip_;
    PanelTouch touch_;
    std::optional<Pose> carried_;
};

} // namespace isochron::interaction
