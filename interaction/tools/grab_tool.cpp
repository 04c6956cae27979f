// The grab tool: one hand, or two, hold the volume.
#include "interaction/tools/grab_tool.h"

namespace isochron::interaction {

/// If the number of hands changes or anything else moves the volume, the grab begins anew from the
/// volume's present place.
Similarity GrabTool::held(const Pose& first, const std::optional<Span>& both,
                          const ToolContext& now) {
    const Similarity& volume = now.room_from_physical;
    const double home = now.session.series.home.scale;
    const bool goes_on = grab_ && grab_->span.has_value() == both.has_value() &&
                         volume == now.session.settings.room_from_physical &&
                         grab_->result == volume;
    if (!goes_on) {
        grab_ = Grab{first, both, both, {1, 0, 0, 0}, volume, volume};
    } else if (both) {
        // The turn is summed from frame to frame, so that hands may turn by more than half a
        // circle.
        grab_->turn = glm::normalize(rotation_onto(*grab_->newest, *both) * grab_->turn);
        grab_->newest = both;
        grab_->result = stretched(grab_->held, *grab_->span, *both, grab_->turn, home / kScaleRange,
                                  home * kScaleRange);
    } else {
        grab_->result = carried(grab_->held, grab_->hand, first);
    }
    return grab_->result;
}

ToolOutcome GrabTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    std::optional<Pose> first;
    std::optional<Span> both;
    for (const ToolHand& hand : hands) {
        if (hand.is_mouse || !hand.down || !hand.ray)
            continue;
        if (first)
            both = Span{first->position, hand.ray->position};
        else
            first = hand.ray;
    }
    ToolOutcome outcome;
    if (!first) {
        grab_.reset();
        return outcome;
    }
    const Similarity volume = held(*first, both, now);
    if (is_valid(volume) && volume != now.session.settings.room_from_physical)
        outcome.commands.room_from_physical = volume;
    return outcome;
}

} // namespace isochron::interaction
