// Mouse and keyboard play a tracked head and a wand.
#include "interaction/controls/desktop_emulation.h"

#include "interaction/controls/action_table.h"
#include "interaction/input/actions.h"
#include "interaction/input/dead_zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace isochron::interaction {
namespace {

constexpr double kLongestStep = 0.1;     ///< [s] a stall must not become a leap
constexpr float kSteepest = 1.5f;        ///< [rad] of looking up or down
constexpr glm::vec2 kHand{0.2f, -0.25f}; ///< [m] the wand, right of and below the head
/// [m] the wand while it points at a panel, in the head's frame (+x right, +y up, -z ahead): near
/// the eyes, so that its ray meets every part of a panel that the eyes can read.
constexpr glm::vec3 kAtTheEyes{0.08f, -0.12f, -0.08f};
constexpr float kAimDistance = 1.5f; ///< [m] from the head, where cursor and wand ray meet
constexpr int kMostTaps = 16;        ///< remembered while frames are slow

} // namespace

/// A key's state as polls show it. Every press is shown as one rising edge, even if several presses
/// happen between two polls.
struct KeySwitch {
    int held = 0; ///< number of keys bound to it that are down
    int taps = 0; ///< presses not shown yet
    bool shown = false;

    void press() {
        ++held;
        taps = std::min(taps + 1, kMostTaps);
    }
    void release() { held = std::max(held - 1, 0); }
    void poll() {
        if (taps == 0) {
            shown = held > 0;
        } else if (shown) {
            shown = false;
        } else {
            shown = true;
            --taps;
        }
    }
};

/// Shift and Ctrl themselves, which change what other keys and the mouse do.
bool is_modifier(Action action) {
    return action == Action::shift || action == Action::control;
}

/// What a key does while the modifiers of `chord` are held.
/// @param chord nothing: modifiers that no key is bound with
std::vector<Action> actions_of(Key key, std::optional<Chord> chord) {
    std::vector<Action> actions;
    for (const KeyLine& line : key_lines())
        for (const ActionRow& row : line.actions)
            for (const KeyStroke& stroke : row.keys)
                if (stroke.key == key && (stroke.chord == chord || is_modifier(row.action)))
                    actions.push_back(row.action);
    return actions;
}

struct EmulatedGamepad {
    bool present = false;
    std::uint32_t buttons = 0, tapped = 0;
    std::vector<float> valuators;

    void feed(const GamepadEvent& event, float dead_zone) {
        present = event.present;
        buttons = present ? event.buttons : 0;
        tapped |= buttons;
        valuators.assign(static_cast<std::size_t>(GamepadAxis::count), 0.0f);
        for (std::size_t axis = 0; present && axis < valuators.size(); ++axis) {
            const bool trigger = axis >= static_cast<std::size_t>(GamepadAxis::left_trigger);
            valuators[axis] = past_dead_zone(
                trigger ? (event.axes[axis] + 1.0f) / 2.0f : event.axes[axis], dead_zone);
        }
    }
};

struct DesktopEmulation::State {
    EmulationOptions options;
    float yaw = 0, pitch = 0; ///< [rad] left and up positive
    glm::vec3 position{0.0f};
    std::optional<Seconds> last_poll;

    std::set<Key> down;
    std::map<Key, std::vector<Action>> held_as; ///< what a key meant when it went down
    std::array<KeySwitch, kActions> switches;
    std::optional<MouseMoveEvent> cursor;
    std::uint64_t mouse_down = 0, mouse_tapped = 0;
    std::array<float, kMouseValuators> mouse{};
    EyeRay eye;
    RoomPanel panel;
    PanelSize panel_size;
    bool presses_panel = false; ///< the left button went down on the panel and still is
    bool tapped_panel = false;
    EmulatedGamepad gamepad;

    explicit State(const EmulationOptions& chosen) : options(chosen) { stand_at_start(); }

    void stand_at_start() {
        position = options.head.position;
        const glm::vec3 ahead = options.head.orientation * glm::vec3(0, 0, -1);
        yaw = std::atan2(-ahead.x, -ahead.z);
        pitch = std::clamp(std::asin(std::clamp(ahead.y, -1.0f, 1.0f)), -kSteepest, kSteepest);
    }

