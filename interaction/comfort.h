// What eases a viewer: how dark the picture is while tracking is lost, how narrow while flying.
#pragma once

#include "interaction/pose.h"
#include "interaction/tracked_input.h"

namespace isochron::interaction {

struct ComfortOptions {
    bool vignette = false;         ///< for pictures that the head carries
    double vignette_speed = 0.5;   ///< [m/s] of the volume past the viewer from which it closes
    double vignette_full = 2.0;    ///< [m/s] at which it is closed
    double vignette_turn = 0.5;    ///< [rad/s] and
    double vignette_turn_full = 2; ///< [rad/s] for turning
    Seconds vignette_fade{0.15};   ///< to close or open all the way
    bool fade_when_lost = true;
    /// [m] from between the eyes: what is nearer than the first is not drawn, beyond the second
    /// all; both 0: all, at any distance.
    float near_gone = 0, near_whole = 0;
    Seconds lost_fade{0.5}; ///< from the full picture to darkness, once the head is lost
    bool operator==(const ComfortOptions&) const = default;
};

/// What the drawing needs: each from 0, as if there were none, to 1.
struct ComfortState {
    double fade = 0;     ///< of the whole picture towards black
    double vignette = 0; ///< of the field of view
    bool operator==(const ComfortState&) const = default;
};

/// Pure function of the inputs and navigations that it was given: a replay shows the same.
class Comfort {
  public:
    explicit Comfort(const ComfortOptions& options) : options_(options) {}
    /// One frame. The volume's motion past the head counts, whatever moved it; not the head's own.
    ComfortState update(const InputState& input, const Similarity& room_from_physical);

  private:
    double wanted_vignette(const glm::dvec3& head, const Similarity& volume, double seconds) const;

    ComfortOptions options_;
    ComfortState state_;
    std::optional<Seconds> time_;
    Similarity before_;
};

} // namespace isochron::interaction
