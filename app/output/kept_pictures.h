// Pictures to keep, drawn apart from those on the displays: nobody waits for them, so they have
// more samples.
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

/// Called with the number of a window in this process and with a display that shows what the window
/// shows, without anything laid over it; the display is gone afterwards.
using TakePicture = std::function<void(std::size_t window, const stereo::Display& display)>;

/// What the windows show, drawn once more. One window is drawn at a time, so that no more memory is
/// needed than for the largest.
struct KeptPictures {
    const render::Gl& gl;
    const stereo::Windows& windows;
    const Config& config;
    std::deque<stereo::Display>& shown; ///< by window; they serve if they have as many samples
    std::optional<RoomView>& room;      ///< of an emulated installation
    /// Draws a window once more as it was drawn last.
    std::function<void(stereo::Display& display)> draw;
    bool differ = false; ///< something is shown that they leave out

    void each(const TakePicture& take) const;
    /// The room, with its walls. There must be one.
    render::Image of_room() const;

  private:
    bool serves(std::size_t window) const;
    stereo::DisplayOptions options(std::size_t window) const;
};

} // namespace isochron::app
