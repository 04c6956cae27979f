// A distance between two places on surfaces.
#pragma once

#include "interaction/tool.h"

namespace isochron::interaction {

/// The first place begins a measurement, the second one ends it, the next one begins another.
class RulerTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
};

/// The way between the places and its length in the data's units, which hold along every axis.
ToolDrawing draw_ruler(const ToolState& state, const DataFrame& data);

} // namespace isochron::interaction
