// More samples of each pixel of a settled picture: it is drawn again and again, moved by part of a
// pixel, and its mean is shown. An exact picture has soft edges some frames after it is shown.
#pragma once

#include "app/choice/picture_in_pieces.h"
#include "app/quality/frame_quality.h"

#include <optional>

namespace isochron::app {

class SettledSamples {
  public:
    /// All outlive these samples.
    SettledSamples(Scene& scene, Outputs& outputs, const FrameQuality& quality)
        : scene_(scene), outputs_(outputs), quality_(quality) {}

    /// Begins a frame. @param settled its picture is exact, and nothing else is going on
    void begin_frame(bool settled) { settled_ = settled; }
    /// Whether the picture will get more samples if nothing changes.
    bool are_missing() const {
        return settled_ && outputs_.passes() > 1 && outputs_.in_mean() < outputs_.passes();
    }
    /// Takes some, in the time that a frame may spend on parts. The first are those of the picture
    /// that the windows show.
    /// @return whether a better mean is there, to be shown as a picture in parts is
    bool take(const Picture& drawn);
    /// Something else is drawn.
    void give_up();

  private:
    Scene& scene_;
    Outputs& outputs_;
    const FrameQuality& quality_;
    std::optional<PictureInPieces> next_; ///< the picture that takes the next samples
    bool settled_ = false;
};

} // namespace isochron::app
