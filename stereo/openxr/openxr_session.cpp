// Creates an OpenXR session, and runs its frames.
#include "stereo/openxr/openxr_session.h"

#include "stereo/openxr/graphics_binding.h"
#include "stereo/openxr/openxr_error.h"
#include "stereo/openxr/openxr_poses.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>

namespace isochron::stereo {
namespace {

constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
constexpr XrViewStateFlags kKnown =
    XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;

} // namespace

OpenXrSession::OpenXrSession(const OpenXrInstance& instance, const OpenXrOptions& options,
                             const GlContext& context, const render::Gl& gl)
    : instance_(&instance), options_(options), clock_(instance) {
    create(instance, context);
    try {
        choose_space();
        choose_blending();
        head_ = reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
        make_images(gl);
    } catch (...) {
        images_ = {};
        xrDestroySession(session_);
        throw;
    }
}

OpenXrSession::~OpenXrSession() {
    images_ = {};
    xrDestroySession(session_); // also destroys its spaces
}

void OpenXrSession::create(const OpenXrInstance& instance, const GlContext& context) {
    const OpenXrGraphics graphics(instance, context.native());
    XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, graphics.next()};
    info.systemId = instance.headset();
    check(xrCreateSession(instance.handle(), &info, &session_), "xrCreateSession");
}

XrSpace OpenXrSession::reference_space(XrReferenceSpaceType type) const {
    XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
    info.referenceSpaceType = type;
    info.poseInReferenceSpace = xr_pose({});
    XrSpace space = XR_NULL_HANDLE;
    check(xrCreateReferenceSpace(session_, &info, &space), "xrCreateReferenceSpace");
    return space;
}

void OpenXrSession::choose_space() {
    const auto offered =
        enumerated<XrReferenceSpaceType>("xrEnumerateReferenceSpaces", {}, [&](auto... list) {
            return xrEnumerateReferenceSpaces(session_, list...);
        });
    const bool has_stage =
        std::ranges::find(offered, XR_REFERENCE_SPACE_TYPE_STAGE) != offered.end();
    if (options_.space == OpenXrSpace::stage && !has_stage)
        throw OpenXrError(XR_ERROR_REFERENCE_SPACE_UNSUPPORTED,
                          "OpenXR: openxr.reference_space: expected a runtime that knows the "
                          "floor (STAGE), got one that only knows LOCAL");
    stage_ = has_stage && options_.space != OpenXrSpace::local;
    space_ =
        reference_space(stage_ ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL);
    room_from_space_ = stage_ ? interaction::Pose{} : options_.local_in_room;
}

void OpenXrSession::choose_blending() {
    const auto offered = enumerated<XrEnvironmentBlendMode>(
        "xrEnumerateEnvironmentBlendModes", {}, [&](auto... list) {
            return xrEnumerateEnvironmentBlendModes(instance_->handle(), instance_->headset(),
                                                    kStereo, list...);
        });
    // The runtime prefers the first one; any will do, as our picture has its own background.
    if (!offered.empty() && std::ranges::find(offered, blending_) == offered.end())
        blending_ = offered.front();
}

void OpenXrSession::make_images(const render::Gl& gl) {
    const auto offered =
        enumerated<std::int64_t>("xrEnumerateSwapchainFormats", {}, [&](auto... list) {
            return xrEnumerateSwapchainFormats(session_, list...);
        });
    const auto color = chosen_format(offered, SwapchainContent::color);
    if (!color)
        throw OpenXrError(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED,
                          fmt::format("OpenXR: expected pictures as GL_SRGB8_ALPHA8 or GL_RGBA16F, "
                                      "the runtime has formats {:#x}",
                                      fmt::join(offered, ", ")));
    std::optional<std::int64_t> depth;
    if (options_.depth && instance_->has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME))
        depth = chosen_format(offered, SwapchainContent::depth);
    const auto sizes = instance_->eye_sizes();
    for (std::size_t i = 0; i < images_.size(); ++i) {
        sizes_[i] =
            glm::clamp(glm::ivec2(glm::round(options_.scale * glm::vec2(sizes[i].recommended))),
                       glm::ivec2(1), sizes[i].most);
        images_[i].color = std::make_unique<OpenXrSwapchain>(gl, session_, SwapchainContent::color,
                                                             *color, sizes_[i]);
        if (depth)
            images_[i].depth = std::make_unique<OpenXrSwapchain>(
                gl, session_, SwapchainContent::depth, *depth, sizes_[i]);
    }
}

