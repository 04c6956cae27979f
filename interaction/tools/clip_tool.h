// The clip plane: cuts the surfaces open to show their inside.
#pragma once

#include "interaction/tools/tool.h"

namespace isochron::interaction {

/// While no plane is shown, choosing a place on a surface lays a plane through it, across the ray;
/// the side towards the hand is cut away. While one is shown, a hand whose button is down holds it:
/// the plane moves and turns with the hand. The mouse pulls the plane along its normal, at the
/// point where the mouse's ray hit it; a plane that faces the user moves away as the mouse moves up.
class ClipTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
    bool takes_drag() const override { return pulled_.has_value(); }

  private:
    struct Held {
        Pose hand;
        ClipPlane plane;
    };
    /// The plane as it was when the mouse's button went down, and where the ray hit it.
    struct Pulled {
        ClipPlane plane;
        Pose ray;
        glm::dvec3 at, normal; ///< the point that was hit and the plane's normal, in the room
    };
    void move_with(const ToolHand& hand, const ToolContext& now, Commands& commands);
    void pull_with(const ToolHand& hand, const ToolContext& now, Commands& commands);

    std::optional<Held> held_;
    std::optional<Pulled> pulled_;
};

/// The plane through a place, across a direction in the room; the side that it comes from is cut away.
/// @param place in physical space @param ahead of any length but 0
ClipPlane laid_through(const glm::dvec3& place, const Similarity& room_from_physical,
                       const glm::dvec3& ahead);

/// The plane turned across one of the data's axes. It keeps its point; a plane that is not shown
/// goes through the middle of the data. It cuts away the part towards the axis's higher end; a
/// plane that already did so cuts away the other part. @param axis 0 to 2
ClipPlane snapped(const ClipPlane& plane, int axis, const DataFrame& data);

/// `snapped` across the axis after the plane's current one; across the first if it has none.
ClipPlane snapped_next(const ClipPlane& plane, const DataFrame& data);

/// The plane that cuts away the other side.
ClipPlane flipped(ClipPlane plane);

/// Its outline on the data's box.
ToolDrawing draw_clip(const Settings& settings, const DataFrame& data);

/// The polygon in which a plane cuts the data's box: its corners in order, in physical space; empty
/// if they do not meet.
std::vector<glm::dvec3> outline(const ClipPlane& plane, const DataFrame& data);

} // namespace isochron::interaction
