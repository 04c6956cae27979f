// The operator's window: nothing but the panel, beside the windows that viewers see.
#pragma once

#include "app/panel/panel_layer.h"
#include "render/gl/render_target.h"
#include "stereo/presenter.h"

#include <optional>
#include <vector>

namespace isochron::app {

/// Pixels of a window for each of its panel's own: what the desktop and the configuration ask for,
/// as long as the panel has its least width. @param width of the picture under the panel, pixels
float panel_scale(const stereo::GlContext& window, float font_scale, int width);

class Console {
  public:
    /// @param drawing the context that draws, current; @param window the console's, which shares
    /// its textures; both, and `gl`, outlive the console
    Console(const render::Gl& gl, stereo::GlContext& drawing, stereo::GlContext& window,
            float font_scale);

    /// Takes what happened in the window since the last call.
    /// @return keys that the panel has no use for: they steer as in any other window
    std::vector<interaction::WindowEvent> take_events();

    std::optional<MovieWish> take_wanted_movie() { return layer_.take_wanted_movie(); }

    /// Lays out and draws the panel over all of the window. @return what the operator did
    interaction::Commands draw(const PanelModel& model, interaction::Seconds time);
    void present();

    render::Image read() const { return picture_.read(); } ///< as drawn last

  private:
    stereo::GlContext& window_;
    const float font_scale_;
    PanelLayer layer_;
    render::RenderTarget picture_;
    stereo::Presenter presenter_;
};

} // namespace isochron::app
