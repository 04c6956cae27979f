// The interface of tools: what a hand's button does with the data.
//
//     const ToolOutcome outcome = tool.update(hands, now); // once a frame
//     merge(commands, outcome.commands);
//     if (!outcome.note.empty())
//         show(outcome.note);
#pragma once

#include "interaction/control_context.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::interaction {

/// One hand that holds the tool, in one frame.
struct ToolHand {
    bool is_mouse = false;   ///< the mouse; its ray is the eye's ray through the cursor
    std::optional<Pose> ray; ///< along -Z; nothing while the hand is not tracked
    bool down = false;       ///< its button is down
    bool pressed = false;    ///< its button went down in this frame
    /// The ray chooses a place in this frame: a hand's button went down, or the mouse clicked (its
    /// button came up where it went down).
    bool chosen = false;
};

struct ToolContext {
    const ControlContext& session;
    Similarity room_from_physical; ///< after this frame's navigation
};

struct ToolOutcome {
    Commands commands;
    std::string note; ///< message for people, such as that no surface is there; may be empty
};

/// A line that is drawn for a tool, in the data's physical space.
struct ToolLine {
    glm::dvec3 from, to;
    glm::vec4 color{1.0f}; ///< sRGB and opacity
    bool operator==(const ToolLine&) const = default;
};
struct ToolLabel {
    glm::dvec3 at;
    std::string text; ///< UTF-8
    bool operator==(const ToolLabel&) const = default;
};
struct ToolDrawing {
    std::vector<ToolLine> lines;
    std::vector<ToolLabel> labels;
    bool operator==(const ToolDrawing&) const = default;
};

/// A place that a tool has marked, as a row of `isochron table`.
struct MarkedRow {
    glm::dvec3 position; ///< physical space
    std::optional<double> value = {};
    std::optional<Instant> at = {}; ///< nothing: the instant that was shown
    std::string name = {};
};

/// Turns the readings of the hands that hold it into commands. It depends only on the frames that
/// it is given. Its results are kept in the session's state, so they are recorded, replayed, saved
/// and undone like everything else.
class Tool {
  public:
    virtual ~Tool() = default;
    /// Call once a frame, also while no hand holds the tool.
    /// @param hands the hands that hold it; none, one or several
    virtual ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) = 0;
    /// Whether the tool takes the mouse's left drag, which otherwise turns the volume.
    virtual bool takes_drag() const { return false; }
};

} // namespace isochron::interaction
