// A simple OpenXR program, without any of the code under test.
#include "stereo/openxr/openxr_platform.h"

#include "tests/stereo/openxr/rough_client.h"

#include <GL/glcorearb.h>

#include <cstring>
#include <vector>

namespace isochron::played {
namespace {

constexpr XrPosef kNowhere{{0, 0, 0, 1}, {0, 0, 0}};
constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
constexpr int kFrames = 6;

class Client {
  public:
    Client(const stereo::EglHandles& context, Mistake mistake)
        : context_(context), mistake_(mistake) {}

    void run() {
        start();
        if (session_) {
            prepare_input();
            prepare_picture();
            wait_for(XR_SESSION_STATE_READY);
            begin();
            for (int i = 0; i < kFrames; ++i) {
                poll();
                frame();
            }
            stop();
        }
        xrDestroyInstance(instance_);
    }

  private:
    bool makes(Mistake mistake) const { return mistake_ == mistake; }

    void start() {
        const char* extensions[] = {"XR_KHR_opengl_enable", "XR_MNDX_egl_enable"};
        XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
        std::strcpy(info.applicationInfo.applicationName, "Rough client");
        info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
        info.enabledExtensionCount = 2;
        info.enabledExtensionNames = extensions;
        xrCreateInstance(&info, &instance_);
        XrSystemGetInfo system{XR_TYPE_SYSTEM_GET_INFO};
        system.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
        XrSystemId id = XR_NULL_SYSTEM_ID;
        xrGetSystem(instance_, &system, &id);
        if (!makes(Mistake::requirements_not_asked))
            ask_requirements(id);
        XrGraphicsBindingEGLMNDX binding{XR_TYPE_GRAPHICS_BINDING_EGL_MNDX};
        binding.getProcAddress = context_.get_proc_address;
        binding.display = context_.display;
        binding.context = context_.context;
        XrSessionCreateInfo session{XR_TYPE_SESSION_CREATE_INFO, &binding};
        session.systemId = id;
        xrCreateSession(instance_, &session, &session_);
    }

    void ask_requirements(XrSystemId id) {
        PFN_xrGetOpenGLGraphicsRequirementsKHR ask = nullptr;
        xrGetInstanceProcAddr(instance_, "xrGetOpenGLGraphicsRequirementsKHR",
                              reinterpret_cast<PFN_xrVoidFunction*>(&ask));
        XrGraphicsRequirementsOpenGLKHR wanted{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR};
        ask(instance_, id, &wanted);
    }

    void suggest() {
        XrPath profile = XR_NULL_PATH, path = XR_NULL_PATH;
        xrStringToPath(instance_, "/interaction_profiles/khr/simple_controller", &profile);
        xrStringToPath(instance_, "/user/hand/right/input/select/click", &path);
        const XrActionSuggestedBinding binding{press_, path};
        XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
        info.interactionProfile = profile;
        info.countSuggestedBindings = 1;
        info.suggestedBindings = &binding;
        xrSuggestInteractionProfileBindings(instance_, &info);
    }

    void prepare_input() {
        XrActionSetCreateInfo set{XR_TYPE_ACTION_SET_CREATE_INFO};
        std::strcpy(set.actionSetName, "all");
        std::strcpy(set.localizedActionSetName, "All");
        xrCreateActionSet(instance_, &set, &set_);
        XrActionCreateInfo action{XR_TYPE_ACTION_CREATE_INFO};
        action.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
        std::strcpy(action.actionName, "press");
        std::strcpy(action.localizedActionName, "Press");
        xrCreateAction(set_, &action, &press_);
        if (!makes(Mistake::suggests_late))
            suggest();
        XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO};
        info.countActionSets = 1;
        info.actionSets = &set_;
        xrAttachSessionActionSets(session_, &info);
        if (makes(Mistake::attaches_twice))
            xrAttachSessionActionSets(session_, &info);
        if (makes(Mistake::suggests_late))
            suggest();
    }