void OpenXrSession::enter(XrSessionState state) {
    state_ = state;
    if (state == XR_SESSION_STATE_READY) {
        XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO};
        info.primaryViewConfigurationType = kStereo;
        check(xrBeginSession(session_, &info), "xrBeginSession");
        running_ = true;
    } else if (state == XR_SESSION_STATE_STOPPING) {
        running_ = in_frame_ = false;
        display_time_.reset();
        check(xrEndSession(session_), "xrEndSession");
    }
}

void OpenXrSession::request_exit() {
    check(xrRequestExitSession(session_), "xrRequestExitSession");
}

HeadsetFrame OpenXrSession::begin_frame(interaction::Seconds now) {
    clock_.compare(*instance_, now);
    const auto before = std::chrono::steady_clock::now();
    // The specification allows null for these, but the core validation layer does not.
    const XrFrameWaitInfo wait{XR_TYPE_FRAME_WAIT_INFO};
    const XrFrameBeginInfo begin{XR_TYPE_FRAME_BEGIN_INFO};
    XrFrameState frame{XR_TYPE_FRAME_STATE};
    check(xrWaitFrame(session_, &wait, &frame), "xrWaitFrame");
    clock_.told(frame.predictedDisplayTime, frame.predictedDisplayPeriod,
                now + (std::chrono::steady_clock::now() - before));
    check(xrBeginFrame(session_, &begin), "xrBeginFrame");
    in_frame_ = true;
    render_ = frame.shouldRender;
    display_time_ = frame.predictedDisplayTime;
    return {clock_.session_time(frame.predictedDisplayTime),
            interaction::Seconds(1e-9 * static_cast<double>(frame.predictedDisplayPeriod))};
}

std::vector<HeadsetEye> OpenXrSession::eyes() {
    if (!in_frame_ || !render_)
        return {};
    XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO};
    info.viewConfigurationType = kStereo;
    info.displayTime = *display_time_;
    info.space = space_;
    XrViewState state{XR_TYPE_VIEW_STATE};
    std::uint32_t count = 0;
    views_.fill({XR_TYPE_VIEW});
    check(xrLocateViews(session_, &info, &state, static_cast<std::uint32_t>(views_.size()), &count,
                        views_.data()),
          "xrLocateViews");
    if (count != views_.size() || (state.viewStateFlags & kKnown) != kKnown)
        return {};
    std::vector<HeadsetEye> eyes;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const XrFovf& fov = views_[i].fov;
        eyes.push_back({i == 0 ? Eye::left : Eye::right,
                        placed(room_from_space_, pose_of(views_[i].pose)),
                        {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown},
                        sizes_[i]});
    }
    return std::ranges::all_of(eyes, is_drawable) ? eyes : std::vector<HeadsetEye>();
}

void OpenXrSession::end_frame(const HeadsetPictures* pictures, bool again) {
    std::array<XrCompositionLayerDepthInfoKHR, 2> depths{};
    std::array<XrCompositionLayerProjectionView, 2> views{};
    const bool copy = !again || !filled_;
    if (copy)
        drawn_views_ = views_;
    for (std::size_t i = 0; pictures && i < views.size(); ++i) {
        const auto& [target, corner] = (*pictures)[i];
        Images& images = images_[i];
        if (copy)
            images.color->copy_from(target->framebuffer(), corner);
        views[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, nullptr, drawn_views_[i].pose,
                    drawn_views_[i].fov, images.color->image()};
        if (!images.depth)
            continue;
        if (copy)
            images.depth->copy_from(target->drawn_framebuffer(), corner);
        depths[i] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR,
                     nullptr,
                     images.depth->image(),
                     0.0f,
                     1.0f,
                     options_.near_plane,
                     options_.far_plane};
        views[i].next = &depths[i];
    }
    XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
    layer.space = space_;
    layer.viewCount = static_cast<std::uint32_t>(views.size());
    layer.views = views.data();
    const auto* base = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
    XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
    info.displayTime = *display_time_;
    info.environmentBlendMode = blending_;
    info.layerCount = pictures ? 1 : 0;
    info.layers = &base;
    in_frame_ = false;
    filled_ = filled_ || pictures;
    check(xrEndFrame(session_, &info), "xrEndFrame");
}

} // namespace isochron::stereo
