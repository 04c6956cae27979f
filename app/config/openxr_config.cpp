// Reads and describes the `[openxr]` table, and opens the headset that it asks for.
#include "app/config/openxr_config.h"

#include "app/text.h"
#include "stereo/openxr/openxr_headset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace isochron::app {
namespace {

using stereo::Mirror;
using stereo::OpenXrBinding;
using stereo::OpenXrSpace;

template <typename Value>
struct Word {
    Value value;
    const char* name;
};
constexpr std::array kSpaces{Word<OpenXrSpace>{OpenXrSpace::automatic, "auto"},
                             Word<OpenXrSpace>{OpenXrSpace::stage, "stage"},
                             Word<OpenXrSpace>{OpenXrSpace::local, "local"}};
constexpr std::array kBindings{Word<OpenXrBinding>{OpenXrBinding::automatic, "auto"},
                               Word<OpenXrBinding>{OpenXrBinding::egl, "egl"},
                               Word<OpenXrBinding>{OpenXrBinding::xlib, "xlib"}};
constexpr std::array kMirrors{
    Word<Mirror>{Mirror::left, "left"}, Word<Mirror>{Mirror::right, "right"},
    Word<Mirror>{Mirror::both, "both"}, Word<Mirror>{Mirror::none, "none"}};
constexpr std::array kHands{Word<bool>{false, "right"}, Word<bool>{true, "left"}};
constexpr std::array kFallbacks{Word<WithoutRuntime>{WithoutRuntime::fail, "none"},
                                Word<WithoutRuntime>{WithoutRuntime::window, "window"},
                                Word<WithoutRuntime>{WithoutRuntime::wait, "wait"}};

std::string in_words(const OpenXrConfig& config) {
    switch (config.fallback) {
    case WithoutRuntime::fail: break;
    case WithoutRuntime::window: return "the windows as configured";
    case WithoutRuntime::wait:
        return fmt::format("looked for every {:g} s", config.options.retry.count());
    }
    return "an error";
}

template <typename Words, typename Value>
void read_word(TomlReader& reader, const char* key, const Words& words, Value& into) {
    std::vector<std::string> names;
    for (const auto& word : words)
        names.emplace_back(word.name);
    reader.word(key, names, [&](const std::string& name) {
        into = std::ranges::find(words, name, [](const auto& word) {
                   return std::string(word.name);
               })->value;
    });
}

template <typename Words, typename Value>
const char* name_in(const Words& words, Value value) {
    return std::ranges::find(words, value, [](const auto& word) { return word.value; })->name;
}

} // namespace

void read_openxr(TomlReader& reader, OpenXrConfig& config) {
    reader.flag("enabled", config.enabled);
    stereo::OpenXrOptions& options = config.options;
    read_word(reader, "reference_space", kSpaces, options.space);
    read_word(reader, "binding", kBindings, options.binding);
    read_word(reader, "mirror", kMirrors, config.mirror);
    read_word(reader, "wand", kHands, options.left_handed);
    read_word(reader, "fallback", kFallbacks, config.fallback);
    reader.flag("depth", options.depth);
    reader.number("scale", 0.1, 4.0, options.scale);
    double retry = options.retry.count();
    reader.number("retry_seconds", 0.1, 600.0, retry);
    options.retry = interaction::Seconds(retry);
}

std::vector<std::string> describe_openxr(const OpenXrConfig& config) {
    if (!config.enabled)
        return {};
    const stereo::OpenXrOptions& options = config.options;
    return {fmt::format("openxr: reference space {}, binding {}, pictures of {:g} times the "
                        "recommended size{}",
                        name_in(kSpaces, options.space), name_in(kBindings, options.binding),
                        options.scale, options.depth ? ", with depth where it is taken" : ""),
            fmt::format("  mirror {}, wand in the {} hand, without a runtime: {}",
                        name_in(kMirrors, config.mirror), name_in(kHands, options.left_handed),
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
            throw render::Error(fmt::format("{}; openxr.fallback = \"wait\" looks for one until it "
                                            "is there, \"window\" does without",
                                            error.what()));
        print_safely(
            fmt::format("isochron: warning: {}; the windows are shown instead\n", error.what()),
            stderr);
        return nullptr;
    }
}

} // namespace isochron::app
