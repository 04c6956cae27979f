// The `[openxr]` table of a configuration: whether and how a headset is shown through OpenXR.
#pragma once

#include "interaction/enum_names.h"
#include "stereo/headset_display.h"
#include "stereo/openxr/openxr_options.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// What the program does when it starts and there is no OpenXR runtime.
enum class WithoutRuntime : std::uint8_t {
    fail,
    window, ///< shows the windows as configured, and does not look for a headset
    wait    ///< shows the scene in the windows until a runtime appears
};

struct OpenXrConfig {
    bool enabled = false;
    WithoutRuntime fallback = WithoutRuntime::fail;
    bool verbose = false; ///< the OpenXR loader's own messages go to stderr, too
    stereo::OpenXrOptions options;
    stereo::Mirror mirror = stereo::Mirror::left;
};

/// The settings in words, a line each; empty if OpenXR is not enabled.
std::vector<std::string> describe_openxr(const OpenXrConfig& config);

/// Whether this program was built with OpenXR.
bool built_with_openxr();

/// @return null if OpenXR is not enabled, or if there is no runtime and the fallback is `window`;
/// then stderr tells
/// @throws render::Error in one line when there is no runtime and the fallback is `fail`
std::unique_ptr<stereo::Headset> open_headset(const OpenXrConfig& config);

} // namespace isochron::app

namespace isochron::interaction {

// Words of configuration files, in the order of the values.
template <>
inline constexpr std::array<std::string_view, 3> kNames<stereo::OpenXrSpace>{"auto", "stage",
                                                                             "local"};
template <>
inline constexpr std::array<std::string_view, 3> kNames<stereo::OpenXrBinding>{"auto", "egl",
                                                                               "xlib"};
template <>
inline constexpr std::array<std::string_view, 4> kNames<stereo::Mirror>{"left", "right", "both",
                                                                        "none"};
template <>
inline constexpr std::array<std::string_view, 3> kNames<app::WithoutRuntime>{"none", "window",
                                                                             "wait"};

} // namespace isochron::interaction
