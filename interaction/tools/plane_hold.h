// Planes that hands move: carried and turned by a hand, or pulled along their normal and turned by
// the mouse.
#pragma once

#include "interaction/tools/tool.h"

#include <optional>
#include <span>

namespace isochron::interaction {

/// Where a ray meets a plane.
struct PlaneMeeting {
    glm::dvec3 at; ///< room
    double along;  ///< [m] from the ray's origin
};
/// The point where a ray meets the plane within the data's box or just outside it.
std::optional<PlaneMeeting> meeting_of(const Pose& ray, const Plane& plane, const ToolContext& now);

/// How hands hold a plane of a tool. A hand whose button is down holds it: the plane moves and turns
/// with the hand. The mouse pulls the plane along its normal, at the point where the mouse's ray hit
/// it; a plane that faces the user moves away as the mouse moves up. Near its outline the mouse turns
/// the plane about its middle: the point that was hit follows the ray.
class PlaneHold {
  public:
    /// Whether the mouse pulls a plane, and not the volume.
    bool pulls() const { return pulled_.has_value(); }
    /// Call once a frame in which the plane is shown. @param turns false: the mouse only pulls it
    /// @return where the plane is now
    Plane update(std::span<const ToolHand> hands, const Plane& plane, const ToolContext& now,
                 bool turns = true);
    /// Call once a frame in which no plane is shown.
    void let_go() {
        held_.reset();
        pulled_.reset();
    }

  private:
    struct Held {
        Pose hand;
        Plane plane;
    };
    /// The plane as it was when the mouse's button went down, and where the ray hit it.
    struct Pulled {
        Plane plane;
        Pose ray;
        glm::dvec3 at, normal; ///< the point that was hit and the plane's normal, in the room
        std::optional<glm::dvec3> about; ///< the middle that the plane is turned about, in the room
    };
    Plane moved_with(const ToolHand& hand, const Plane& plane, const ToolContext& now);
    Plane turned_with(const ToolHand& hand, const ToolContext& now) const;
    Plane pulled_with(const ToolHand& hand, const Plane& plane, const ToolContext& now, bool turns);

    std::optional<Held> held_;
    std::optional<Pulled> pulled_;
};

/// The way ahead of a pose, in the room.
glm::dvec3 ahead_of(const Pose& ray);
/// Unit normal of the faces at the two ends of one axis of the data's box.
glm::dvec3 across(int axis, const DataFrame& data);
/// The axis across which a plane with this unit normal lies; empty: none.
std::optional<int> axis_across(const glm::dvec3& normal, const DataFrame& data);
/// The polygon in which a plane cuts the data's box: its corners in order, in physical space; empty
/// if they do not meet.
std::vector<glm::dvec3> outline(const Plane& plane, const DataFrame& data);
/// The outline as lines.
std::vector<ToolLine> outline_lines(const Plane& plane, const DataFrame& data,
                                    const glm::vec4& color);

} // namespace isochron::interaction
