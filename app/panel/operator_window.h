// The operator's window: shows only the panel, beside the windows that viewers see.
#pragma once

#include "app/panel/imgui/panel_layer.h"
#include "render/gl/render_target.h"
#include "stereo/presenter.h"

#include <optional>
#include <vector>

namespace isochron::app {

/// Window pixels per panel pixel: as desktop and configuration ask, or less, so that the panel
/// keeps its least width. @param width of the picture under the panel, pixels
float panel_scale(const stereo::GlContext& window, float font_scale, int width);

class Console {
  public:
    /// @param drawing the drawing context, which is current
    /// @param window the console's context, which shares its textures
    /// All, with `gl`, outlive the console.
    Console(const render::Gl& gl, stereo::GlContext& drawing, stereo::GlContext& window,
            float font_scale);

    /// Handles the window's events since the last call.
    /// @return key events that the panel does not use: they control as in any other window
    std::vector<interaction::WindowEvent> take_events();

    std::optional<MovieWish> take_wanted_movie() { return layer_.take_wanted_movie(); }
    std::optional<OfferedSession> take_continued() { return layer_.pages().take_continued(); }
    DesktopWish take_desktop_wish() { return layer_.pages().take_desktop_wish(); }

    /// Lays out the panel over the whole window, and draws it if it looks different.
    /// @return commands of the operator
    interaction::Commands draw(const PanelModel& model, interaction::Seconds time);
    /// Shows what was drawn. @param again even if that is shown already
    void present(bool again = false);
    FrameOutlook outlook() const { return layer_.outlook(); } ///< see PanelLayer

    render::Image read() const { return picture_.read(); } ///< as drawn last

  private:
    stereo::GlContext& window_;
    const float font_scale_;
    PanelLayer layer_;
    render::RenderTarget picture_;
    std::optional<std::size_t> drawn_; ///< digest of what the picture shows
    bool fresh_ = false;               ///< the window does not show it yet
    stereo::Presenter presenter_;
};

} // namespace isochron::app
