// A plane that cuts the surfaces, so that one sees what is inside.
#pragma once

#include "interaction/tool.h"

namespace isochron::interaction {

/// Where there is no plane, a chosen place lays one through it that faces the viewer. Else a hand
/// that closes holds the plane: it moves and turns with it; the mouse pulls it along its normal by
/// where its ray meets it.
class ClipTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
    bool takes_drag() const override { return pulled_.has_value(); }

  private:
    struct Held {
        Pose hand;
        ClipPlane plane;
    };
    /// Room distances along the plane's normal.
    struct Pulled {
        ClipPlane plane;
        glm::dvec3 at, normal; ///< of the place that is pulled, in the room
    };
    void move_with(const ToolHand& hand, const ToolContext& now, Commands& commands);
    void pull_with(const ToolHand& hand, const ToolContext& now, Commands& commands);

    std::optional<Held> held_;
    std::optional<Pulled> pulled_;
};

/// Through the middle of the data, across one of its axes; the part towards its higher end is cut
/// away. Of a plane that lies across that axis already, the other part. @param axis 0 to 2
ClipPlane snapped(const ClipPlane& plane, int axis, const DataFrame& data);

/// Across the axis after the one that it lies across; the first one where it lies across none.
ClipPlane snapped_next(const ClipPlane& plane, const DataFrame& data);

/// Its outline on the data's box.
ToolDrawing draw_clip(const ToolState& state, const DataFrame& data);

/// Where a plane cuts the data's box: the corners in order around, physical space; none where it
/// does not.
std::vector<glm::dvec3> outline(const ClipPlane& plane, const DataFrame& data);

} // namespace isochron::interaction
