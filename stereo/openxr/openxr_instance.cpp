// Chooses extensions, and asks the runtime.
#include "stereo/openxr/openxr_instance.h"

#include "stereo/openxr/openxr_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace isochron::stereo {
namespace {

// OpenXR defines these names beside structures of window systems, which only graphics_binding.cpp
// includes.
constexpr const char* kXlib = "XR_KHR_opengl_enable";
constexpr const char* kEgl = "XR_MNDX_egl_enable";
/// Used if the runtime has them.
constexpr std::array kOptional{XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                               "XR_KHR_convert_timespec_time"};

/// Where the loader looks, for messages.
std::string whereabouts() {
    if (const char* file = std::getenv("XR_RUNTIME_JSON"))
        return fmt::format("XR_RUNTIME_JSON={}", file);
    return "openxr/1/active_runtime.json in ~/.config, /etc/xdg and /usr/share";
}

std::vector<std::string> offered_extensions() {
    std::vector<std::string> names;
    try {
        for (const XrExtensionProperties& each : enumerated<XrExtensionProperties>(
                 "xrEnumerateInstanceExtensionProperties", {XR_TYPE_EXTENSION_PROPERTIES},
                 [](auto... list) {
                     return xrEnumerateInstanceExtensionProperties(nullptr, list...);
                 }))
            names.emplace_back(each.extensionName);
    } catch (const OpenXrError& error) {
        throw OpenXrError(error.result,
                          fmt::format("OpenXR: no runtime answers, expected one at {}: {}",
                                      whereabouts(), name_of(error.result)));
    }
    return names;
}

OpenXrBinding choose(const OpenXrOptions& options, const std::vector<std::string>& offered) {
    const auto has = [&](const char* name) {
        return std::ranges::find(offered, name) != offered.end();
    };
    const bool egl = has(kEgl), xlib = has(kXlib) && !options.windowless;
    switch (options.binding) {
    case OpenXrBinding::egl:
        if (egl)
            return OpenXrBinding::egl;
        break;
    case OpenXrBinding::xlib:
        if (xlib)
            return OpenXrBinding::xlib;
        break;
    case OpenXrBinding::automatic:
        if (xlib)
            return OpenXrBinding::xlib;
        if (egl)
            return OpenXrBinding::egl;
        break;
    }
    const bool needs_egl = options.windowless || options.binding == OpenXrBinding::egl;
    throw OpenXrError(XR_ERROR_EXTENSION_NOT_PRESENT,
                      fmt::format("OpenXR: the runtime at {} has no {}, expected for {}; it has {}",
                                  whereabouts(), needs_egl ? kEgl : kXlib,
                                  options.windowless ? "a context without a window" : "OpenGL",
                                  fmt::join(offered, ", ")));
}

} // namespace

OpenXrInstance::OpenXrInstance(const OpenXrOptions& options) {
    const auto offered = offered_extensions();
    binding_ = choose(options, offered);
    std::vector<const char*> wanted;
    // Enable it for EGL contexts as well: only this extension has the call for the requirements.
    if (binding_ == OpenXrBinding::xlib || std::ranges::find(offered, kXlib) != offered.end())
        wanted.push_back(kXlib);
    if (binding_ == OpenXrBinding::egl)
        wanted.push_back(kEgl);
    for (const char* name : kOptional)
        if (std::ranges::find(offered, name) != offered.end())
            wanted.push_back(name);
    enabled_.insert(wanted.begin(), wanted.end());
    create(wanted);
}

void OpenXrInstance::create(const std::vector<const char*>& extensions) {
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    std::strcpy(info.applicationInfo.applicationName, "Isochron");
    std::strcpy(info.applicationInfo.engineName, "Isochron");
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    if (const XrResult result = xrCreateInstance(&info, &instance_); XR_FAILED(result))
        throw OpenXrError(result, fmt::format("OpenXR: the runtime at {} does not start: {}",
                                              whereabouts(), name_of(result)));
}

OpenXrInstance::~OpenXrInstance() {
    xrDestroyInstance(instance_);
}

bool OpenXrInstance::find_headset() {
    XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO};
    info.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    const XrResult result = xrGetSystem(instance_, &info, &system_);
    if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE)
        return false;
    check(result, "xrGetSystem");
    return true;
}

std::vector<EyeSize> OpenXrInstance::eye_sizes() const {
    std::vector<EyeSize> sizes;
    for (const XrViewConfigurationView& view : enumerated<XrViewConfigurationView>(
             "xrEnumerateViewConfigurationViews", {XR_TYPE_VIEW_CONFIGURATION_VIEW},
             [&](auto... list) {
                 return xrEnumerateViewConfigurationViews(
                     instance_, system_, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, list...);
             }))
        sizes.push_back({{view.recommendedImageRectWidth, view.recommendedImageRectHeight},
                         {view.maxImageRectWidth, view.maxImageRectHeight}});
    if (sizes.size() != 2)
        throw OpenXrError(
            XR_ERROR_RUNTIME_FAILURE,
            fmt::format("OpenXR: the runtime has {} views, expected 2", sizes.size()));
    return sizes;
}

std::optional<XrEventDataBuffer> OpenXrInstance::next_event() const {
    XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
    if (check(xrPollEvent(instance_, &event), "xrPollEvent") == XR_EVENT_UNAVAILABLE)
        return std::nullopt;
    return event;
}

XrPath OpenXrInstance::path(const char* text) const {
    XrPath path = XR_NULL_PATH;
    check(xrStringToPath(instance_, text, &path), "xrStringToPath");
    return path;
}

PFN_xrVoidFunction OpenXrInstance::entry_point(const char* name) const {
    PFN_xrVoidFunction entry = nullptr;
    check(xrGetInstanceProcAddr(instance_, name, &entry), name);
    return entry;
}

std::string OpenXrInstance::description() const {
    XrInstanceProperties runtime{XR_TYPE_INSTANCE_PROPERTIES};
    XrSystemProperties system{XR_TYPE_SYSTEM_PROPERTIES};
    if (XR_FAILED(xrGetInstanceProperties(instance_, &runtime)))
        return "OpenXR";
    std::string text = fmt::format(
        "OpenXR, {} {}.{}.{}", runtime.runtimeName, XR_VERSION_MAJOR(runtime.runtimeVersion),
        XR_VERSION_MINOR(runtime.runtimeVersion), XR_VERSION_PATCH(runtime.runtimeVersion));
    if (system_ == XR_NULL_SYSTEM_ID ||
        XR_FAILED(xrGetSystemProperties(instance_, system_, &system)))
        return text;
    return fmt::format("{}, {}", text, system.systemName);
}

} // namespace isochron::stereo
