// Every key of a configuration file, said once: its name, the values that it may have, and the member
// that it sets.
//
// Reading (config_reading.cpp), the JSON schema (config_schema.cpp) and writing (display_config_text.cpp)
// follow from these lists; a key is further a row of docs/FORMATS.md. Settings have their own list: a setting
// whose line in interaction/settings.h says `configured` is a key, too. What involves several keys is
// in config_checks.h.
//
//     each_field([&](const auto& field, auto& member) { use(field.key, member); }, config);
#pragma once

#include "app/config/config.h"
#include "interaction/command_fields.h"

namespace isochron::interaction {

// Words of configuration files for values of the wings below, in their order.
template <>
inline constexpr std::array<std::string_view, 3> kNames<stereo::ContextKind>{"glfw", "egl",
                                                                             "osmesa"};
template <>
inline constexpr std::array<std::string_view, 3> kNames<render::DrawnBy>{"auto", "gpu",
                                                                         "processor"};
template <>
inline constexpr std::array<std::string_view, 2> kNames<render::CellShape>{"plane", "voxel"};
template <>
inline constexpr std::array<std::string_view, 4> kNames<render::Footprint>{"quad", "gaussian",
                                                                           "mesh", "surface"};
template <>
inline constexpr std::array<std::string_view, 3> kNames<app::Blending>{"auto", "linear", "display"};

} // namespace isochron::interaction

namespace isochron::app {

using interaction::Field;
using interaction::Of;

/// A time, in milliseconds in files.
constexpr Field in_ms(const char* key, double high) {
    return {.key = key, .low = 0, .high = high, .per = 1000};
}
/// An angle, in degrees in files.
constexpr Field in_degrees(const char* key, double low, double high) {
    return {.key = key, .low = low, .high = high, .per = 57.29577951308232};
}
/// A key that is written even where it has its default.
constexpr Field told(const char* key, double low = -interaction::kAnyNumber,
                     double high = interaction::kAnyNumber) {
    return {.key = key, .low = low, .high = high, .told = true};
}

inline constexpr double kFar = 1e6; ///< meters or pixels: beyond any installation

// Viewers, windows and screens.

template <class Visit, Of<stereo::Viewer>... R>
void each_field(Visit&& visit, R&... r) {
    visit(told("name"), r.name...);
    visit(told("head"), r.head...);
    visit(told("position"), r.position...);
    visit(told("eye_separation", 0, 0.1), r.eye_separation...);
    visit(Field{"left_eye"}, r.left_eye...);
    visit(Field{"right_eye"}, r.right_eye...);
}

template <class Visit, Of<stereo::Screen>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{.key = "carried_by", .words = {"room", "head"}, .told = true},
          r.carried_by_head...);
    visit(Field{"fit_aspect"}, r.fit_aspect...);
    visit(Field{"bezel", 0, 0.5}, r.bezel...);
    visit(told("lower_left"), r.lower_left...);
    visit(told("upper_left"), r.upper_left...);
    visit(told("upper_right"), r.upper_right...);
}

template <class Visit, Of<stereo::Viewport>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"name"}, r.name...);
    visit(told("position"), r.position...);
    visit(told("size"), r.size...);
    visit(told("viewer"), r.viewer...); // by name
    visit(Field{"upside_down"}, r.upside_down...);
    visit(Field{"projection"}, r.screen...);
}

template <class Visit, Of<stereo::Window>... R>
void each_field(Visit&& visit, R&... r) {
    visit(told("name"), r.name...);
    visit(told("size", 16, 16384), r.size...);
    visit(Field{"position", -65536, 65536}, r.position...);
    visit(Field{"fullscreen"}, r.fullscreen...);
    visit(Field{"monitor", 0, 63}, r.monitor...);
    visit(Field{"node", 0, 255}, r.node...);
    visit(Field{"border"}, r.border...);
    visit(told("stereo"), r.stereo...);
    visit(Field{"viewports"}, r.viewports...);
}

template <class Visit, Of<stereo::Installation>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{.key = "viewers", .one = "viewer"}, r.viewers...);
    visit(Field{"windows"}, r.windows...);
    visit(Field{"rendering.near", 1e-3, 10}, r.near_plane...);
    visit(Field{"rendering.far", 1, 1e5}, r.far_plane...);
}

