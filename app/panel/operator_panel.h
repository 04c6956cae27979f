// The operator's panel: over the first window, or alone in a window of its own.
#pragma once

#include "app/panel/operator_window.h"
#include "app/panel/panel_layer.h"
#include "stereo/windows.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

class OperatorPanel {
  public:
    /// What the panel shows in such a place; asked for only where it is laid out.
    using Model = std::function<PanelModel(PanelPlace)>;

    /// @param gl outlives the panel, as do the windows' contexts
    /// @param font_scale its size, times what the desktop asks for
    OperatorPanel(const render::Gl& gl, const stereo::Windows& windows, float font_scale = 1);

    /// The first four lines stand over the first window until somebody has begun.
    void introduce() { over_.introduce(); }
    bool introduced() { return over_.introduced(); } ///< they have gone, told once
    /// See PanelLayer.
    void offer_files(std::function<std::vector<std::filesystem::path>()> recent) {
        over_.offer_files(std::move(recent));
    }
    std::optional<std::filesystem::path> take_chosen() { return over_.take_chosen(); }

    std::optional<MovieWish> take_wanted_movie();

    /// Passes window events to the panel. @param shown it lies over the first window
    /// @return those that it has no use for
    std::vector<interaction::WindowEvent> feed(std::span<const interaction::WindowEvent> events,
                                               bool shown);

    /// Draws the panel over the first window's picture, which is bound; lays it out once a frame.
    /// Nothing where the panel has a window of its own, or the picture has none.
    /// @param picture its size, pixels @param time of the session
    /// @param places eyes that have a part of the picture each, beside and above one another: the
    /// panel stands in every part
    /// @return what the operator did
    interaction::Commands draw_over(glm::ivec2 picture, glm::ivec2 places, const Model& model,
                                    interaction::Seconds time);
    /// Draws it in its own window, where it has one. @return what the operator did
    interaction::Commands draw_alone(const Model& model, interaction::Seconds time);
    /// Shows its own window, where it has one, and ends the frame.
    void present();
    /// Pixels of a picture's width, from its left, that the panel over it covers; 0 where it is folded,
    /// or would cover more than half. @param width of the part of the picture that an eye has
    int covered(int width) const;
    /// Whether the panel over the picture is under the cursor.
    bool covers(const interaction::MouseMoveEvent& cursor) const;

  private:
    stereo::GlContext& first_; ///< window
    const float font_scale_;
    PanelLayer over_;
    bool laid_out_ = false; ///< in this frame, over one buffer of its window
    std::optional<Console> console_;
};

} // namespace isochron::app
