// Which hand holds which tool, and what comes of it.
#pragma once

#include "interaction/device_reading.h"
#include "interaction/tool.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochron::interaction {

class ToolBox {
  public:
    ToolBox();

    struct Outcome {
        Commands commands; ///< that devices alone explain
        Commands found;    ///< that what is shown has a part in
        std::vector<std::string> notes;
    };
    /// Once a frame, after navigation.
    Outcome update(const Reading& now, const ToolContext& context);

    /// Whether the mouse's left drag is a tool's in this frame, which has not been given to
    /// `update` yet.
    bool takes_drag(const Reading& now, const ControlContext& context) const;

  private:
    std::vector<ToolHand> hands_with(ToolKind kind, const Reading& now, const Tools& tools) const;
    bool clicks(const Reading& now);

    std::array<std::unique_ptr<Tool>, kNames<ToolKind>.size()> tools_;
    double dragged_ = 0;   ///< by the mouse since its left button went down, window heights
    bool clicked_ = false; ///< in this frame
};

} // namespace isochron::interaction
