// Turns device states into commands.
#include "interaction/controls.h"

#include "interaction/actions.h"
#include "interaction/navigation.h"
#include "interaction/playback.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

constexpr double kLongestFrame = 0.1;    ///< [s] for rates: a stall must not become a leap
constexpr double kLongestPlayback = 1.0; ///< [s] time plays on through slow frames
constexpr double kOrbit = 3.14159265;    ///< [rad per window height dragged]
constexpr double kViewHeight = 0.966;    ///< window height at distance 1, for a view of 0.9 rad
constexpr double kNotch = 1.1;           ///< scale per notch of the wheel
constexpr double kFlySpeed = 1.0;        ///< [m/s]
constexpr double kTurnSpeed = 1.2;       ///< [rad/s]
constexpr double kGrowth = 2.0;          ///< scale per second
constexpr double kScaleRange = 1e3;      ///< either way of the home scale
constexpr double kRangeSeconds = 4.0;    ///< isovalue: whole range at full deflection
constexpr double kCoarse = 0.01;         ///< isovalue per key press, of the range
constexpr double kFine = 0.001;          ///< and with Shift or by the wheel
constexpr float kEyeStep = 0.001f;       ///< [m]
constexpr Seconds kRepeatDelay{0.4};     ///< a held key repeats after this
constexpr Seconds kRepeatInterval{0.05}; ///< and then this often
constexpr glm::dvec3 kUp(0.0, 1.0, 0.0); ///< of the room

/// Presses of one button, counted from its level and the clock.
struct Repeat {
    bool was_down = false;
    Seconds next{0};

    int presses(bool down, Seconds now) {
        int count = 0;
        if (down && !was_down) {
            count = 1;
            next = now + kRepeatDelay;
        }
        for (; down && now >= next && count < 4; next += kRepeatInterval)
            ++count;
        next = std::max(next, now);
        was_down = down;
        return count;
    }
};

/// One frame's devices, read safely: absent ones are at rest, and nothing is ever NaN.
struct Reading {
    const DeviceState* head;
    const DeviceState* wand;
    const DeviceState* mouse;
    const DeviceState* keys;
    const DeviceState* gamepad;

    explicit Reading(const InputState& input)
        : head(input.find("head")), wand(input.find("wand")), mouse(input.find("mouse")),
          keys(input.find("keys")), gamepad(input.find("gamepad")) {}

    static std::uint64_t buttons(const DeviceState* device) { return device ? device->buttons : 0; }
    static double valuator(const DeviceState* device, std::size_t index) {
        if (!device || index >= device->valuators.size() ||
            !std::isfinite(device->valuators[index]))
            return 0.0;
        return device->valuators[index];
    }
    double wand_rate(WandValuator which) const {
        return std::clamp(valuator(wand, static_cast<std::size_t>(which)), -1.0, 1.0);
    }
    double axis(GamepadAxis which) const {
        return std::clamp(valuator(gamepad, static_cast<std::size_t>(which)), -1.0, 1.0);
    }
    double drag(MouseBit which, int direction) const {
        return valuator(mouse, 2 * static_cast<std::size_t>(which) + direction);
    }
    bool key(Action action) const { return (buttons(keys) & bit(action)) != 0; }
    bool pad(GamepadButton which) const { return (buttons(gamepad) & bit(which)) != 0; }
    bool wand_button(WandButton which) const { return (buttons(wand) & bit(which)) != 0; }
    std::optional<Pose> wand_pose() const {
        return wand && wand->pose_valid ? wand->pose : std::nullopt;
    }
    /// A head pose that is only held still tells where the viewer is.
    Pose viewer() const {
        return head && head->pose ? *head->pose : Pose{{0.0f, 1.6f, 0.0f}, {1.0f, 0, 0, 0}};
    }
};

} // namespace

struct Controls::State {
    std::uint64_t last_keys = 0, last_pad = 0;
    std::optional<Seconds> last_time;
    Repeat isovalue_up, isovalue_down, step_forward, step_back, eyes_apart, eyes_together;
    Playback playback;
    int stamps = 0;

    /// The clutch: the volume follows the wand as it lay when `hand` closed around `held`.
    struct Grab {
        Pose hand;
        Similarity held;
        Similarity result; ///< what it led to; anything else moved the volume meanwhile
    };
    std::optional<Grab> grab;

    bool pressed(const Reading& now, Action action) const {
        return now.key(action) && !(last_keys & bit(action));
    }
    bool pressed(const Reading& now, GamepadButton button) const {
        return now.pad(button) && !(last_pad & bit(button));
    }

