// The clip plane: cuts the surfaces open to show their inside.
#pragma once

#include "interaction/tools/clip_box.h"
#include "interaction/tools/plane_hold.h"

namespace isochron::interaction {

/// While no plane is shown, choosing a place on a surface lays a plane through it, across the ray;
/// the side towards the hand is cut away. While one is shown, hands hold it (`PlaneHold`). While the
/// clip box is shown, a hand whose ray meets one of its faces moves that face.
class ClipTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
    bool takes_drag() const override { return hold_.pulls(); }

  private:
    std::optional<ClipBox> moved_box(std::span<const ToolHand> hands, const ToolContext& now);

    PlaneHold hold_;
    std::optional<BoxFace> face_; ///< face of the box that is held in the place of the plane
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

} // namespace isochron::interaction
