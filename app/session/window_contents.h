// What the windows show, so that nothing is composed or presented twice.
#pragma once

#include "app/scene/picture.h"

#include <cstddef>
#include <optional>

namespace isochron::app {

/// What lies over the eyes' pictures.
struct PictureOverlay {
    Aids aids;
    std::size_t panel = 0; ///< a hash, see `OperatorPanel::looks`
    glm::ivec2 size{0};    ///< size of the first window
    bool operator==(const PictureOverlay&) const = default;
};

class WindowContents {
  public:
    void begin_frame() { composed_ = true; }
    /// The eyes' pictures are the same as in the last frame. @param overlay of this frame
    /// @return whether the windows show all of it, so that nothing is composed
    bool stay(const PictureOverlay& overlay) { return !(composed_ = overlay != shown_); }
    /// @param overlay of this frame @param drawn the eyes' pictures are new
    void end_frame(const PictureOverlay& overlay, bool drawn) {
        changed_ = drawn || overlay != shown_;
        shown_ = overlay;
    }
    /// Whether the windows were composed in this frame, and are to be presented.
    bool composed() const { return composed_; }
    /// Whether the last frame showed something new.
    bool changed() const { return changed_; }

  private:
    std::optional<PictureOverlay> shown_;
    bool composed_ = true, changed_ = true;
};

} // namespace isochron::app