    Similarity navigate(const Reading& now, const ControlContext& context, double seconds) {
        if (pressed(now, Action::reset) || pressed(now, GamepadButton::x)) {
            grab.reset();
            return context.home;
        }
        Similarity volume = context.room_from_physical;
        volume = dragged(now, context, volume);
        volume = flown(now, volume, seconds);
        volume = resized(now, context, volume, seconds);
        volume = held(now, context, volume);
        return is_valid(volume) ? volume : context.room_from_physical;
    }

    static Similarity dragged(const Reading& now, const ControlContext& context,
                              Similarity volume) {
        const glm::dquat view = glm::normalize(glm::dquat(now.viewer().orientation));
        const glm::dvec3 right = view * glm::dvec3(1, 0, 0);
        const glm::dvec3 centre = transform(volume, context.pivot);
        glm::dvec2 orbit(now.drag(MouseBit::left, 0), now.drag(MouseBit::left, 1));
        glm::dvec2 move(now.drag(MouseBit::middle, 0), now.drag(MouseBit::middle, 1));
        if (now.key(Action::shift)) {
            move += orbit;
            orbit = glm::dvec2(0);
        }
        if (orbit.x != 0)
            volume = turned(volume, centre, kUp, kOrbit * orbit.x);
        if (orbit.y != 0)
            volume = turned(volume, centre, right, kOrbit * orbit.y);
        if (move != glm::dvec2(0)) {
            const double distance = glm::length(centre - glm::dvec3(now.viewer().position));
            const glm::dvec3 up = view * kUp;
            volume = moved(volume, distance * kViewHeight * (move.x * right - move.y * up));
        }
        return volume;
    }

    static Similarity flown(const Reading& now, Similarity volume, double seconds) {
        const double speed = kFlySpeed * (now.key(Action::shift) ? kHurry : 1.0);
        const std::optional<Pose> wand = now.wand_pose();
        glm::dvec3 velocity(0.0); // of the viewer through the volume
        if (now.wand_button(WandButton::fly) && wand)
            velocity += glm::normalize(glm::dquat(wand->orientation)) * glm::dvec3(0, 0, -1);
        const glm::dvec3 stick(now.axis(GamepadAxis::left_x), -now.axis(GamepadAxis::right_y),
                               now.axis(GamepadAxis::left_y));
        if (stick != glm::dvec3(0)) {
            const glm::dvec3 back =
                glm::normalize(glm::dquat(now.viewer().orientation)) * glm::dvec3(0, 0, 1);
            const double heading = std::atan2(back.x, back.z);
            velocity += glm::angleAxis(heading, kUp) * stick;
        }
        if (velocity != glm::dvec3(0))
            volume = moved(volume, -speed * seconds * velocity);
        const double turn = now.axis(GamepadAxis::right_x);
        if (turn != 0)
            volume =
                turned(volume, glm::dvec3(now.viewer().position), kUp, kTurnSpeed * turn * seconds);
        return volume;
    }

    static Similarity resized(const Reading& now, const ControlContext& context,
                              const Similarity& volume, double seconds) {
        const double notches =
            now.key(Action::control) ? 0.0 : Reading::valuator(now.mouse, kMouseWheel);
        const double rate = now.wand_rate(WandValuator::scale);
        if (notches == 0 && rate == 0)
            return volume;
        const double factor = std::pow(kNotch, notches) * std::pow(kGrowth, rate * seconds);
        return scaled(volume, transform(volume, context.pivot), factor,
                      context.home.scale / kScaleRange, context.home.scale * kScaleRange);
    }

    /// A lost wand pose, or anything else that moves the volume, only opens and closes the hand.
    Similarity held(const Reading& now, const ControlContext& context, const Similarity& volume) {
        const std::optional<Pose> hand = now.wand_pose();
        const bool closed = now.wand_button(WandButton::grab) || now.pad(GamepadButton::y);
        if (!closed || !hand) {
            grab.reset();
            return volume;
        }
        if (!grab || volume != context.room_from_physical || grab->result != volume)
            grab = Grab{*hand, volume, volume};
        else
            grab->result = carried(grab->held, grab->hand, *hand);
        return grab->result;
    }

    double isovalue(const Reading& now, const ControlContext& context, Seconds time,
                    double seconds) {
        const bool shift = now.key(Action::shift);
        const double range = context.high - context.low;
        const int keys = isovalue_up.presses(now.key(Action::isovalue_up), time) -
                         isovalue_down.presses(now.key(Action::isovalue_down), time);
        const double wheel =
            now.key(Action::control) ? Reading::valuator(now.mouse, kMouseWheel) : 0.0;
        const double rate = now.wand_rate(WandValuator::isovalue) +
                            now.axis(GamepadAxis::right_trigger) -
                            now.axis(GamepadAxis::left_trigger);
        const double change =
            keys * (shift ? kFine : kCoarse) + wheel * kFine + rate * seconds / kRangeSeconds;
        if (change == 0 || !(range > 0) || !std::isfinite(range))
            return context.isovalue;
        const double from =
            std::isfinite(context.isovalue) ? context.isovalue : context.low + range / 2;
        return std::clamp(from + change * range, context.low, context.high);
    }

