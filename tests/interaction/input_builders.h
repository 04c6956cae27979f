// Short functions for window events, device states and seeds in tests.
#pragma once

#include "interaction/controls/action_table.h"
#include "interaction/input/actions.h"
#include "interaction/input/tracked_input.h"
#include "interaction/input/window_event.h"

#include <random>
#include <vector>

namespace isochron::interaction {

inline Key key_named(char upper_case) {
    return static_cast<Key>(upper_case);
}
inline WindowEvent press(Key key) {
    return KeyEvent{key, true};
}
inline WindowEvent release(Key key) {
    return KeyEvent{key, false};
}
inline WindowEvent cursor_at(float x, float y) {
    return MouseMoveEvent{x, y, 1600, 800};
}

inline const Pose kStanding{{0.0f, 1.6f, 0.0f}, {1.0f, 0.0f, 0.0f, 0.0f}};

inline DeviceState head_at(const Pose& pose) {
    return {"head", pose, true, 0, {}};
}
inline DeviceState keys_down(const ActionSet& actions) {
    return {.name = "keys", .pose = {}, .valuators = {}, .actions = actions};
}
inline DeviceState wand_at(const Pose& pose, std::uint64_t buttons = 0, float isovalue = 0,
                           float scale = 0) {
    return {"wand", pose, true, buttons, {isovalue, scale}};
}
inline DeviceState mouse_dragged(std::vector<float> valuators) {
    return {"mouse", std::nullopt, true, 0, std::move(valuators)};
}

/// A key with what it does.
struct KeyBinding {
    Key key;
    Chord chord;
    Action action;
};
inline std::vector<KeyBinding> key_bindings() {
    std::vector<KeyBinding> all;
    for (const KeyLine& line : key_lines())
        for (const ActionRow& row : line.actions)
            for (const KeyStroke& press : row.keys)
                all.push_back({press.key, press.chord, row.action});
    return all;
}

/// std::mt19937 with numbers that are 32 bits wide to the compiler too.
using Random =
    std::mersenne_twister_engine<std::uint32_t, 32, 624, 397, 31, 0x9908b0df, 11, 0xffffffff, 7,
                                 0x9d2c5680, 15, 0xefc60000, 18, 1812433253>;

inline double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

inline glm::quat random_rotation(Random& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(
        glm::quat(normal(random), normal(random), normal(random), normal(random)));
}

} // namespace isochron::interaction
