// The pictures of a headset's eyes, and what a window shows of them.
#pragma once

#include "render/gl/image.h"
#include "stereo/display.h"
#include "stereo/headset.h"

#include <array>
#include <functional>
#include <optional>
#include <span>

namespace isochron::stereo {

/// What the window beside a headset shows.
enum class Mirror : std::uint8_t { left, right, both, none };

class HeadsetDisplay {
  public:
    /// Draws both eyes, as a Display's scene does. Called once.
    using Scene = Display::Scene;
    using Overlay = Display::Overlay;

    /// @param drawing the context that draws, current; @param window that of the mirror, which may
    /// be the same one; all of them outlive the display
    HeadsetDisplay(const render::Gl& gl, GlContext& drawing, GlContext& window, Mirror mirror,
                   const DisplayOptions& options);

    /// Draws each eye once.
    /// @param eyes left and right
    void draw(std::span<const HeadsetEye> eyes, const Scene& scene);

    /// Gives the headset what was drawn last, where the frame has eyes, and ends the frame.
    /// @param again it has been drawn for an earlier frame
    void submit(Headset& headset, std::span<const HeadsetEye> eyes, bool again);

    /// Shows the eyes drawn last in the window, cut to its shape, with an overlay.
    void mirror(const Overlay& overlay);
    void present();

    render::Image read_window() const { return window_picture_.read(); }
    /// @throws render::Error when that eye was never drawn
    render::Image read_eye(Eye eye) const;

  private:
    /// Where an eye's picture lies in the target.
    struct Part {
        glm::ivec2 corner{0}, size{0};
    };
    /// Covers a part of the window with as much of an eye's picture as has its shape.
    void cover(const Part& picture, glm::ivec2 corner, glm::ivec2 size) const;
    const Part& part(Eye eye) const { return parts_[eye == Eye::right]; }

    const render::Gl* gl_;
    bool in_software_;
    GlContext* window_;
    Mirror mirror_;
    DisplayOptions options_;
    Presenter presenter_;
    render::RenderTarget window_picture_;
    std::optional<render::RenderTarget> target_; ///< both eyes side by side, once they were drawn
    std::array<Part, 2> parts_;
};

} // namespace isochron::stereo
