// Navigation: mouse, keys, sticks and gamepad move the volume.
#include "interaction/navigation/navigator.h"

#include "interaction/navigation/axis_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::interaction {
namespace {

constexpr double kHigher = 1.25;          ///< factor of one press
constexpr double kOrbit = 3.14159265;     ///< [rad per window height dragged]
constexpr double kViewHeight = 0.966;     ///< window height at distance 1, for a view of 0.9 rad
constexpr double kNotch = 1.1;            ///< scale per notch of the wheel
constexpr double kWheelSmallest = 20;     ///< times smaller than at home, and no further
constexpr double kWheelLargest = 100;     ///< times larger
constexpr double kFlySpeed = 1.0;         ///< [m/s]
constexpr double kTurnSpeed = 1.2;        ///< [rad/s]
constexpr double kTurnStep = 0.523598776; ///< [rad] of a snap turn: 30 degrees
constexpr double kTurnAt = 0.7;           ///< deflection above which a snap turn happens
constexpr double kTurnAgain = 0.3;        ///< deflection below which the next one is armed
constexpr double kGrowth = 2.0;           ///< scale per second
constexpr double kTeleportReach = 20.0;   ///< [m] of the wand's ray
constexpr double kAheadOf = 0.6;          ///< [rad] off the heading that still counts as ahead
constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);  ///< up in the room

/// Whether the head's pose is finite; otherwise nothing is turned about it.
bool can_see(const Reading& now) {
    return is_finite(now.viewer());
}

Similarity dragged(const Reading& now, const ControlContext& context, bool left_taken,
                   Similarity volume) {
    const glm::dquat view = glm::normalize(glm::dquat(now.viewer().orientation));
    const glm::dvec3 right = view * glm::dvec3(1, 0, 0);
    const glm::dvec3 center = transform(volume, context.series.pivot);
    glm::dvec2 orbit(0.0);
    if (!left_taken)
        orbit = {now.drag(MouseBit::left, 0), now.drag(MouseBit::left, 1)};
    glm::dvec2 move(now.drag(MouseBit::middle, 0), now.drag(MouseBit::middle, 1));
    if (now.key(Action::shift)) {
        move += orbit;
        orbit = glm::dvec2(0);
    }
    if (orbit.x != 0)
        volume = turned(volume, center, kUp, kOrbit * orbit.x);
    if (orbit.y != 0)
        volume = turned(volume, center, right, kOrbit * orbit.y);
    if (move != glm::dvec2(0)) {
        const double distance = glm::length(center - glm::dvec3(now.viewer().position));
        const glm::dvec3 up = view * kUp;
        volume = moved(volume, distance * kViewHeight * (move.x * right - move.y * up));
    }
    return volume;
}

Similarity flown(const Reading& now, Similarity volume, double seconds) {
    const double speed = kFlySpeed * (now.key(Action::shift) ? kHurry : 1.0);
    const double along = now.wand_rate(WandValuator::fly) + now.wand_button(WandButton::fly);
    glm::dvec3 velocity(0.0); // velocity of the viewer through the volume
    if (const auto wand = Reading::hand(now.wand); wand && along != 0)
        velocity += glm::normalize(glm::dquat(wand->orientation)) * glm::dvec3(0, 0, -1) * along;
    const glm::dvec3 stick(now.axis(GamepadAxis::left_x), -now.axis(GamepadAxis::right_y),
                           now.axis(GamepadAxis::left_y));
    if (stick != glm::dvec3(0))
        velocity += glm::angleAxis(heading(now.viewer()), kUp) * stick;
    if (velocity != glm::dvec3(0))
        volume = moved(volume, -speed * seconds * velocity);
    const double turn = now.axis(GamepadAxis::right_x);
    if (turn != 0)
        volume =
            turned(volume, glm::dvec3(now.viewer().position), kUp, kTurnSpeed * turn * seconds);
    return volume;
}

