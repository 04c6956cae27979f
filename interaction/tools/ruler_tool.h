// The ruler tool: measures the distance between two places on surfaces.
#pragma once

#include "interaction/tools/tool.h"

namespace isochron::interaction {

/// The first place begins a measurement, the second one ends it, the next one begins another.
class RulerTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
};

/// A line between the two places and its length in the data's unit, with a cross at each place.
ToolDrawing draw_ruler(const Settings& settings, const DataFrame& data);

/// What the panel says of it.
std::string ruler_line(const Settings& settings);

/// Its two places once both are there, the second one with the distance from the first.
std::vector<MarkedRow> ruler_rows(const Commands& commands);

} // namespace isochron::interaction
