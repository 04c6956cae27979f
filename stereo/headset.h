// A headset: when it wants a picture, where its eyes are, and the wearer's input.
//
//     headset->update(now);                            // events, and a lost one comes back
//     const auto frame = headset->begin_frame(now);    // blocks: the headset paces the program
//     const auto input = headset->poll(now);
//     for (const HeadsetEye& eye : headset->eyes())    // as late as can be
//         draw(view_of(eye, near_plane, far_plane));
//     if (frame)
//         headset->end_frame(&pictures, false);
#pragma once

#include "interaction/input/tracked_input.h"
#include "render/gl/render_target.h"
#include "render/gl/view.h"
#include "stereo/context/gl_context.h"
#include "stereo/stereo_mode.h"

#include <array>
#include <string>

namespace isochron::stereo {

/// Angles [rad] between straight ahead and the edges of an eye's picture; left and down negative.
struct FieldOfView {
    float left = 0, right = 0, up = 0, down = 0;
    bool operator==(const FieldOfView&) const = default;
};

/// One eye for one picture. Eyes may be canted, so each has its own direction.
struct HeadsetEye {
    Eye eye = Eye::left;
    interaction::Pose pose; ///< in the room
    FieldOfView fov;
    glm::ivec2 pixels{0};
    bool operator==(const HeadsetEye&) const = default;
};

/// Whether the eye's values can be used: all finite, left < right, down < up, all angles below 90
/// degrees.
bool is_drawable(const HeadsetEye& eye);

/// The view of an eye: its edges fall on the edges of clip space.
/// @param near_plane, far_plane [m] along the eye's direction, 0 < near < far
render::View view_of(const HeadsetEye& eye, float near_plane, float far_plane);

/// The picture to show to an eye: a part of a target with the eye's size.
struct HeadsetPicture {
    const render::RenderTarget* target = nullptr;
    glm::ivec2 corner{0}; ///< lower left in the target
};
using HeadsetPictures = std::array<HeadsetPicture, 2>; ///< left, right

enum class HeadsetState : std::uint8_t {
    absent, ///< no runtime, or no headset; `update` tries again
    idle,   ///< wants no frames now
    running,
    ended ///< the user has ended the program through the headset
};

struct HeadsetFrame {
    interaction::Seconds display_time{0}; ///< session time at which the picture is visible
    interaction::Seconds period{0};       ///< between two frames
};

/// `poll` gives the devices `head`, `wand` and `wand2`, and `keys` for further actions of the
/// hands' buttons.
class Headset : public interaction::TrackedInput {
  public:
    /// The API with which the drawing context must be made.
    virtual ContextApi context_api() const = 0;
    /// Uses this context until `detach`: it must be current now and in all further calls, and both
    /// parameters must live until then. @throws render::Error when the headset can never use it
    virtual void attach(GlContext& drawing, const render::Gl& gl) = 0;
    /// Releases everything that belongs to the context.
    virtual void detach() = 0;

    virtual HeadsetState update(interaction::Seconds now) = 0;
    /// Begins a frame; may block. @return empty if no frame has begun, without blocking
    virtual std::optional<HeadsetFrame> begin_frame(interaction::Seconds now) = 0;
    /// Where the eyes will be when the frame is visible, left and right; empty if no picture is
    /// wanted.
    virtual std::vector<HeadsetEye> eyes() = 0;
    /// Ends the current frame, if there is one.
    /// @param pictures null: show nothing
    /// @param again shows the pictures of an earlier frame again, which the headset still has, from
    /// where they were drawn
    virtual void end_frame(const HeadsetPictures* pictures, bool again) = 0;

    /// Vibrates a hand's controller if it can. @param amplitude 0 to 1
    virtual void vibrate(const std::string& device, interaction::Seconds duration,
                         float amplitude) = 0;
    /// Tells the runtime that the program ends, and continues until the runtime agrees, or a
    /// timeout.
    virtual void leave() = 0;

    /// `no headset is connected`, `Monado(XRT) 25.1.0, Simulated HMD`: one line for people.
    virtual std::string description() const = 0;
};

} // namespace isochron::stereo
