// The ruler tool: measures distances and angles between places on surfaces.
#pragma once

#include "interaction/tools/tool.h"

#include <optional>
#include <string>

namespace isochron::interaction {

/// Each place belongs to the last ruler until this one has all its places; the next place begins
/// another ruler.
class RulerTool final : public Tool {
  public:
    ToolOutcome update(std::span<const ToolHand> hands, const ToolContext& now) override;
};

/// With one place more; as they are where a further ruler would be one too many.
Rulers with_place(Rulers rulers, const glm::dvec3& place);
/// The next one measures an angle, or a distance, and so does the last one while it lacks places.
Rulers with_angle(Rulers rulers, bool angle);
/// Without one of them, by its number.
Rulers without_ruler(Rulers rulers, std::size_t removed);

/// What a ruler measures: a distance in physical space, or an angle in degrees; nothing before it has
/// all its places, and where an angle is not defined.
std::optional<double> measured(const Ruler& ruler);
/// `12.5 mm`, `43.2\u00b0`; empty: nothing is measured.
std::string measured_text(const Ruler& ruler, const std::string& unit);

/// Lines from place to place of those that are shown, with a cross at each place and what is
/// measured; names tell several rulers apart.
ToolDrawing draw_rulers(const Settings& settings, const DataFrame& data);

/// What the panel says of them.
std::string ruler_line(const Settings& settings);

/// The places of rulers that are complete and were not before, the last one with what is measured.
std::vector<MarkedRow> ruler_rows(const Commands& commands, const Settings& before);

} // namespace isochron::interaction
