// From the wand's ray to the panel's mouse, and from its clicks to commands.
#include "app/panel/panel_in_room.h"

#include "interaction/input/actions.h"
#include "interaction/input/device_reading.h"

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::RoomPanel;
using interaction::Seconds;

/// Picture pixels per panel pixel: at 0.65 m this matches a headset with 25 pixels per degree.
constexpr float kScale = 2.5f;
constexpr double kScroll = 12.0; ///< [notch/s] of the wheel, with the stick pushed all the way
const interaction::HapticPulse kTick{"wand", 0.01, 0.25f}, kClick{"wand", 0.02, 0.6f};

/// As if the action's key were down in this frame.
void press(interaction::Action action, interaction::InputState& input) {
    const auto keys = std::ranges::find(input.devices, "keys", &interaction::DeviceState::name);
    if (keys != input.devices.end())
        keys->actions |= interaction::bit(action);
    else
        input.devices.push_back(
            {.name = "keys", .pose = {}, .valuators = {}, .actions = bit(action)});
}

} // namespace

PanelInRoom::PanelInRoom(const render::Gl& gl, const PanelConfig& config)
    : size_{config.width, config.width * kPixels.y / kPixels.x}, distance_(config.distance),
      layer_(gl, kScale), picture_(gl, glm::ivec2(kScale * kPixels)) {}

interaction::TouchedPanel PanelInRoom::touched(const interaction::InputState& input,
                                               const RoomPanel& panel) const {
    return {panel, size_, layer_.layout().top.low.y / kPixels.y,
            interaction::Reading(input).viewer().position};
}

const PanelInRoom::Outcome& PanelInRoom::update(const interaction::InputState& input,
                                                const RoomPanel& panel) {
    if (outcome_ && outcome_->rest.time == input.time)
        return *outcome_;
    pointer_.update(input, touched(input, panel));
    outcome_ = {pointer_.rest_of(input), std::exchange(pending_, {})};
    if (const auto action = std::exchange(wanted_, {}))
        press(*action, outcome_->rest);
    const auto& carried = pointer_.carried();
    if (carried && *carried != panel.pose)
        outcome_->commands.room_panel = RoomPanel{panel.shown, *carried};
    return *outcome_;
}

void PanelInRoom::feel(Commands& commands) {
    const std::uint32_t hovered = layer_.hovered(), held = layer_.held();
    if (held != 0 && held != held_)
        commands.haptics.push_back(kClick);
    else if (hovered != 0 && hovered != hovered_ && held == 0)
        commands.haptics.push_back(kTick);
    hovered_ = hovered;
    held_ = held;
}

void PanelInRoom::leave_out() {
    outcome_.reset();
    pending_ = {};
    wanted_.reset();
    laid_out_.reset();
}

void PanelInRoom::lay_out(const PanelModel& model, Seconds time) {
    outcome_.reset();
    const Seconds elapsed = laid_out_ ? time - *laid_out_ : Seconds(0);
    laid_out_ = time;
    const interaction::PanelTouch& touch = pointer_.touch();
    std::optional<glm::vec2> at;
    if (touch.hit)
        at = kPixels * touch.hit->at;
    // While the hand carries the panel it does not press its widgets.
    const bool pressed = touch.pressed && !pointer_.carried();
    layer_.point(at, pressed,
                 static_cast<float>(touch.notches + touch.scroll * kScroll * elapsed.count()));
    pending_ = layer_.lay_out(picture_.size(), model, time);
    wanted_ = layer_.pages().take_action();
    feel(pending_);
    if (const std::size_t digest = layer_.digest(); digest != std::exchange(digest_, digest)) {
        picture_.begin();
        layer_.draw(picture_.size());
        picture_.end();
    }
}

FrameOutlook PanelInRoom::outlook() const {
    FrameOutlook next{.final = true};
    if (laid_out_)
        next = layer_.outlook();
    next.changed |= wanted_ || pending_ != Commands{}; // which the next frame obeys
    return next;
}

std::optional<ShownPanel> PanelInRoom::shown(const RoomPanel& panel) const {
    if (!panel.shown)
        return std::nullopt;
    ShownPanel result{.quad = {.corners = corners_of(panel.pose, size_),
                               .texture = picture_.texture(),
                               .dot = {}},
                      .digest = digest_,
                      .ray = {}};
    if (const auto& hit = pointer_.touch().hit) {
        result.ray = hit->distance;
        if (hit->inside())
            result.quad.dot = hit->at;
    }
    return result;
}

} // namespace isochron::app