    void prepare_picture() {
        XrReferenceSpaceCreateInfo space{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
        if (makes(Mistake::forgets_a_type))
            space.type = XR_TYPE_UNKNOWN;
        space.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL;
        space.poseInReferenceSpace = kNowhere;
        xrCreateReferenceSpace(session_, &space, &space_);
        XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
        info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
        info.format = GL_SRGB8_ALPHA8;
        if (makes(Mistake::asks_for_another_format))
            info.format = GL_R8;
        info.sampleCount = info.faceCount = info.mipCount = 1;
        info.arraySize = 2;
        info.width = info.height = kSide;
        xrCreateSwapchain(session_, &info, &swapchain_);
    }

    void poll() {
        XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
        if (xrPollEvent(instance_, &event) != XR_SUCCESS ||
            event.type != XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
            return;
        state_ = reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state;
        if (state_ == XR_SESSION_STATE_STOPPING)
            xrEndSession(session_);
    }

    void wait_for(XrSessionState state) {
        if (makes(Mistake::begins_before_ready))
            begin();
        for (int i = 0; i < kFrames && state_ != state; ++i)
            poll();
    }

    void begin() {
        XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO};
        info.primaryViewConfigurationType = kStereo;
        xrBeginSession(session_, &info);
    }

    void draw_nothing() {
        std::uint32_t index = 0;
        xrAcquireSwapchainImage(swapchain_, nullptr, &index);
        XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
        wait.timeout = XR_INFINITE_DURATION;
        if (!makes(Mistake::releases_image_without_wait))
            xrWaitSwapchainImage(swapchain_, &wait);
        if (!makes(Mistake::keeps_image))
            xrReleaseSwapchainImage(swapchain_, nullptr);
    }

    void locate(XrTime time) {
        XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO};
        info.viewConfigurationType = kStereo;
        info.displayTime = time;
        info.space = space_;
        XrViewState state{XR_TYPE_VIEW_STATE};
        std::uint32_t count = 0;
        xrLocateViews(session_, &info, &state, 2, &count, views_.data());
    }

    void read_input() {
        const XrActiveActionSet active{set_, XR_NULL_PATH};
        XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO};
        info.countActiveActionSets = 1;
        info.activeActionSets = &active;
        if (!makes(Mistake::reads_before_sync))
            xrSyncActions(session_, &info);
        XrActionStateGetInfo get{XR_TYPE_ACTION_STATE_GET_INFO};
        get.action = press_;
        XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
        xrGetActionStateBoolean(session_, &get, &state);
    }

    void frame() {
        XrFrameState told{XR_TYPE_FRAME_STATE};
        if (!makes(Mistake::begins_frame_without_wait))
            xrWaitFrame(session_, nullptr, &told);
        if (makes(Mistake::waits_twice))
            xrWaitFrame(session_, nullptr, &told);
        if (!makes(Mistake::ends_frame_without_begin))
            xrBeginFrame(session_, nullptr);
        read_input();
        if (told.shouldRender && !makes(Mistake::never_locates_views))
            locate(told.predictedDisplayTime);
        if (told.shouldRender)
            draw_nothing();
        end(told);
    }

    void end(const XrFrameState& told) {
        std::array<XrCompositionLayerProjectionView, 2> views{};
        for (std::uint32_t i = 0; i < 2; ++i) {
            const XrView& view = views_[makes(Mistake::exchanges_eyes) ? 1 - i : i];
            const int side = kSide + (makes(Mistake::shows_more_than_the_image) ? 1 : 0);
            views[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                        nullptr,
                        view.pose,
                        view.fov,
                        {swapchain_, {{0, 0}, {side, side}}, i}};
        }
        XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
        layer.space = space_;
        layer.viewCount = 2;
        layer.views = views.data();
        const auto* base = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
        XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
        info.displayTime = told.predictedDisplayTime;
        if (makes(Mistake::ends_frame_for_another_time))
            info.displayTime += told.predictedDisplayPeriod;
        info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
        info.layerCount = told.shouldRender ? 1 : 0;
        info.layers = &base;
        xrEndFrame(session_, &info);
    }

    void stop() {
        if (!makes(Mistake::leaves_while_running)) {
            xrRequestExitSession(session_);
            for (int i = 0; i < 3 * kFrames && state_ != XR_SESSION_STATE_EXITING; ++i)
                poll();
        }
        if (swapchain_)
            xrDestroySwapchain(swapchain_);
        xrDestroySession(session_);
    }

    static constexpr int kSide = 32;
    const stereo::EglHandles& context_;
    Mistake mistake_;
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSession session_ = XR_NULL_HANDLE;
    XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
    XrActionSet set_ = XR_NULL_HANDLE;
    XrAction press_ = XR_NULL_HANDLE;
    XrSpace space_ = XR_NULL_HANDLE;
    XrSwapchain swapchain_ = XR_NULL_HANDLE;
    std::array<XrView, 2> views_{XrView{XR_TYPE_VIEW, nullptr, kNowhere, {}},
                                 XrView{XR_TYPE_VIEW, nullptr, kNowhere, {}}};
};

} // namespace

void run_client(const stereo::EglHandles& context, Mistake mistake) {
    Client(context, mistake).run();
}

} // namespace isochron::played
