// The played runtime's instance: extensions, paths, events, the system, and the clock.
#include "tests/support/played_headset/world.h"

#include <openxr/openxr_reflection.h>

#include <cstring>

namespace isochron::played {
namespace {

constexpr XrSystemId kSystem = 7;

std::vector<std::string> offered_extensions() {
    const PlayedHeadset& headset = world().headset;
    std::vector<std::string> names;
    const auto offer = [&](bool has, const char* name) {
        if (has)
            names.emplace_back(name);
    };
    offer(headset.has_xlib, XR_KHR_OPENGL_ENABLE_EXTENSION_NAME);
    offer(headset.has_egl, "XR_MNDX_egl_enable");
    offer(headset.has_depth, XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
    offer(headset.has_clock, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
    return names;
}

template <std::size_t kSize>
void copy_text(char (&into)[kSize], const std::string& text) {
    std::strncpy(into, text.c_str(), kSize - 1);
    into[kSize - 1] = 0;
}

XrResult XRAPI_CALL enumerate_extensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                                         XrExtensionProperties* out) {
    const auto names = offered_extensions();
    return fill(names.size(), capacity, count, out, [&](XrExtensionProperties& to, std::size_t i) {
        has_type(&to, XR_TYPE_EXTENSION_PROPERTIES, "xrEnumerateInstanceExtensionProperties");
        copy_text(to.extensionName, names[i]);
        to.extensionVersion = 1;
    });
}

XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info, XrInstance* out) {
    constexpr const char* kCall = "xrCreateInstance";
    if (!has_type(info, XR_TYPE_INSTANCE_CREATE_INFO, kCall))
        return XR_ERROR_VALIDATION_FAILURE;
    World& here = world();
    if (!here.headset.runtime_available)
        return XR_ERROR_RUNTIME_UNAVAILABLE;
    if (here.instance)
        return refuse(kCall, "second_instance", XR_ERROR_LIMIT_REACHED, "one lives already");
    const auto offered = offered_extensions();
    here.extensions.clear();
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
        const std::string name = info->enabledExtensionNames[i];
        if (std::find(offered.begin(), offered.end(), name) == offered.end())
            return refuse(kCall, "unknown_extension", XR_ERROR_EXTENSION_NOT_PRESENT, name);
        here.extensions.insert(name);
    }
    *out = new_handle<XrInstance>();
    here.instance = id_of(*out);
    here.instance_lost = here.requirements_asked = here.system_asked = false;
    here.paths.clear();
    ++here.headset.instances;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_instance(XrInstance instance) {
    World& here = world();
    if (id_of(instance) != here.instance || !here.instance)
        return refuse("xrDestroyInstance", "dead_handle", XR_ERROR_HANDLE_INVALID, "no instance");
    if (here.session)
        refuse("xrDestroyInstance", "child_alive", XR_SUCCESS, "its session lives");
    here.session.reset();
    here.swapchains.clear();
    here.spaces.clear();
    here.sets.clear();
    here.actions.clear();
    here.suggestions.clear();
    here.events.clear();
    here.instance = 0;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL instance_properties(XrInstance instance, XrInstanceProperties* out) {
    if (const XrResult bad = check_instance(instance, "xrGetInstanceProperties"); bad)
        return bad;
    has_type(out, XR_TYPE_INSTANCE_PROPERTIES, "xrGetInstanceProperties");
    out->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
    copy_text(out->runtimeName, "Played headset");
    return XR_SUCCESS;
}

XrResult XRAPI_CALL poll_event(XrInstance instance, XrEventDataBuffer* out) {
    if (const XrResult bad = check_instance(instance, "xrPollEvent"); bad)
        return bad;
    if (!has_type(out, XR_TYPE_EVENT_DATA_BUFFER, "xrPollEvent"))
        return XR_ERROR_VALIDATION_FAILURE;
    auto& events = world().events;
    if (events.empty())
        happen();
    if (world().instance_lost)
        return XR_ERROR_INSTANCE_LOST;
    if (events.empty())
        return XR_EVENT_UNAVAILABLE;
    *out = events.front();
    events.pop_front();
    return XR_SUCCESS;
}

#define PLAYED_CASE(name, value)                                                                   \
    case name: text = #name; break;

XrResult XRAPI_CALL result_to_string(XrInstance, XrResult value, char* out) {
    const char* text = nullptr;
    switch (value) { XR_LIST_ENUM_XrResult(PLAYED_CASE) default : text = "?"; }
    std::strncpy(out, text, XR_MAX_RESULT_STRING_SIZE);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL structure_to_string(XrInstance, XrStructureType value, char* out) {
    const char* text = nullptr;
    switch (value) { XR_LIST_ENUM_XrStructureType(PLAYED_CASE) default : text = "?"; }
    std::strncpy(out, text, XR_MAX_STRUCTURE_NAME_SIZE);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL string_to_path(XrInstance instance, const char* text, XrPath* out) {
    if (const XrResult bad = check_instance(instance, "xrStringToPath"); bad)
        return bad;
    if (text[0] != '/')
        return refuse("xrStringToPath", "bad_path", XR_ERROR_PATH_FORMAT_INVALID, text);
    *out = world().path_of(text);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL path_to_string(XrInstance instance, XrPath path, std::uint32_t capacity,
                                   std::uint32_t* count, char* out) {
    if (const XrResult bad = check_instance(instance, "xrPathToString"); bad)
        return bad;
    const std::string text = world().path(path);
    if (text.empty())
        return refuse("xrPathToString", "bad_path", XR_ERROR_PATH_INVALID, std::to_string(path));
    return fill(text.size() + 1, capacity, count, out,
                [&](char& to, std::size_t i) { to = text.c_str()[i]; });
}

XrResult XRAPI_CALL get_system(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* out) {
    if (const XrResult bad = check_instance(instance, "xrGetSystem"); bad)
        return bad;
    has_type(info, XR_TYPE_SYSTEM_GET_INFO, "xrGetSystem");
    if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY)
        return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
    if (!world().headset.connected)
        return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
    world().system_asked = true;
    *out = kSystem;
    return XR_SUCCESS;
}

XrResult check_system(XrInstance instance, XrSystemId system, const char* call) {
    if (const XrResult bad = check_instance(instance, call); bad)
        return bad;
    return system == kSystem && world().system_asked
               ? XR_SUCCESS
               : refuse(call, "bad_system", XR_ERROR_SYSTEM_INVALID, std::to_string(system));
}

XrResult XRAPI_CALL system_properties(XrInstance instance, XrSystemId system,
                                      XrSystemProperties* out) {
    if (const XrResult bad = check_system(instance, system, "xrGetSystemProperties"); bad)
        return bad;
    has_type(out, XR_TYPE_SYSTEM_PROPERTIES, "xrGetSystemProperties");
    out->systemId = system;
    out->vendorId = 0;
    copy_text(out->systemName, "Played headset");
    out->graphicsProperties = {4096, 4096, 16};
    out->trackingProperties = {XR_TRUE, XR_TRUE};
    return XR_SUCCESS;
}

XrResult XRAPI_CALL blend_modes(XrInstance instance, XrSystemId system, XrViewConfigurationType,
                                std::uint32_t capacity, std::uint32_t* count,
                                XrEnvironmentBlendMode* out) {
    if (const XrResult bad = check_system(instance, system, "xrEnumerateEnvironmentBlendModes");
        bad)
        return bad;
    return fill(1, capacity, count, out, [](XrEnvironmentBlendMode& to, std::size_t) {
        to = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    });
}

XrResult XRAPI_CALL view_configurations(XrInstance instance, XrSystemId system,
                                        std::uint32_t capacity, std::uint32_t* count,
                                        XrViewConfigurationType* out) {
    if (const XrResult bad = check_system(instance, system, "xrEnumerateViewConfigurations"); bad)
        return bad;
    return fill(1, capacity, count, out, [](XrViewConfigurationType& to, std::size_t) {
        to = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    });
}

XrResult XRAPI_CALL view_properties(XrInstance instance, XrSystemId system,
                                    XrViewConfigurationType type,
                                    XrViewConfigurationProperties* out) {
    if (const XrResult bad = check_system(instance, system, "xrGetViewConfigurationProperties");
        bad)
        return bad;
    out->viewConfigurationType = type;
    out->fovMutable = XR_FALSE;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL configuration_views(XrInstance instance, XrSystemId system,
                                        XrViewConfigurationType type, std::uint32_t capacity,
                                        std::uint32_t* count, XrViewConfigurationView* out) {
    constexpr const char* kCall = "xrEnumerateViewConfigurationViews";
    if (const XrResult bad = check_system(instance, system, kCall); bad)
        return bad;
    if (type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
        return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
    return fill(2, capacity, count, out, [&](XrViewConfigurationView& to, std::size_t i) {
        has_type(&to, XR_TYPE_VIEW_CONFIGURATION_VIEW, kCall);
        const glm::uvec2 size(world().headset.eyes[i].size);
        to.recommendedImageRectWidth = size.x;
        to.recommendedImageRectHeight = size.y;
        to.maxImageRectWidth = to.maxImageRectHeight = 4096;
        to.recommendedSwapchainSampleCount = 1;
        to.maxSwapchainSampleCount = 4;
    });
}

XrResult XRAPI_CALL gl_requirements(XrInstance instance, XrSystemId system,
                                    XrGraphicsRequirementsOpenGLKHR* out) {
    if (const XrResult bad = check_system(instance, system, "xrGetOpenGLGraphicsRequirementsKHR");
        bad)
        return bad;
    has_type(out, XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR, "xrGetOpenGLGraphicsRequirementsKHR");
    out->minApiVersionSupported = XR_MAKE_VERSION(3, 3, 0);
    out->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
    world().requirements_asked = true;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL time_of_timespec(XrInstance instance, const timespec* time, XrTime* out) {
    if (const XrResult bad = check_instance(instance, "xrConvertTimespecTimeToTimeKHR"); bad)
        return bad;
    *out = time->tv_sec * 1'000'000'000ll + time->tv_nsec;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL timespec_of_time(XrInstance instance, XrTime time, timespec* out) {
    if (const XrResult bad = check_instance(instance, "xrConvertTimeToTimespecTimeKHR"); bad)
        return bad;
    out->tv_sec = time / 1'000'000'000ll;
    out->tv_nsec = time % 1'000'000'000ll;
    return XR_SUCCESS;
}

} // namespace

std::vector<NamedEntry> instance_entries() {
    return {named("xrEnumerateInstanceExtensionProperties", enumerate_extensions),
            named("xrCreateInstance", create_instance),
            named("xrDestroyInstance", destroy_instance),
            named("xrGetInstanceProperties", instance_properties),
            named("xrPollEvent", poll_event),
            named("xrResultToString", result_to_string),
            named("xrStructureTypeToString", structure_to_string),
            named("xrStringToPath", string_to_path),
            named("xrPathToString", path_to_string),
            named("xrGetSystem", get_system),
            named("xrGetSystemProperties", system_properties),
            named("xrEnumerateEnvironmentBlendModes", blend_modes),
            named("xrEnumerateViewConfigurations", view_configurations),
            named("xrGetViewConfigurationProperties", view_properties),
            named("xrEnumerateViewConfigurationViews", configuration_views),
            named("xrGetOpenGLGraphicsRequirementsKHR", gl_requirements),
            named("xrConvertTimespecTimeToTimeKHR", time_of_timespec),
            named("xrConvertTimeToTimespecTimeKHR", timespec_of_time)};
}

} // namespace isochron::played
