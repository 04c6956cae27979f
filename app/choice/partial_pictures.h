// Pictures that are drawn over several frames beside the one that is shown: the exact picture at
// rest, and exact pictures to move while the head sways.
#pragma once

#include "app/choice/frame.h"
#include "app/choice/picture_in_pieces.h"
#include "app/frame/stop_watch.h"
#include "app/output/outputs.h"
#include "app/scene/scene.h"

#include <optional>

namespace isochron::app {

class PartialPictures {
  public:
    /// All outlive these pictures.
    PartialPictures(Scene& scene, Outputs& outputs, FrameQuality& quality)
        : scene_(scene), outputs_(outputs), quality_(quality) {}

    /// Begins a frame, whose picture is `now`.
    /// @param shown the picture in parts is shown already
    void begin_frame(bool shown) { whole_ = shown; }
    /// Draws as much of the picture at rest as this frame has time for, and shows it once it is
    /// whole, in a cluster: once it is whole in all processes, which show it in the same frame.
    /// @param now picture of this frame, which gets the footprint of the plan
    /// @return the picture if it is shown; else empty, and what was shown stays to be shown
    std::optional<Picture> draw(const Frame& frame, const Picture& now,
                                const Outputs::Overlay& overlay);
    /// Gives up the picture at rest, unless it shows the same cells as the one that is drawn.
    void give_up_others(const Picture& drawn);

    /// While the head sways, draws the exact picture for where the eyes were when it was begun, in the
    /// time that frames leave. Once it is whole it is kept, for the pictures that are moved, and its
    /// cost is learnt. Not for translucent surfaces, which cannot be moved.
    /// @param begun with the frame, which is on show now
    void draw_ahead(const Frame& frame, const Picture& now, const StopWatch& begun);

    /// Whether the picture in parts is whole, or shown.
    bool are_whole() const { return whole_; }
    /// The time that it took, while it is whole and not shown.
    Milliseconds took() const {
        return parts_ && parts_->whole ? parts_->pace.whole() : Milliseconds(0);
    }
    /// Whether there is more to be drawn of one in the next frame.
    bool are_made() const { return (parts_ && !parts_->whole) || ahead_; }

  private:
    void draw_ahead_within(Milliseconds left, const Frame& frame, const Picture& now);

    Scene& scene_;
    Outputs& outputs_;
    FrameQuality& quality_;
    std::optional<PictureInPieces> parts_; ///< the next picture, if it is made in parts
    std::optional<PictureInPieces> ahead_; ///< one for where the eyes were a moment ago
    bool whole_ = false;
};

} // namespace isochron::app
