// Draws the pictures of a headset's eyes, and mirrors them in a window.
#pragma once

#include "render/gl/image.h"
#include "stereo/display.h"
#include "stereo/headset.h"

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace isochron::stereo {

/// Which eyes the window beside a headset shows.
enum class Mirror : std::uint8_t { left, right, both, none };

class HeadsetDisplay {
  public:
    /// Draws both eyes, as a Display's scene does. Called once.
    using Scene = Display::Scene;
    using Overlay = Display::Overlay;

    /// @param drawing the drawing context, which is current
    /// @param window the mirror's context, which may be the same one
    /// All of them outlive the display.
    HeadsetDisplay(const render::Gl& gl, GlContext& drawing, GlContext& window, Mirror mirror,
                   const DisplayOptions& options);

    /// Draws each eye once.
    /// @param eyes left and right
    void draw(std::span<const HeadsetEye> eyes, const Scene& scene);

    /// Draws a part of the next picture while the last one stays on show.
    /// @param eyes of the last picture @param begins this is the first part
    /// @return whether the picture is complete, as `scene` said
    bool draw_part(std::span<const HeadsetEye> eyes, bool begins, const DrawPart& scene);
    /// The next picture, which must be complete, becomes the last one.
    void show_parts() { std::swap(target_, next_); }

    /// Gives the last pictures to the headset, if the frame has eyes, and ends the frame.
    /// @param again the pictures were drawn for an earlier frame
    void submit(Headset& headset, std::span<const HeadsetEye> eyes, bool again);

    /// Draws the last pictures into the window, cropped to its shape, with an overlay.
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
    std::vector<render::View> views_in_target(std::span<const HeadsetEye> eyes);
    /// Covers a part of the window with the largest crop of an eye's picture that has its shape.
    void cover(const Part& picture, glm::ivec2 corner, glm::ivec2 size) const;
    const Part& part(Eye eye) const { return parts_[eye == Eye::right]; }

    const render::Gl* gl_;
    bool in_software_;
    GlContext* window_;
    Mirror mirror_;
    DisplayOptions options_;
    Presenter presenter_;
    render::RenderTarget window_picture_;
    std::optional<render::RenderTarget> target_; ///< both eyes side by side; empty before `draw`
    std::optional<render::RenderTarget> next_;   ///< next picture of both eyes, drawn in parts
    glm::ivec2 whole_{0};                        ///< size of both eyes' pictures
    std::array<Part, 2> parts_;
};

} // namespace isochron::stereo
