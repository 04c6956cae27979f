// The viewer's comfort: darkens the picture while tracking is lost, narrows it while flying.
#pragma once

#include "interaction/input/tracked_input.h"
#include "interaction/pose.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>

namespace isochron::interaction {

struct ComfortOptions {
    bool vignette = false;         ///< meant for head-mounted displays
    double vignette_speed = 0.5;   ///< [m/s] of the volume past the viewer: starts to close
    double vignette_full = 2.0;    ///< [m/s] closed
    double vignette_turn = 0.5;    ///< [rad/s] of the volume's turning: starts to close
    double vignette_turn_full = 2; ///< [rad/s] closed
    Seconds vignette_fade{0.15};   ///< time to close or open all the way
    bool fade_when_lost = true;
    /// [m] from the point between the eyes: what is nearer than x is not drawn, what is beyond y is
    /// drawn whole; it fades between them. Both 0: everything is drawn.
    glm::vec2 near_fade{0.0f};
    Seconds lost_fade{0.5}; ///< time from the full picture to black, once the head is lost
    bool operator==(const ComfortOptions&) const = default;
};

/// Strengths for the renderer, each from 0 (no effect) to 1.
struct ComfortState {
    double fade = 0;     ///< how far the whole picture fades towards black
    double vignette = 0; ///< how far the field of view is narrowed
    bool operator==(const ComfortState&) const = default;
};

/// Depends only on the inputs and similarities that it was given, so a replay shows the same.
class Comfort {
  public:
    explicit Comfort(const ComfortOptions& options) : options_(options) {}
    /// Advances by one frame. The vignette follows the volume's motion past the head, whatever
    /// moved the volume; the head's own motion does not count.
    /// @param leaps_to `Settings::story` where its steps come by a fade: a change darkens the picture
    /// for a moment, in which the view leaps; 0: no story
    ComfortState update(const InputState& input, const Similarity& room_from_physical,
                        std::uint32_t leaps_to = 0);

  private:
    double wanted_vignette(const glm::dvec3& head, const Similarity& volume, double seconds) const;

    ComfortOptions options_;
    ComfortState state_;
    double lost_ = 0, leap_ = 0; ///< what a lost head, and a leap, make of `fade`
    std::uint32_t leapt_to_ = 0;
    Seconds dark_until_{0};
    std::optional<Seconds> time_;
    Similarity before_;
};

} // namespace isochron::interaction
