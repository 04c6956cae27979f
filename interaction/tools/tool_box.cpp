// Passes each hand's readings to the tool that it holds.
#include "interaction/tools/tool_box.h"

#include "interaction/tools/tool_table.h"

#include <cmath>

namespace isochron::interaction {
namespace {

constexpr double kStill = 0.008; ///< [window heights] longest drag that is still a click

bool left_down(const Reading& now) {
    return (Reading::buttons(now.mouse) & bit(MouseBit::left)) != 0;
}
bool left_before(const Reading& now) {
    return (now.before.mouse & bit(MouseBit::left)) != 0;
}

ToolHand hand_of(const std::optional<Pose>& ray, bool down, bool before) {
    return {false, ray, down, down && !before, down && !before};
}

} // namespace

ToolBox::ToolBox() {
    for (const ToolRow& row : tool_table())
        tools_[static_cast<std::size_t>(row.kind)] = row.make();
}

/// Whether the left button came up in this frame, about where it went down.
bool ToolBox::clicks(const Reading& now) {
    if (left_down(now) && !left_before(now))
        dragged_ = 0;
    dragged_ += std::abs(now.drag(MouseBit::left, 0)) + std::abs(now.drag(MouseBit::left, 1));
    return !left_down(now) && left_before(now) && dragged_ < kStill;
}

std::vector<ToolHand> ToolBox::hands_with(ToolKind kind, const Reading& now,
                                          const Tools& tools) const {
    std::vector<ToolHand> hands;
    if (tools.wand == kind)
        hands.push_back(hand_of(Reading::hand(now.wand),
                                now.wand_button(WandButton::grab) || now.pad(GamepadButton::y),
                                (now.before.wand & bit(WandButton::grab)) != 0 ||
                                    (now.before.gamepad & bit(GamepadButton::y)) != 0));
    if (tools.other == kind)
        hands.push_back(hand_of(Reading::hand(now.other),
                                (Reading::buttons(now.other) & bit(WandButton::grab)) != 0,
                                (now.before.other & bit(WandButton::grab)) != 0));
    if (tools.mouse == kind)
        hands.push_back({true, Reading::hand(now.pointer), left_down(now),
                         left_down(now) && !left_before(now), clicked_});
    // Picking also has its own button and key, whatever tools the hands hold.
    if (kind == ToolKind::pick)
        hands.push_back(hand_of(now.picking_ray(),
                                now.key(Action::pick) || now.wand_button(WandButton::pick),
                                holds(now.before.keys, Action::pick) ||
                                    (now.before.wand & bit(WandButton::pick)) != 0));
    return hands;
}

bool ToolBox::takes_drag(const Reading& now, const ControlContext& context) const {
    const ToolRow& row = tool_row(context.settings.tools.mouse);
    const bool may_begin =
        row.held && row.made(context.settings) && left_down(now) && !left_before(now);
    return tools_[static_cast<std::size_t>(row.kind)]->takes_drag() || may_begin;
}

ToolBox::Outcome ToolBox::update(const Reading& now, const ToolContext& context) {
    clicked_ = clicks(now);
    Outcome all;
    for (const ToolRow& row : tool_table()) {
        ToolOutcome outcome = tools_[static_cast<std::size_t>(row.kind)]->update(
            hands_with(row.kind, now, context.session.settings.tools), context);
        merge(row.looks_at_surfaces ? all.found : all.commands, outcome.commands);
        if (!outcome.note.empty())
            all.notes.push_back(std::move(outcome.note));
    }
    return all;
}

} // namespace isochron::interaction
