// Passes each hand's readings to the tool that it holds, and collects the results.
#pragma once

#include "interaction/input/device_reading.h"
#include "interaction/tools/tool.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochron::interaction {

class ToolBox {
  public:
    ToolBox();

    struct Outcome {
        Commands commands; ///< commands that depend on devices alone
        Commands found;    ///< commands that depend on the surfaces shown, too
        std::vector<std::string> notes;
    };
    /// Call once a frame, after navigation.
    Outcome update(const Reading& now, const ToolContext& context);

    /// Whether a tool takes the mouse's left drag in this frame. Call it before `update`.
    bool takes_drag(const Reading& now, const ControlContext& context) const;

  private:
    std::vector<ToolHand> hands_with(ToolKind kind, const Reading& now, const Tools& tools) const;
    bool clicks(const Reading& now);

    std::array<std::unique_ptr<Tool>, kNames<ToolKind>.size()> tools_;
    double dragged_ = 0;   ///< by the mouse since its left button went down, window heights
    bool clicked_ = false; ///< in this frame
};

} // namespace isochron::interaction