// Trackers. Each device starts from what its tracker has, and that from the table `tracking`.

template <class Visit, Of<interaction::PoseFilterLimits>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"fastest", 0.1, 1000}, r.fastest...);
    visit(in_degrees("fastest_turn", 1, 1e5), r.fastest_turn...);
    visit(in_ms("accept_jump_ms", 60e3), r.accept_jump...);
    visit(in_ms("held_after_ms", 60e3), r.held_after...);
    visit(in_ms("lost_after_ms", 600e3), r.lost_after...);
}

template <class Visit, Of<interaction::PredictionOptions>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"prediction"}, r.on...);
    visit(in_ms("display_delay_ms", 200), r.display_delay...);
    visit(in_ms("prediction_limit_ms", 200), r.limit...);
    visit(in_ms("smoothing_ms", 500), r.smoothing...);
}

template <class Visit, Of<interaction::DeviceOptions>... R>
void each_field(Visit&& visit, R&... r) {
    constexpr std::size_t kButtons = interaction::TrackedDevice::kMostButtons,
                          kValuators = interaction::TrackedDevice::kMostValuators;
    visit(Field{"name"}, r.name...);
    visit(Field{"offset"}, r.calibration.sensor_from_thing.position...);
    visit(Field{"rotation"}, r.calibration.sensor_from_thing.orientation...);
    each_field(visit, r.limits...);
    each_field(visit, r.prediction...);
    visit(Field{.key = "buttons", .low = 0, .high = kButtons - 1, .most = kButtons}, r.buttons...);
    visit(Field{.key = "valuators", .low = 0, .high = kValuators - 1, .most = kValuators},
          r.valuators...);
    visit(Field{.key = "valuator_factors", .low = -1000, .high = 1000, .most = kValuators},
          r.valuator_factors...);
}

/// The keys of a tracker that concern all of its devices.
template <class Visit, Of<interaction::DeviceOptions>... R>
void each_common_field(Visit&& visit, R&... r) {
    visit(Field{"position"}, r.calibration.room_from_tracker.position...);
    visit(Field{"orientation"}, r.calibration.room_from_tracker.orientation...);
    visit(Field{"scale", 1e-6, 1e6}, r.calibration.scale...);
    visit(in_ms("latency_ms", 500), r.latency...);
}

/// The number of a device in DTrack, under a key that says what it is.
struct NumberInDTrack {
    interaction::DTrackDevice& device;
    interaction::DTrackKind kind;
};

template <class Visit, Of<interaction::DTrackDevice>... R>
void each_field(Visit&& visit, R&... r) {
    using interaction::DTrackKind;
    each_field(visit, r.device...);
    for (const DTrackKind kind : {DTrackKind::body, DTrackKind::flystick, DTrackKind::marker})
        visit(Field{name_of(kind).data(), 0, 65535}, NumberInDTrack{r, kind}...);
}

template <class Visit, Of<interaction::DTrackOptions>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"address"}, r.endpoint.address...);
    visit(Field{"port", 1, 65535}, r.endpoint.port...);
    visit(Field{"from"}, r.from...);
    each_common_field(visit, r.common...);
    visit(Field{"devices"}, r.devices...);
}

template <class Visit, Of<interaction::OscDevice>... R>
void each_field(Visit&& visit, R&... r) {
    each_field(visit, r.device...);
    visit(Field{"source"}, r.source...);
    visit(Field{"pose"}, r.device.has_pose...);
}

template <class Visit, Of<interaction::OscOptions>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"address"}, r.endpoint.address...);
    visit(Field{"port", 1, 65535}, r.endpoint.port...);
    each_common_field(visit, r.common...);
    visit(Field{"prefix"}, r.prefix...);
    visit(Field{"devices"}, r.devices...);
}

template <class Visit, Of<interaction::VrpnDevice>... R>
void each_field(Visit&& visit, R&... r) {
    each_field(visit, r.device...);
    visit(Field{"tracker"}, r.tracker...);
    visit(Field{"button"}, r.buttons...);
    visit(Field{"analog"}, r.analog...);
    visit(Field{"sensor", 0, 1023}, r.sensor...);
}

template <class Visit, Of<interaction::VrpnOptions>... R>
void each_field(Visit&& visit, R&... r) {
    each_common_field(visit, r.common...);
    visit(Field{"devices"}, r.devices...);
}

