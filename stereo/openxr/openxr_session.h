// One OpenXR session: its states, its frames, and their pictures.
#pragma once

#include "stereo/headset.h"
#include "stereo/openxr/openxr_clock.h"
#include "stereo/openxr/openxr_instance.h"
#include "stereo/openxr/openxr_swapchain.h"

#include <openxr/openxr.h>

#include <array>
#include <memory>
#include <optional>

namespace isochron::stereo {

/// Calls throw OpenXrError. If the session or instance is lost, this object can only be destroyed.
class OpenXrSession {
  public:
    OpenXrSession(const OpenXrInstance& instance, const OpenXrOptions& options,
                  const GlContext& context, const render::Gl& gl);
    ~OpenXrSession();
    OpenXrSession(const OpenXrSession&) = delete;
    OpenXrSession& operator=(const OpenXrSession&) = delete;

    XrSession handle() const { return session_; }
    XrSessionState state() const { return state_; }
    bool running() const { return running_; } ///< between xrBeginSession and xrEndSession
    /// Follows the runtime into a state: begins the session when READY, ends it when STOPPING.
    void enter(XrSessionState state);
    void request_exit();

    /// Waits for the runtime, then begins a frame.
    HeadsetFrame begin_frame(interaction::Seconds now);
    bool in_frame() const { return in_frame_; }
    std::vector<HeadsetEye> eyes();
    void end_frame(const HeadsetPictures* pictures, bool again);

    /// The time for which poses are located; empty before the first frame.
    std::optional<XrTime> display_time() const { return display_time_; }
    XrSpace room_space() const { return space_; }
    XrSpace head_space() const { return head_; }
    const interaction::Pose& room_from_space() const { return room_from_space_; }
    bool has_stage() const { return stage_; }
    bool has_depth() const { return images_[0].depth != nullptr; }

  private:
    void create(const OpenXrInstance& instance, const GlContext& context);
    void choose_space();
    void choose_blending();
    void make_images(const render::Gl& gl);
    XrSpace reference_space(XrReferenceSpaceType type) const;

    /// One eye's pictures.
    struct Images {
        std::unique_ptr<OpenXrSwapchain> color, depth;
    };
    const OpenXrInstance* instance_;
    OpenXrOptions options_;
    OpenXrClock clock_;
    XrSession session_ = XR_NULL_HANDLE;
    XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
    bool running_ = false, in_frame_ = false, render_ = false, stage_ = false;
    XrSpace space_ = XR_NULL_HANDLE, head_ = XR_NULL_HANDLE;
    interaction::Pose room_from_space_;
    std::array<glm::ivec2, 2> sizes_{};
    std::array<Images, 2> images_;
    bool filled_ = false;                 ///< the runtime has got pictures
    std::array<XrView, 2> views_{};       ///< as located last
    std::array<XrView, 2> drawn_views_{}; ///< views of the pictures that the images hold
    XrEnvironmentBlendMode blending_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    std::optional<XrTime> display_time_;
};

} // namespace isochron::stereo
