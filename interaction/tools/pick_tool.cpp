// The pick tool: marks the place where a ray meets a surface.
#include "interaction/tools/pick_tool.h"

namespace isochron::interaction {
namespace {

const HapticPulse kFound{"wand", 0.04, 0.8f};

} // namespace

ToolOutcome PickTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    ToolOutcome outcome;
    for (const ToolHand& hand : hands) {
        if (!hand.chosen || !hand.ray || !now.session.find_surface)
            continue;
        const auto found = now.session.find_surface(*hand.ray);
        if (found)
            outcome.commands.haptics.push_back(kFound);
        else
            outcome.note = "no surface there";
        // A click beside the surfaces removes the mark; without a mark it gives no command.
        if (found || now.session.settings.mark.point)
            outcome.commands.mark = found ? Mark{found->point} : Mark{};
    }
    return outcome;
}

std::vector<MarkedRow> mark_rows(const Commands& commands, const Settings&) {
    if (!commands.mark || !commands.mark->point)
        return {};
    const MarkedPoint& point = *commands.mark->point;
    return {{point.position, point.value, point.instant}};
}

} // namespace isochron::interaction