    void act(const KeyEvent& event) {
        const bool changes =
            event.down ? down.insert(event.key).second : down.erase(event.key) == 1;
        if (!changes) // the window system repeats held keys
            return;
        std::vector<Action>& acts = held_as[event.key];
        if (event.down)
            acts = actions_of(event.key, chord_of(event));
        for (const Action action : acts) {
            KeySwitch& to = switches[static_cast<std::size_t>(action)];
            event.down ? to.press() : to.release();
        }
    }
    bool either(Key left, Key right) const { return down.contains(left) || down.contains(right); }
    std::optional<Chord> chord_of(const KeyEvent& event) const {
        if (event.with(Modifier::alt) || event.with(Modifier::super) ||
            down.contains(Key::left_alt))
            return std::nullopt;
        if (!event.with(Modifier::control) && !either(Key::left_control, Key::right_control))
            return Chord::none;
        return either(Key::left_shift, Key::right_shift) ? Chord::control_shift : Chord::control;
    }
    void act(const TextEvent&) {}
    void act(const MouseButtonEvent& event) {
        const std::uint64_t mask = bit(event.button);
        if (event.button == MouseButton::left && (presses_panel || (event.down && over_panel()))) {
            presses_panel = event.down;
            tapped_panel = tapped_panel || event.down;
            return;
        }
        mouse_down = event.down ? mouse_down | mask : mouse_down & ~mask;
        if (event.down)
            mouse_tapped |= mask;
    }
    void act(const MouseMoveEvent& event) {
        if (!std::isfinite(event.x) || !std::isfinite(event.y))
            return;
        if (cursor && event.width > 0 && event.height > 0) {
            const float aspect = static_cast<float>(event.width) / static_cast<float>(event.height);
            for (std::size_t button = 0; button < 3; ++button)
                if (mouse_down >> button & 1) {
                    mouse[2 * button] += (event.x - cursor->x) * aspect;
                    mouse[2 * button + 1] += event.y - cursor->y;
                }
        }
        cursor = event;
    }
    void act(const ScrollEvent& event) { mouse[kMouseWheel] += event.dy; }
    void act(const FocusEvent& event) {
        if (event.focused)
            return;
        down.clear();
        for (KeySwitch& each : switches)
            each.held = 0;
        mouse_down = 0;
        presses_panel = false;
        cursor.reset();
    }
    void act(const GamepadEvent& event) {
        if (options.gamepad)
            gamepad.feed(event, options.dead_zone);
    }

    bool shown(Action action) const { return switches[static_cast<std::size_t>(action)].shown; }
    float axis(Action positive, Action negative) const {
        return static_cast<float>(shown(positive)) - static_cast<float>(shown(negative));
    }

    void look() {
        const std::size_t right = 2 * static_cast<std::size_t>(MouseBit::right);
        yaw = std::remainder(yaw - options.look_speed * mouse[right], 2.0f * 3.14159265f);
        pitch = std::clamp(pitch - options.look_speed * mouse[right + 1], -kSteepest, kSteepest);
    }

    void walk(float seconds) {
        using enum Action;
        const glm::vec3 steps(axis(walk_right, walk_left), axis(walk_up, walk_down),
                              axis(walk_back, walk_forward));
        const float speed = options.walk_speed * (shown(shift) ? kHurry : 1.0f);
        if (steps != glm::vec3(0.0f))
            position +=
                glm::angleAxis(yaw, glm::vec3(0, 1, 0)) * glm::normalize(steps) * (speed * seconds);
    }

    Pose head() const {
        return {position, glm::normalize(glm::angleAxis(yaw, glm::vec3(0, 1, 0)) *
                                         glm::angleAxis(pitch, glm::vec3(1, 0, 0)))};
    }

    /// The cursor's place on the panel's plane.
    std::optional<PanelHit> on_panel() const {
        if (!panel.shown || !cursor)
            return std::nullopt;
        return hit_of(aim(), panel.pose, panel_size);
    }
    bool over_panel() const {
        const auto hit = on_panel();
        return hit && hit->inside();
    }

    /// Unit direction from the head through the cursor, in the head's own frame.
    glm::vec3 cursor_ray() const {
        glm::vec2 aim(0.0f);
        if (cursor) {
            const float half = std::tan(options.vertical_fov / 2);
            const float aspect = cursor->height > 0 ? static_cast<float>(cursor->width) /
                                                          static_cast<float>(cursor->height)
                                                    : 1.0f;
            aim.x = (std::clamp(cursor->x, 0.0f, 1.0f) * 2 - 1) * half * aspect;
            aim.y = (1 - std::clamp(cursor->y, 0.0f, 1.0f) * 2) * half;
        }
        return glm::normalize(glm::vec3(aim, -1.0f));
    }

