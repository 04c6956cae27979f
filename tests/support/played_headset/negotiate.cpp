// The function by which the OpenXR loader gets the played runtime's entry points.
#include "tests/support/played_headset/world.h"

#include <cstring>

namespace isochron::played {
namespace {

XrResult XRAPI_CALL get_instance_proc_addr(XrInstance, const char* name, PFN_xrVoidFunction* out) {
    static const auto entries = [] {
        std::map<std::string, Entry> all{
            {"xrGetInstanceProcAddr", reinterpret_cast<Entry>(get_instance_proc_addr)}};
        for (const auto& part : {instance_entries(), session_entries(), frame_entries(),
                                 swapchain_entries(), space_entries(), action_entries()})
            for (const NamedEntry& each : part)
                all.emplace(each.name, each.entry);
        return all;
    }();
    const auto found = entries.find(name);
    *out = found == entries.end() ? nullptr : found->second;
    return *out ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

/// From "OpenXR Loader - Design and Operation", section "Loader/Runtime Negotiation"; this
/// version's headers do not have them.
struct LoaderInfo {
    int type; ///< 1
    std::uint32_t version;
    std::size_t size;
    std::uint32_t least_interface, most_interface;
    XrVersion least_api, most_api;
};
struct RuntimeRequest {
    int type; ///< 3
    std::uint32_t version;
    std::size_t size;
    std::uint32_t interface;
    XrVersion api;
    PFN_xrGetInstanceProcAddr get_instance_proc_addr;
};
constexpr int kLoaderInfo = 1, kRuntimeRequest = 3;
constexpr std::uint32_t kInterface = 1;

} // namespace
} // namespace isochron::played

extern "C" PLAYED_HEADSET_API XrResult XRAPI_CALL xrNegotiateLoaderRuntimeInterface(
    const isochron::played::LoaderInfo* loader, isochron::played::RuntimeRequest* runtime) {
    using namespace isochron::played;
    if (!loader || !runtime || loader->type != kLoaderInfo || runtime->type != kRuntimeRequest ||
        loader->least_interface > kInterface || loader->most_interface < kInterface)
        return XR_ERROR_INITIALIZATION_FAILED;
    runtime->interface = kInterface;
    runtime->api = XR_CURRENT_API_VERSION;
    runtime->get_instance_proc_addr = get_instance_proc_addr;
    read_script();
    return XR_SUCCESS;
}
