// A headset that a test plays: its properties, its poses, and what the program did with it.
//
//     PlayedHeadset& headset = played_headset();
//     headset.head = {{0.2f, 1.7f, 0.1f}, {1, 0, 0, 0}};
//     run_the_program();   // through the real OpenXR loader
//     EXPECT_THAT(headset.violations, IsEmpty());
//     EXPECT_TRUE(images_match(headset.frames.back().views[0].picture, expected, {}, "left"));
#pragma once

#include "interaction/pose.h"
#include "render/gl/image.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#define PLAYED_HEADSET_API __attribute__((visibility("default")))

namespace isochron::played {

/// Angles from straight ahead [rad], left and down negative.
struct Fov {
    float left = -0.9f, right = 0.8f, up = 0.85f, down = -0.95f;
    bool operator==(const Fov&) const = default;
};

struct Eye {
    interaction::Pose in_head;
    Fov fov;
    glm::ivec2 size{96, 96}; ///< recommended
};

struct Hand {
    bool present = false; ///< bound to an interaction profile
    bool tracked = true;
    interaction::Pose grip, aim;         ///< in the stage
    interaction::Velocity velocity;      ///< velocity of both poses
    std::map<std::string, float> inputs; ///< `squeeze/value`: 1
};

/// A call that the specification forbids, or that only a careless program makes.
struct Violation {
    std::string code; ///< `begin_before_ready`
    std::string call; ///< `xrBeginSession`
    std::string text;
};

struct Pulse {
    std::string hand; ///< `/user/hand/right`
    std::int64_t nanoseconds = 0;
    float amplitude = 0;
};

/// One view of a projection layer that was submitted.
struct SubmittedView {
    interaction::Pose pose; ///< in the stage
    Fov fov;
    render::Image picture;    ///< empty while pictures are not kept
    std::vector<float> depth; ///< from the top left; empty without a depth layer
    float near_z = 0, far_z = 0;
};
struct SubmittedFrame {
    std::int64_t display_time = 0;
    std::vector<SubmittedView> views; ///< none: a frame without a layer
};

/// What happens at the runtime's next event or frame.
enum class Happening : std::uint8_t {
    exit,         ///< the user ends the program from the runtime's menu
    hide,         ///< another program is shown: SYNCHRONIZED, nothing to render
    cover,        ///< VISIBLE without input focus
    show,         ///< FOCUSED again
    recenter,     ///< the reference spaces move
    lose_session, ///< LOSS_PENDING, then every call fails
    lose_at_once, ///< the session fails without an event
    lose_instance ///< the runtime dies
};

class PlayedHeadset {
  public:
    // Properties, read when an instance or a session is made.
    bool runtime_available = true, connected = true;
    bool has_stage = true, has_depth = true, has_egl = true, has_xlib = true, has_clock = true;
    std::array<Eye, 2> eyes;
    std::string profile = "/interaction_profiles/oculus/touch_controller";
    std::vector<std::int64_t> formats; ///< offered for swapchains
    interaction::Pose local_in_stage{{0.4f, 1.5f, -0.2f}, {1, 0, 0, 0}};
    std::int64_t period = 11'111'111; ///< [ns]
    bool paced = false;               ///< one frame per period; else as fast as possible

    // Poses.
    interaction::Pose head{{0.0f, 1.6f, 0.0f}, {1, 0, 0, 0}};
    interaction::Velocity head_velocity;
    bool head_tracked = true, head_valid = true;
    Hand left, right;

    // What the program did.
    std::vector<Violation> violations;
    std::vector<SubmittedFrame> frames; ///< frames of all sessions of this process
    std::vector<Pulse> pulses;
    std::vector<std::string> suggested; ///< `PROFILE ACTION PATH`
    unsigned instances = 0, sessions = 0, waits = 0;
    bool keep_pictures = true;

    PLAYED_HEADSET_API PlayedHeadset();
    PLAYED_HEADSET_API void happens(Happening what);
    /// Back to the initial state; call only while there is no instance.
    PLAYED_HEADSET_API void reset();
};

/// The headset of this process's runtime. In a separate program a script plays it, which the
/// variable ISOCHRON_PLAYED_HEADSET names (script.cpp).
PLAYED_HEADSET_API PlayedHeadset& played_headset();

} // namespace isochron::played