/// The room point about which the wheel makes the volume larger: under the cursor, as far away as the
/// data's center; without a cursor that center.
glm::dvec3 zoomed_about(const Reading& now, const glm::dvec3& center) {
    constexpr double kBeside = 0.1; // cosine to the way ahead, below which rays lead nowhere
    const auto eye = Reading::hand(now.pointer);
    if (!eye || !can_see(now))
        return center;
    const auto ahead_of = [](const Pose& pose) {
        return glm::normalize(glm::dquat(pose.orientation)) * glm::dvec3(0, 0, -1);
    };
    const glm::dvec3 ahead = ahead_of(now.viewer()), way = ahead_of(*eye), from(eye->position);
    const double depth = glm::dot(center - from, ahead), rate = glm::dot(way, ahead);
    return depth > 0 && rate > kBeside ? from + depth / rate * way : center;
}

Similarity resized(const Reading& now, const ControlContext& context, const Similarity& volume,
                   double seconds) {
    const double notches =
        now.key(Action::control) ? 0.0 : Reading::valuator(now.mouse, kMouseWheel);
    const double rate = now.wand_rate(WandValuator::scale);
    if (notches == 0 && rate == 0)
        return volume;
    const glm::dvec3 center = transform(volume, context.series.pivot);
    const double home = context.series.home.scale;
    if (rate != 0)
        return scaled(volume, center, std::pow(kNotch, notches) * std::pow(kGrowth, rate * seconds),
                      home / kScaleRange, home * kScaleRange);
    // A volume that was made larger or smaller still by other means stays so.
    return scaled(volume, zoomed_about(now, center), std::pow(kNotch, notches),
                  std::min(home / kWheelSmallest, volume.scale),
                  std::max(home * kWheelLargest, volume.scale));
}

/// `home` moved and turned so that it lies to the viewer's present place and heading as it lies to
/// the room's origin and -Z; heights stay.
Similarity recentered(const Similarity& home, const Pose& viewer) {
    const glm::dvec3 place(viewer.position.x, 0, viewer.position.z);
    return moved(turned(home, glm::dvec3(0), kUp, heading(viewer)), place);
}

/// The saved viewpoint after the current one; the first if the volume is at none of them.
std::optional<Similarity> next_view(const Settings& settings) {
    const std::vector<Viewpoint>& views = settings.views;
    if (views.empty())
        return std::nullopt;
    const auto at =
        std::ranges::find(views, settings.room_from_physical, &Viewpoint::room_from_physical);
    const bool first = at == views.end() || at + 1 == views.end();
    return (first ? views.begin() : at + 1)->room_from_physical;
}

bool aims(const Reading& now) {
    return now.key(Action::teleport) || now.wand_button(WandButton::teleport);
}

/// The place on the floor under the eye's ray through the cursor, or else under the wand's ray.
std::optional<glm::dvec3> aimed_at(const Reading& now) {
    const auto eye = Reading::hand(now.pointer);
    const auto ray = eye ? eye : Reading::hand(now.wand);
    return ray ? floor_point(*ray, kTeleportReach) : std::nullopt;
}

/// The volume turned about the viewer so that the data are ahead, if they would be beside or behind
/// the viewer. A viewer who stands in the data, or nearly, sees them anyway.
Similarity kept_in_sight(const Similarity& volume, const ControlContext& context,
                         const Pose& viewer) {
    glm::dvec3 way = transform(volume, context.series.pivot) - glm::dvec3(viewer.position);
    way.y = 0;
    const double size = context.data.longest_side() * volume.scale;
    if (glm::length(way) < 0.75 * size)
        return volume;
    const double off = std::atan2(-way.x, -way.z) - heading(viewer);
    const double angle = std::remainder(off, 2 * 3.14159265358979);
    return std::abs(angle) < kAheadOf ? volume
                                      : turned(volume, glm::dvec3(viewer.position), kUp, -angle);
}

} // namespace

std::optional<glm::dvec3> teleport_target(const InputState& input) {
    const Reading now(input);
    return aims(now) ? aimed_at(now) : std::nullopt;
}

