// The values that keys of a configuration usually have: what lies outside is told, with the unit
// that may have been meant.
#pragma once

#include <span>

namespace isochron::app {

/// 0 is never told, as it turns something off. Units are those of files.
struct UsualValues {
    const char* key; ///< `*` before the name stands for every table that has it
    const char* unit;
    double low, high;
};

inline constexpr UsualValues kUsualValues[]{
    {"*.fastest", "m/s", 1, 60},
    {"*.fastest_turn", "degrees/s", 90, 20000},
    {"*.accept_jump_ms", "ms", 20, 10000},
    {"*.held_after_ms", "ms", 10, 5000},
    {"*.lost_after_ms", "ms", 50, 60000},
    {"*.display_delay_ms", "ms", 2, 150},
    {"*.prediction_limit_ms", "ms", 2, 150},
    {"*.smoothing_ms", "ms", 2, 400},
    {"*.latency_ms", "ms", 0.5, 150},
    {"windows.viewports.projection.bezel", "m", 0.0005, 0.1},
    {"rendering.near", "m", 0.005, 10},
    {"rendering.frame_rate_limit", "frames/s", 20, 500},
    {"rendering.upload_kilobytes_per_frame", "kB", 128, 524288},
    {"quality.frame_budget_ms", "ms", 1, 250},
    {"quality.longest_ms", "ms", 4, 1000},
    {"quality.still_budget_ms", "ms", 10, 10000},
    {"quality.settle_ms", "ms", 20, 5000},
    {"quality.still_linear", "m/s", 0.001, 0.5},
    {"quality.still_angular", "rad/s", 0.002, 1},
    {"quality.leave_factor", "times", 1, 30},
    {"comfort.lost_fade_ms", "ms", 10, 20000},
    {"comfort.vignette_fade_ms", "ms", 10, 5000},
    {"comfort.vignette_speed", "m/s", 0.02, 20},
    {"comfort.vignette_full", "m/s", 0.05, 50},
    {"comfort.vignette_turn", "degrees/s", 3, 720},
    {"comfort.vignette_turn_full", "degrees/s", 10, 1440},
    {"emulation.walk_speed", "m/s", 0.1, 20},
    {"emulation.look_speed", "rad", 0.2, 20},
    {"emulation.wand_reach", "m", 0.1, 1.5},
    {"gamepad.dead_zone", "of 1", 0.001, 0.6},
    {"cluster.timeout", "s", 0.5, 120},
    {"cluster.frame_timeout", "s", 5, 7200},
    {"openxr.scale", "times", 0.4, 2},
    {"openxr.retry_seconds", "s", 0.1, 120},
    {"lighting.ambient", "of 1", 0.01, 1.5},
    {"lighting.head_light", "of 1", 0.01, 2},
    {"lighting.key_light", "of 1", 0.01, 2},
    {"surfaces.opacity", "of 1", 0.03, 1},
    {"memory.cache_megabytes", "MB", 64, 4e6},
    {"memory.mesh_megabytes", "MB", 8, 32768},
};

inline std::span<const UsualValues> usual_values() {
    return kUsualValues;
}

} // namespace isochron::app
