// Pictures to keep (screenshots, movies): drawn apart from those on the displays, with more
// samples, as no viewer waits for them.
//
//     const KeptPictures kept{gl, windows, config, displays, room, [&](auto& display) {
//         display.draw(viewers, mode, scene);
//     }};
//     kept.each([&](std::size_t window, const stereo::Display& display) {
//         write(display.read_window());
//     });
#pragma once

#include "app/config/config.h"
#include "app/output/displays.h"
#include "app/output/room_view.h"
#include "stereo/windows.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>

namespace isochron::app {

/// Called with a window's number in this process, and a display with the same picture as the window
/// but without an overlay. The display is valid only during the call.
using TakePicture = std::function<void(std::size_t window, const stereo::Display& display)>;

/// Draws the windows' pictures once more, one window at a time, so that memory is needed only for
/// the largest one.
struct KeptPictures {
    const render::Gl& gl;
    const stereo::Windows& windows;
    const Config& config;
    std::deque<stereo::Display>& shown; ///< by window; used as they are if their samples suffice
    std::optional<RoomView>& room;      ///< room of an emulated installation
    /// Draws the last frame of a window once more, into `display`.
    std::function<void(stereo::Display& display)> draw;
    /// Options for a picture of so many pixels; empty: `picture_options`.
    std::function<stereo::DisplayOptions(glm::ivec2 size)> drawn_with;
    bool settled = false; ///< the shown pictures are means of all samples
    bool differ = false;  ///< pictures to keep differ from the shown ones, by caption or aids

    void each(const TakePicture& take_one) const;
    void take(std::size_t window, const TakePicture& take_one) const;
    /// The picture of the emulated room, which must exist, with its walls.
    render::Image of_room() const;

  private:
    bool serves(std::size_t window) const;
    stereo::DisplayOptions options(std::size_t window) const;
};

} // namespace isochron::app