    /// The eye's ray through the cursor, if the windows know it.
    std::optional<Pose> pointer() const {
        return eye && cursor ? eye(head(), *cursor) : std::nullopt;
    }

    Pose aim() const {
        if (const auto ray = pointer())
            return *ray;
        const glm::quat turn = glm::quatLookAt(cursor_ray(), glm::vec3(0.0f, 1.0f, 0.0f));
        return {position, glm::normalize(head().orientation * turn)};
    }

    /// The wand is to the right of and below the head, or near the eyes while it points at the
    /// panel. Its ray meets the cursor's ray at `kAimDistance`, or on the panel.
    Pose wand(const Pose& head) const {
        const auto hit = on_panel();
        const bool on = hit && (presses_panel || hit->inside());
        // While it grabs or flies, the wand stays in its usual place, so that the volume does not
        // leap.
        const bool points = on && !shown(Action::grab) && !shown(Action::fly);
        const glm::vec3 rest = points ? kAtTheEyes : glm::vec3(kHand, -options.wand_reach);
        const Pose ray = aim();
        const glm::vec3 ahead(0.0f, 0.0f, -(on ? hit->distance : kAimDistance));
        const glm::vec3 target = glm::conjugate(head.orientation) *
                                 (ray.position + ray.orientation * ahead - head.position);
        const glm::quat turn =
            glm::quatLookAt(glm::normalize(target - rest), glm::vec3(0.0f, 1.0f, 0.0f));
        return {head.position + head.orientation * rest, glm::normalize(head.orientation * turn)};
    }
};

DesktopEmulation::DesktopEmulation(const EmulationOptions& options)
    : state_(std::make_unique<State>(options)) {}
DesktopEmulation::~DesktopEmulation() = default;

void DesktopEmulation::set_panel(const RoomPanel& panel, const PanelSize& size) {
    state_->panel = panel;
    state_->panel_size = size;
}

StandingPlace DesktopEmulation::standing() const {
    return {state_->position, state_->yaw, state_->pitch};
}

void DesktopEmulation::stand(const StandingPlace& place) {
    if (!std::isfinite(place.yaw) || !std::isfinite(place.pitch) ||
        !is_finite(Pose{place.position, {1, 0, 0, 0}}))
        return;
    state_->position = place.position;
    state_->yaw = place.yaw;
    state_->pitch = std::clamp(place.pitch, -kSteepest, kSteepest);
}

void DesktopEmulation::set_eye(EyeRay eye) {
    state_->eye = std::move(eye);
}

void DesktopEmulation::feed(std::span<const WindowEvent> events) {
    for (const WindowEvent& event : events)
        std::visit([&](const auto& each) { state_->act(each); }, event);
}

InputState DesktopEmulation::poll(Seconds now) {
    using enum Action;
    State& s = *state_;
    const double elapsed = s.last_poll ? (now - *s.last_poll).count() : 0.0;
    s.last_poll = now;
    const bool was_reset = s.shown(reset);
    ActionSet keys;
    for (std::size_t i = 0; i < s.switches.size(); ++i) {
        s.switches[i].poll();
        keys[i] = s.switches[i].shown;
    }
    s.look();
    s.walk(static_cast<float>(std::clamp(elapsed, 0.0, kLongestStep)));
    if (s.shown(reset) && !was_reset)
        s.stand_at_start();

    const Pose head = s.head();
    InputState input{now, {}};
    input.devices.push_back({"head", head, true, 0, {}});
    const std::uint64_t wand_buttons =
        (s.shown(grab) || s.presses_panel || s.tapped_panel ? bit(WandButton::grab) : 0) |
        (s.shown(fly) ? bit(WandButton::fly) : 0);
    input.devices.push_back(
        {"wand", s.wand(head), true, wand_buttons, {0.0f, s.axis(grow, shrink)}});
    input.devices.push_back({"mouse",
                             std::nullopt,
                             true,
                             s.mouse_down | s.mouse_tapped,
                             {s.mouse.begin(), s.mouse.end()}});
    input.devices.push_back({.name = "keys", .pose = {}, .valuators = {}, .actions = keys});
    if (const auto ray = s.pointer())
        input.devices.push_back({"pointer", ray, true, 0, {}});
    if (s.gamepad.present)
        input.devices.push_back({"gamepad", std::nullopt, true,
                                 s.gamepad.buttons | s.gamepad.tapped, s.gamepad.valuators});
    s.mouse.fill(0.0f);
    s.mouse_tapped = 0;
    s.tapped_panel = false;
    s.gamepad.tapped = 0;
    return input;
}

} // namespace isochron::interaction
