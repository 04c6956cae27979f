// Describes the `[openxr]` table, and opens the headset that it asks for.
#include "app/config/openxr_config.h"

#include "app/telling.h"
#include "stereo/openxr/openxr_headset.h"

#include <fmt/format.h>

#include <cstdlib>

namespace isochron::app {
namespace {

using interaction::name_of;

std::string in_words(const OpenXrConfig& config) {
    switch (config.fallback) {
    case WithoutRuntime::fail: break;
    case WithoutRuntime::window: return "the windows as configured";
    case WithoutRuntime::wait:
        return fmt::format("looked for every {:g} s", config.options.retry.count());
    }
    return "an error";
}

} // namespace

std::vector<std::string> describe_openxr(const OpenXrConfig& config) {
    if (!config.enabled)
        return {};
    const stereo::OpenXrOptions& options = config.options;
    return {fmt::format("openxr: reference space {}, binding {}, pictures of {:g} times the "
                        "recommended size{}",
                        name_of(options.space), name_of(options.binding), options.scale,
                        options.depth ? ", with depth where it is taken" : ""),
            fmt::format("  mirror {}, wand in the {} hand, without a runtime: {}",
                        name_of(config.mirror), options.left_handed ? "left" : "right",
                        in_words(config)),
            fmt::format("  devices: head, wand, wand2; keys of their buttons{}",
                        built_with_openxr() ? "" : "; this program was built without OpenXR")};
}

#ifdef ISOCHRON_WITH_OPENXR
bool built_with_openxr() {
    return true;
}
static std::unique_ptr<stereo::Headset> open_runtime(const stereo::OpenXrOptions& options) {
    return stereo::open_headset(options);
}
#else
bool built_with_openxr() {
    return false;
}
static std::unique_ptr<stereo::Headset> open_runtime(const stereo::OpenXrOptions&) {
    throw render::Error("openxr.enabled: this program was built without OpenXR");
}
#endif

std::unique_ptr<stereo::Headset> open_headset(const OpenXrConfig& config) {
    if (!config.enabled)
        return nullptr;
    // This function reports a missing runtime in one line; the loader would add five.
    if (!config.verbose)
        setenv("XR_LOADER_DEBUG", "none", 0);
    stereo::OpenXrOptions options = config.options;
    options.wait = config.fallback == WithoutRuntime::wait;
    try {
        return open_runtime(options);
    } catch (const render::Error& error) {
        if (config.fallback != WithoutRuntime::window)
            throw render::Error("{}; openxr.fallback = \"wait\" looks for one until it is there, "
                                "\"window\" does without",
                                error.what());
        print_note("warning: {}; the windows are shown instead", error.what());
        return nullptr;
    }
}

} // namespace isochron::app