    /// Sets `step` and `playback` where they change.
    void play(const Reading& now, const ControlContext& context, Seconds time, Seconds elapsed,
              Commands& commands) {
        static const std::vector<double> kNone;
        const std::vector<double>& times = context.times ? *context.times : kNone;
        const auto steps = static_cast<std::int64_t>(times.size());
        PlaybackState state = context.playback;
        const bool toggle = pressed(now, Action::play) || pressed(now, GamepadButton::a);
        if (toggle)
            state.playing = !state.playing;
        if (pressed(now, Action::reverse) || pressed(now, GamepadButton::b))
            state.reverse = !state.reverse;
        if (pressed(now, Action::loop))
            state.loop = !state.loop;
        if (pressed(now, Action::faster))
            state.speed = std::min(state.speed * 2, kFastest);
        if (pressed(now, Action::slower))
            state.speed = std::max(state.speed / 2, kSlowest);

        std::int64_t step = context.step;
        const int forward = step_forward.presses(
            now.key(Action::step_forward) || now.pad(GamepadButton::right_bumper), time);
        const int back = step_back.presses(
            now.key(Action::step_back) || now.pad(GamepadButton::left_bumper), time);
        if (forward != back && steps > 0) {
            step += forward - back;
            step = state.loop ? (step % steps + steps) % steps
                              : std::clamp<std::int64_t>(step, 0, steps - 1);
            state.playing = false;
        }
        const Playback::Result reached =
            playback.advance(times, static_cast<std::uint32_t>(step), state, elapsed);
        state.playing = reached.playing;
        if (reached.step != context.step)
            commands.step = reached.step;
        if (state != context.playback)
            commands.playback = state;
    }

    void switches(const Reading& now, const ControlContext& context, Seconds time,
                  Commands& commands) {
        const auto choose = [&](Action action, QualityMode mode) {
            if (pressed(now, action) && context.quality != mode)
                commands.quality = mode;
        };
        choose(Action::quality_auto, QualityMode::automatic);
        choose(Action::quality_fast, QualityMode::fast);
        choose(Action::quality_best, QualityMode::quality);

        const int eyes = eyes_apart.presses(now.key(Action::eyes_apart), time) -
                         eyes_together.presses(now.key(Action::eyes_together), time);
        const float separation = std::clamp(
            context.eye_separation + static_cast<float>(eyes) * kEyeStep, 0.0f, kWidestEyes);
        if (eyes != 0 && separation != context.eye_separation)
            commands.eye_separation = separation;

        if (pressed(now, Action::next_stereo) && context.stereo_modes &&
            !context.stereo_modes->empty()) {
            const std::vector<std::string>& modes = *context.stereo_modes;
            const auto found = std::ranges::find(modes, context.stereo);
            const bool wraps = found == modes.end() || found + 1 == modes.end();
            commands.stereo = wraps ? modes.front() : *(found + 1);
        }
        if (pressed(now, Action::panel))
            commands.panel = !context.panel;
        if (pressed(now, Action::stamp))
            commands.stamps.push_back(fmt::format("stamp-{}", ++stamps));
        commands.screenshot = pressed(now, Action::screenshot);
        commands.quit = pressed(now, Action::quit);
    }
};

Controls::Controls() : state_(std::make_unique<State>()) {}
Controls::~Controls() = default;

Commands Controls::update(const InputState& input, const ControlContext& context) {
    State& s = *state_;
    const Reading now(input);
    const double elapsed = s.last_time ? std::max((input.time - *s.last_time).count(), 0.0) : 0.0;
    const double seconds = std::min(elapsed, kLongestFrame);
    s.last_time = input.time;

    Commands commands;
    const Similarity volume = s.navigate(now, context, seconds);
    if (volume != context.room_from_physical)
        commands.room_from_physical = volume;
    const double isovalue = s.isovalue(now, context, input.time, seconds);
    if (isovalue != context.isovalue && std::isfinite(isovalue))
        commands.isovalue = isovalue;
    s.play(now, context, input.time, Seconds(std::min(elapsed, kLongestPlayback)), commands);
    s.switches(now, context, input.time, commands);

    s.last_keys = Reading::buttons(now.keys);
    s.last_pad = Reading::buttons(now.gamepad);
    return commands;
}

std::vector<std::string> Controls::documentation() {
    std::vector<std::string> lines;
    for (const KeyLine& line : key_lines())
        lines.push_back(fmt::format("{:<30}{}", line.keys, line.effect));
    for (const ControlLine& line : control_lines())
        lines.push_back(fmt::format("{:<30}{}", line.control, line.effect));
    return lines;
}

} // namespace isochron::interaction
