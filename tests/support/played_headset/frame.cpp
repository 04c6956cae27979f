// The played runtime's frames: their order, and the contents of their layers.
#include "tests/support/played_headset/world.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace isochron::played {
namespace {

constexpr const char* kEnd = "xrEndFrame";

std::int64_t now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * 1'000'000'000ll + time.tv_nsec;
}

XrResult check_running(XrSession session, const char* call) {
    if (const XrResult bad = check_session(session, call); bad)
        return bad;
    return world().session->begun ? XR_SUCCESS
                                  : refuse(call, "not_running", XR_ERROR_SESSION_NOT_RUNNING,
                                           "the session has not begun");
}

bool to_be_drawn(const Session& session) {
    return session.state == XR_SESSION_STATE_VISIBLE || session.state == XR_SESSION_STATE_FOCUSED;
}

XrResult XRAPI_CALL wait_frame(XrSession session, const XrFrameWaitInfo* info, XrFrameState* out) {
    constexpr const char* kCall = "xrWaitFrame";
    if (const XrResult bad = check_running(session, kCall); bad)
        return bad;
    if (info)
        has_type(info, XR_TYPE_FRAME_WAIT_INFO, kCall);
    has_type(out, XR_TYPE_FRAME_STATE, kCall);
    World& here = world();
    Session& mine = *here.session;
    if (mine.frame == FrameStage::waited)
        return refuse(kCall, "wait_twice", XR_ERROR_CALL_ORDER_INVALID,
                      "the last frame was not begun: this would wait for ever");
    play_script(here.headset.waits++);
    happen();
    if (mine.lost)
        return XR_ERROR_SESSION_LOST;
    if (here.instance_lost)
        return XR_ERROR_INSTANCE_LOST;
    const std::int64_t period = here.headset.period;
    const std::int64_t next = mine.display_time + period;
    if (here.headset.paced && next - period > now())
        std::this_thread::sleep_for(std::chrono::nanoseconds(next - period - now()));
    mine.display_time =
        mine.display_time == 0 || here.headset.paced ? std::max(next, now() + period) : next;
    mine.frame = FrameStage::waited;
    mine.views_located = false;
    out->predictedDisplayTime = mine.display_time;
    out->predictedDisplayPeriod = period;
    out->shouldRender = to_be_drawn(mine);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL begin_frame(XrSession session, const XrFrameBeginInfo* info) {
    constexpr const char* kCall = "xrBeginFrame";
    if (const XrResult bad = check_running(session, kCall); bad)
        return bad;
    if (info)
        has_type(info, XR_TYPE_FRAME_BEGIN_INFO, kCall);
    Session& mine = *world().session;
    if (mine.frame != FrameStage::waited)
        return refuse(kCall, "begin_without_wait", XR_ERROR_CALL_ORDER_INVALID,
                      "xrWaitFrame has not told of a frame");
    mine.frame = FrameStage::begun;
    return XR_SUCCESS;
}

/// Reads the part of a swapchain's image that a view shows, top row first.
template <typename T>
std::vector<T> read(const XrSwapchainSubImage& part, GLenum format, GLenum type, int channels) {
    const Swapchain& from = world().swapchains.at(id_of(part.swapchain));
    const render::Gl& gl = *world().session->gl;
    const XrRect2Di& rect = part.imageRect;
    const std::size_t row = static_cast<std::size_t>(rect.extent.width) * channels;
    std::vector<T> picture(row * rect.extent.height);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.GetTextureSubImage(from.textures[*from.released], 0, rect.offset.x, rect.offset.y,
                          static_cast<GLint>(part.imageArrayIndex), rect.extent.width,
                          rect.extent.height, 1, format, type,
                          static_cast<GLsizei>(picture.size() * sizeof(T)), picture.data());
    for (std::size_t low = 0, high = rect.extent.height - 1; low < high; ++low, --high)
        std::swap_ranges(picture.begin() + low * row, picture.begin() + (low + 1) * row,
                         picture.begin() + high * row);
    return picture;
}

XrResult check_part(const XrSwapchainSubImage& part) {
    const auto at = world().swapchains.find(id_of(part.swapchain));
    if (at == world().swapchains.end())
        return refuse(kEnd, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such swapchain");
    const Swapchain& swapchain = at->second;
    if (!swapchain.acquired.empty())
        refuse(kEnd, "image_not_released", XR_SUCCESS, "an image of the layer is still acquired");
    if (!swapchain.released)
        return refuse(kEnd, "no_image", XR_ERROR_LAYER_INVALID, "no image was ever released");
    const XrRect2Di& rect = part.imageRect;
    if (rect.offset.x < 0 || rect.offset.y < 0 || rect.extent.width < 1 || rect.extent.height < 1 ||
        rect.offset.x + rect.extent.width > int(swapchain.info.width) ||
        rect.offset.y + rect.extent.height > int(swapchain.info.height) ||
        part.imageArrayIndex >= swapchain.info.arraySize)
        return refuse(kEnd, "rect_outside", XR_ERROR_SWAPCHAIN_RECT_INVALID,
                      "the part lies outside its image");
    return XR_SUCCESS;
}

constexpr float kSame = 1e-4f; ///< [m, rad] rounding error between spaces

bool same(const interaction::Pose& a, const interaction::Pose& b) {
    return glm::length(a.position - b.position) < kSame &&
           std::abs(glm::dot(a.orientation, b.orientation)) > 1.0f - kSame;
}

XrResult check_view(const XrCompositionLayerProjectionView& view, const Space& space, std::size_t i,
                    SubmittedView& out) {
    has_type(&view, XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, kEnd);
    if (const XrResult bad = check_part(view.subImage); bad)
        return bad;
    if (!is_unit(view.pose))
        return refuse(kEnd, "pose_not_unit", XR_ERROR_POSE_INVALID, "of a view");
    const Session& mine = *world().session;
    const auto origin = locate(space);
    out.pose = compose(origin ? origin->pose : interaction::Pose{}, from_xr(view.pose));
    out.fov = {view.fov.angleLeft, view.fov.angleRight, view.fov.angleUp, view.fov.angleDown};
    if (!same(out.pose, mine.filled[i]) || out.fov != world().headset.eyes[i].fov)
        refuse(kEnd, "other_view", XR_SUCCESS, "a view is not as its picture was drawn for");
    return XR_SUCCESS;
}

XrResult take_depth(const XrCompositionLayerProjectionView& view, SubmittedView& out) {
    const auto* depth = static_cast<const XrCompositionLayerDepthInfoKHR*>(
        in_chain(view.next, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR));
    if (!depth)
        return XR_SUCCESS;
    if (!world().extensions.contains(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME))
        return refuse(kEnd, "unknown_extension", XR_ERROR_VALIDATION_FAILURE, "depth layer");
    if (const XrResult bad = check_part(depth->subImage); bad)
        return bad;
    if (depth->minDepth < 0 || depth->maxDepth > 1 || depth->minDepth > depth->maxDepth ||
        depth->nearZ == depth->farZ)
        return refuse(kEnd, "bad_depth", XR_ERROR_VALIDATION_FAILURE, "range of depths");
    out.near_z = depth->nearZ;
    out.far_z = depth->farZ;
    if (world().headset.keep_pictures)
        out.depth = read<float>(depth->subImage, GL_DEPTH_COMPONENT, GL_FLOAT, 1);
    return XR_SUCCESS;
}

XrResult take_projection(const XrCompositionLayerProjection& layer, SubmittedFrame& frame) {
    const auto space = world().spaces.find(id_of(layer.space));
    if (space == world().spaces.end())
        return refuse(kEnd, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such space");
    if (layer.viewCount != 2)
        return refuse(kEnd, "bad_views", XR_ERROR_VALIDATION_FAILURE, "two views are expected");
    const Session& mine = *world().session;
    if (!mine.views_located)
        refuse(kEnd, "views_not_located", XR_SUCCESS, "xrLocateViews was not called");
    else if (!mine.views_valid)
        refuse(kEnd, "views_not_valid", XR_SUCCESS, "views are shown that are not valid");
    for (std::uint32_t i = 0; i < layer.viewCount; ++i) {
        SubmittedView out;
        if (const XrResult bad = check_view(layer.views[i], space->second, i, out); bad)
            return bad;
        if (const XrResult bad = take_depth(layer.views[i], out); bad)
            return bad;
        const XrRect2Di& rect = layer.views[i].subImage.imageRect;
        if (world().headset.keep_pictures)
            out.picture = {
                rect.extent.width, rect.extent.height,
                read<std::uint8_t>(layer.views[i].subImage, GL_RGBA, GL_UNSIGNED_BYTE, 4)};
        frame.views.push_back(std::move(out));
    }
    return XR_SUCCESS;
}

XrResult XRAPI_CALL end_frame(XrSession session, const XrFrameEndInfo* info) {
    if (const XrResult bad = check_running(session, kEnd); bad)
        return bad;
    if (!has_type(info, XR_TYPE_FRAME_END_INFO, kEnd))
        return XR_ERROR_VALIDATION_FAILURE;
    Session& mine = *world().session;
    if (mine.frame != FrameStage::begun)
        return refuse(kEnd, "end_without_begin", XR_ERROR_CALL_ORDER_INVALID,
                      "xrBeginFrame was not called");
    mine.frame = FrameStage::idle;
    if (info->displayTime != mine.display_time)
        return refuse(kEnd, "other_time", XR_ERROR_TIME_INVALID, "not the predicted display time");
    if (info->environmentBlendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE)
        return refuse(kEnd, "bad_blending", XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED, "");
    SubmittedFrame frame{info->displayTime, {}};
    for (std::uint32_t i = 0; i < info->layerCount; ++i) {
        const XrCompositionLayerBaseHeader* layer = info->layers[i];
        if (!layer || layer->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION)
            return refuse(kEnd, "bad_layer", XR_ERROR_LAYER_INVALID, "a projection is expected");
        if (const XrResult bad = take_projection(
                *reinterpret_cast<const XrCompositionLayerProjection*>(layer), frame);
            bad)
            return bad;
    }
    world().headset.frames.push_back(std::move(frame));
    // A session is SYNCHRONIZED after its first frame.
    if (mine.state == XR_SESSION_STATE_READY)
        push_state(XR_SESSION_STATE_SYNCHRONIZED);
    return XR_SUCCESS;
}

} // namespace

std::vector<NamedEntry> frame_entries() {
    return {named("xrWaitFrame", wait_frame), named("xrBeginFrame", begin_frame),
            named("xrEndFrame", end_frame)};
}

} // namespace isochron::played