// Lists and tables of their own.

template <class Visit, Of<ConfiguredSurface>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"isovalue"}, r.isovalue...);
    visit(Field{"quantile", 0, 1}, r.quantile...);
    visit(Field{"color", 0, 1}, r.color...);
    visit(Field{"opacity", 0, 1}, r.opacity...);
}

template <class Visit, Of<ConsoleConfig>... R>
void each_field(Visit&& visit, R&... r) {
    visit(Field{"size", 200, 16384}, r.size...);
    visit(Field{"position", 0, 16384}, r.position...);
}

/// A picture at rest is never drawn with quads; `auto`: with what fits the budget.
using SettledFootprint = std::optional<render::Footprint>;
inline constexpr Field kSettledField{"quality.settled", double(render::Footprint::gaussian)};

template <class Visit, Of<Config>... C>
void each_field(Visit&& visit, C&... c) {
    constexpr double kBrightest = 4, kFastMs = 1000, kSlowMs = 10000;
    visit(Field{"version", 1, 1}, c.version...);
    each_field(visit, c.installation...);

    visit(Field{"emulation.walk_speed", 0.01, 100}, c.emulation.walk_speed...);
    visit(Field{"emulation.look_speed", 0.01, 100}, c.emulation.look_speed...);
    visit(Field{"emulation.wand_reach", 0.05, 5}, c.emulation.wand_reach...);

    visit(Field{"tracking"}, c.devices.common.limits...);
    visit(Field{"tracking"}, c.devices.common.prediction...);
    visit(Field{.key = "dtrack", .one = "dtrack"}, c.devices.dtrack...);
    visit(Field{.key = "osc", .one = "osc"}, c.devices.osc...);
    visit(Field{.key = "vrpn", .one = "vrpn"}, c.devices.vrpn...);
    visit(Field{"gamepad.enabled"}, c.emulation.gamepad...);
    visit(Field{"gamepad.dead_zone", 0, 0.9}, c.emulation.dead_zone...);

    visit(Field{"panel.room"}, c.start.room_panel.shown...);
    visit(Field{"panel.width", 0.2, 2}, c.panel.width...);
    visit(Field{"panel.distance", 0.3, 5}, c.panel.distance...);
    visit(Field{"panel.font_scale", 0.5, 4}, c.panel.font_scale...);
    visit(Field{"console"}, c.panel.console...);

    visit(Field{"cluster.timeout", 0.5, 600}, c.cluster.limits.silence...);
    visit(Field{"cluster.frame_timeout", 1, 86400}, c.cluster.limits.stall...);
    visit(Field{"cluster.swap_group"}, c.cluster.swap_group...);

    visit(Field{"openxr.enabled"}, c.openxr.enabled...);
    visit(Field{"openxr.reference_space"}, c.openxr.options.space...);
    visit(Field{"openxr.binding"}, c.openxr.options.binding...);
    visit(Field{"openxr.mirror"}, c.openxr.mirror...);
    visit(Field{.key = "openxr.wand", .words = {"right", "left"}}, c.openxr.options.left_handed...);
    visit(Field{"openxr.fallback"}, c.openxr.fallback...);
    visit(Field{"openxr.depth"}, c.openxr.options.depth...);
    visit(Field{"openxr.scale", 0.1, 4}, c.openxr.options.scale...);
    visit(Field{"openxr.retry_seconds", 0.1, 600}, c.openxr.options.retry...);

    visit(Field{"comfort.fade_when_lost"}, c.comfort.fade_when_lost...);
    visit(in_ms("comfort.lost_fade_ms", 60e3), c.comfort.lost_fade...);
    visit(Field{"comfort.vignette"}, c.comfort.vignette...);
    visit(Field{"comfort.vignette_speed", 0, 100}, c.comfort.vignette_speed...);
    visit(Field{"comfort.vignette_full", 0, 100}, c.comfort.vignette_full...);
    visit(Field{"comfort.near_fade"}, c.comfort.near_fade...);
    visit(in_degrees("comfort.vignette_turn", 0, 3600), c.comfort.vignette_turn...);
    visit(in_degrees("comfort.vignette_turn_full", 0, 3600), c.comfort.vignette_turn_full...);
    visit(in_ms("comfort.vignette_fade_ms", 60e3), c.comfort.vignette_fade...);

    visit(kSettledField, c.quality.settled...);
    visit(Field{"quality.frame_budget_ms", 0, kFastMs}, c.quality.frame_budget_ms...);
    visit(Field{"quality.longest_ms", 0, kFastMs}, c.quality.longest_ms...);
    visit(Field{"quality.least_resolution", 0.35, 1}, c.quality.least_resolution...);
    visit(Field{"quality.still_budget_ms", 0, kSlowMs}, c.quality.still_budget_ms...);
    visit(Field{"quality.still_linear", 0, 10}, c.quality.stillness.linear...);
    visit(Field{"quality.still_angular", 0, 10}, c.quality.stillness.angular...);
    visit(Field{"quality.leave_factor", 1, 100}, c.quality.stillness.leave_factor...);
    visit(in_ms("quality.settle_ms", kSlowMs), c.quality.stillness.settle...);

    visit(Field{"rendering.shape"}, c.rendering.cell_shape...);
    visit(Field{"rendering.context"}, c.rendering.context...);
    visit(Field{"rendering.vsync"}, c.rendering.vsync...);
    visit(Field{"rendering.frame_rate_limit", 1, 1000}, c.rendering.frame_rate_limit...);
    visit(Field{"rendering.upload_kilobytes_per_frame", 16, 1 << 20},
          c.rendering.upload_kilobytes_per_frame...);
    visit(Field{"rendering.background", 0, 1}, c.rendering.background...);
    visit(Field{"rendering.surface_color", 0, 1}, c.rendering.surface_color...);
    visit(Field{"rendering.samples", 0, 64}, c.rendering.samples...);
    visit(Field{"rendering.picture_samples", 0, 64}, c.pictures.samples...);
    visit(Field{"rendering.blending"}, c.rendering.blending...);
    visit(Field{"rendering.drawn_by"}, c.rendering.drawn_by...);
    visit(Field{"rendering.level_of_detail"}, c.rendering.level_of_detail...);
    visit(Field{"rendering.wand_ray"}, c.rendering.wand_ray...);
    visit(Field{"rendering.picture_ray"}, c.pictures.ray...);
    visit(Field{"rendering.picture_caption"}, c.pictures.caption...);

    visit(Field{"lighting.ambient", 0, kBrightest}, c.rendering.appearance.ambient...);
    visit(Field{"lighting.head_light", 0, kBrightest}, c.rendering.appearance.head_light...);
    visit(Field{"lighting.key_light", 0, kBrightest}, c.rendering.appearance.key_light...);
    visit(Field{"lighting.key_direction"}, c.rendering.appearance.key_direction...);
    visit(Field{"lighting.ground", 0, 1}, c.rendering.appearance.ground...);
    visit(Field{"lighting.reflectance", 0, 1}, c.rendering.appearance.reflectance...);
    visit(Field{"lighting.shininess", 1, 1000}, c.rendering.appearance.shininess...);
    visit(Field{"lighting.outline", 0, 1}, c.rendering.appearance.outline...);
    visit(Field{"lighting.depth_cue", 0, 1}, c.rendering.appearance.depth_cue...);

    visit(Field{"coloring.file"}, c.color_map_file...);
    visit(Field{"coloring.file_map"}, c.color_map_of_file...);
    visit(Field{"time.between"}, c.between...); // `auto`: none
    visit(Field{"surfaces"}, c.surfaces...);

    visit(Field{"memory.cache_megabytes", 0, 1 << 24}, c.memory.cache_megabytes...);
    visit(Field{"memory.mesh_megabytes", 0, 1 << 16}, c.memory.mesh_megabytes...);
    visit(Field{"memory.most_cells", 20'000, 500'000'000}, c.memory.most_cells...);

    visit(Field{"placement.size", 0.01, 100}, c.placement.size...);
    visit(Field{"placement.height", -100, 100}, c.placement.height...);
    visit(Field{"placement.distance", -100, 100}, c.placement.distance...);
    visit(Field{"placement.fill", 0, 1}, c.placement.fill...);

    each_setting(
        [&](Field field, auto&... members) {
            if (!field.configured)
                return;
            field.key = field.configured;
            visit(field, members...);
        },
        c.start...);
}

} // namespace isochron::app