/// The volume's place if a button asks for one: home, recentered, a viewpoint, an axis view, or the
/// same with other heights.
std::optional<Similarity> Navigator::chosen(const Reading& now, const ControlContext& context) {
    if (now.pressed(Action::reset) || now.pressed(GamepadButton::x))
        return context.series.home;
    if (can_see(now) && (now.pressed(Action::recenter) || now.pressed(WandButton::recenter) ||
                         now.pressed(GamepadButton::left_thumb)))
        return recentered(context.series.home, now.viewer());
    if (now.pressed(Action::next_view) || now.pressed(WandButton::next_view) ||
        now.pressed(GamepadButton::right_thumb))
        return next_view(context.settings);
    const bool axis = now.pressed(Action::axis_view);
    if (can_see(now) && (axis || now.pressed(Action::isometric_view))) {
        const std::size_t view =
            axis ? axis_view_after(context.settings.room_from_physical, now.viewer()) : kIsometric;
        return seen_from(axis_views()[view], context.settings.room_from_physical,
                         context.series.pivot, now.viewer());
    }
    const bool higher = now.pressed(Action::exaggerate);
    if (higher || now.pressed(Action::flatten)) {
        const double exaggeration = context.settings.room_from_physical.exaggeration;
        return exaggerated(context.settings.room_from_physical, context.series.pivot,
                           higher ? exaggeration * kHigher : exaggeration / kHigher);
    }
    return std::nullopt;
}

/// Snap turns about the viewer. The valuator turns once, and must go back before it turns again.
Similarity Navigator::stepped(const Reading& now, Similarity volume) {
    const double deflection = now.wand_rate(WandValuator::turn);
    double steps = 0; // to the right
    if (std::abs(deflection) < kTurnAgain)
        turn_armed_ = true;
    if (turn_armed_ && std::abs(deflection) > kTurnAt) {
        turn_armed_ = false;
        steps += std::copysign(1.0, deflection);
    }
    steps += static_cast<double>(now.pressed(Action::turn_right)) -
             static_cast<double>(now.pressed(Action::turn_left));
    // When the viewer turns to the right, the volume turns to the left.
    return steps == 0 || !can_see(now)
               ? volume
               : turned(volume, glm::dvec3(now.viewer().position), kUp, kTurnStep * steps);
}

/// While the button is held, a ray chooses a place on the floor; releasing the button moves that
/// place to the viewer's feet.
Similarity Navigator::teleported(const Reading& now, const ControlContext& context,
                                 const Similarity& volume) {
    if (aims(now)) {
        teleport_target_ = aimed_at(now);
        return volume;
    }
    const auto target = std::exchange(teleport_target_, std::nullopt);
    if (!target || !can_see(now))
        return volume;
    const glm::vec3 eyes = now.viewer().position;
    return kept_in_sight(moved(volume, glm::dvec3(eyes.x, 0, eyes.z) - *target), context,
                         now.viewer());
}

Similarity Navigator::update(const Reading& now, const ControlContext& context, double seconds,
                             bool drag_taken) {
    Similarity volume = context.settings.room_from_physical;
    if (const auto place = chosen(now, context)) {
        teleport_target_.reset();
        volume = *place;
    } else {
        volume = dragged(now, context, drag_taken, volume);
        volume = flown(now, volume, seconds);
        volume = stepped(now, volume);
        volume = teleported(now, context, volume);
        volume = resized(now, context, volume, seconds);
    }
    return is_valid(volume) ? volume : context.settings.room_from_physical;
}

std::vector<Viewpoint> with_view(std::vector<Viewpoint> views, const Similarity& place) {
    std::size_t number = 1;
    const auto name = [&] { return fmt::format("view-{}", number); };
    while (std::ranges::find(views, name(), &Viewpoint::name) != views.end())
        ++number;
    if (views.size() == kMostViews)
        views.erase(views.begin());
    views.push_back({name(), place});
    return views;
}

} // namespace isochron::interaction
