// A headset: when it wants a picture, where its eyes are then, and what its wearer does.
//
//     headset->update(now);                            // events, and a lost one comes back
//     const auto frame = headset->begin_frame(now);    // blocks: the headset paces the program
//     const auto input = headset->poll(now);
//     for (const HeadsetEye& eye : headset->eyes())    // as late as can be
//         draw(view_of(eye, near_plane, far_plane));
//     if (frame)
//         headset->end_frame(&pictures, false);
#pragma once

#include "interaction/tracked_input.h"
#include "render/gl/render_target.h"
#include "render/gl/view.h"
#include "stereo/context/gl_context.h"
#include "stereo/stereo_mode.h"

#include <array>
#include <span>
#include <string>

namespace isochron::stereo {

/// Angles [rad] between straight ahead and the edges of an eye's picture; left and down negative.
struct FieldOfView {
    float left = 0, right = 0, up = 0, down = 0;
    bool operator==(const FieldOfView&) const = default;
};

/// One eye for one picture. Eyes may be canted: each has its own direction.
struct HeadsetEye {
    Eye eye = Eye::left;
    interaction::Pose pose; ///< in the room
    FieldOfView fov;
    glm::ivec2 pixels{0};
    bool operator==(const HeadsetEye&) const = default;
};

/// Whether it can be drawn for: all finite, left of right, down below up, all within 90 degrees.
bool is_drawable(const HeadsetEye& eye);

/// The view of an eye: its edges fall on the edges of clip space.
/// @param near_plane, far_plane [m] along the eye's direction, 0 < near < far
render::View view_of(const HeadsetEye& eye, float near_plane, float far_plane);

/// What an eye is to be shown: a part of a target, of the eye's size.
struct HeadsetPicture {
    const render::RenderTarget* target = nullptr;
    glm::ivec2 corner{0}; ///< lower left in the target
};
using HeadsetPictures = std::array<HeadsetPicture, 2>; ///< left, right

enum class HeadsetState : std::uint8_t {
    absent, ///< no runtime, or no headset: tried again by `update`
    idle,   ///< it does not want frames now
    running,
    ended ///< its user has ended the program
};

struct HeadsetFrame {
    interaction::Seconds display_time{0}; ///< session time at which the picture is seen
    interaction::Seconds period{0};       ///< between two frames
};

/// The devices that `poll` states are `head`, `wand` and `wand2`, and `keys` for what buttons of
/// the hands ask for besides.
class Headset : public interaction::TrackedInput {
  public:
    /// What the context that it shows from has to be made with.
    virtual ContextApi context_api() const = 0;
    /// Shows from this context, current now and in every call from now on, until `detach`; both
    /// outlive that. @throws render::Error when the headset can never show from it
    virtual void attach(GlContext& drawing, const render::Gl& gl) = 0;
    /// Lets go of everything that belongs to the context.
    virtual void detach() = 0;

    virtual HeadsetState update(interaction::Seconds now) = 0;
    /// @return nothing when no frame has begun: then nothing has blocked either
    virtual std::optional<HeadsetFrame> begin_frame(interaction::Seconds now) = 0;
    /// Where the eyes will be when the frame is seen, left and right; empty when nothing is to be
    /// drawn.
    virtual std::vector<HeadsetEye> eyes() = 0;
    /// Ends the frame that has begun, if one has.
    /// @param pictures null: nothing is shown
    /// @param again they are those of the frame before, which the headset still has
    virtual void end_frame(const HeadsetPictures* pictures, bool again) = 0;

    /// Lets a hand feel something, where the hand can. @param amplitude 0 to 1
    virtual void vibrate(const std::string& device, interaction::Seconds duration,
                         float amplitude) = 0;
    /// Tells the runtime that the program ends, and takes part until it agrees or has not for a
    /// moment.
    virtual void leave() = 0;

    /// `no headset is connected`, `Monado(XRT) 25.1.0, Simulated HMD`: one line for people.
    virtual std::string description() const = 0;
};

} // namespace isochron::stereo
