// The pick tool: marks the place where a ray meets a surface.
#pragma once

#include "interaction/tools/tool.h"

namespace isochron::interaction {

class PickTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
};

/// The place that these commands have marked.
std::vector<MarkedRow> mark_rows(const Commands& commands, const Settings& before);

} // namespace isochron::interaction
