// A mark on the surface where a ray meets it.
#pragma once

#include "interaction/tool.h"

namespace isochron::interaction {

class PickTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
};

} // namespace isochron::interaction
