// The seam for tools: what a hand's button does with the data.
//
//     const ToolOutcome outcome = tool.update(hands, now); // once a frame
//     merge(commands, outcome.commands);
//     if (!outcome.note.empty())
//         show(outcome.note);
#pragma once

#include "interaction/control_context.h"
#include "interaction/pointed.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::interaction {

/// One hand that holds the tool: what it says in a frame.
struct ToolHand {
    bool is_mouse = false;   ///< whose ray is the eye's under the cursor
    std::optional<Pose> ray; ///< along -Z; nothing while the hand is not tracked
    bool down = false;       ///< its button
    bool pressed = false;    ///< it went down in this frame
    /// A place is meant: the button went down; of the mouse, it came up where it went down.
    bool chosen = false;
};

struct ToolContext {
    const ControlContext& session;
    Similarity room_from_physical; ///< as navigation has left it in this frame
};

struct ToolOutcome {
    Commands commands;
    std::string note; ///< for people, where there is nothing to show; may be empty
};

/// What is drawn for a tool, in the data's physical space.
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

/// Turns the readings of the hands that hold it into commands: a pure function of the sequence of
/// frames that it is given. What it has led to lies in the session's state, so that it is recorded,
/// replayed, saved and undone like everything else.
class Tool {
  public:
    virtual ~Tool() = default;
    /// Once a frame, also while no hand holds it.
    /// @param hands those that hold it; none, one or several
    virtual ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) = 0;
    /// Whether the tool takes the mouse's left drag, which else turns the volume.
    virtual bool takes_drag() const { return false; }
};

} // namespace isochron::interaction
