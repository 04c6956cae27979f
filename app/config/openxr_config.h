// The `[openxr]` table of a configuration: whether and how a headset is shown through OpenXR.
#pragma once

#include "app/config/toml_reader.h"
#include "stereo/headset_display.h"
#include "stereo/openxr/openxr_options.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

/// What is done at the start without a runtime.
enum class WithoutRuntime : std::uint8_t {
    fail,
    window, ///< the windows are shown as configured, and no headset is looked for
    wait    ///< the windows show the scene until there is one
};

struct OpenXrConfig {
    bool enabled = false;
    WithoutRuntime fallback = WithoutRuntime::fail;
    bool verbose = false; ///< the OpenXR loader's own messages go to stderr, too
    stereo::OpenXrOptions options;
    stereo::Mirror mirror = stereo::Mirror::left;
};

/// @throws ConfigError as TomlReader does
void read_openxr(TomlReader& reader, OpenXrConfig& config);

/// What is configured, a line each; nothing where it is not enabled.
std::vector<std::string> describe_openxr(const OpenXrConfig& config);

/// Whether this program can show through OpenXR at all.
bool built_with_openxr();

/// @param config whose options are complete
/// @return null where OpenXR is not enabled, or where none answers and the fallback is configured,
/// which is told on stderr
/// @throws render::Error in one line when there is no runtime
std::unique_ptr<stereo::Headset> open_headset(const OpenXrConfig& config);

} // namespace isochron::app
