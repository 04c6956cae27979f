// The operator's panel: over the first window, or alone in a window of its own.
#pragma once

#include "app/panel/imgui/panel_layer.h"
#include "app/panel/operator_window.h"
#include "stereo/windows.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

class OperatorPanel {
  public:
    /// Makes what the panel shows in a place; called only if the panel is laid out there.
    using Model = std::function<PanelModel(PanelPlace)>;

    /// @param gl outlives the panel, and so do the windows' contexts
    /// @param font_scale size of the panel, times the desktop's scale
    OperatorPanel(const render::Gl& gl, const stereo::Windows& windows, float font_scale = 1);

    /// Shows the lines of introduction over the first window until the user begins.
    void introduce() { over_.pages().introduce(); }
    bool introduced() {
        return over_.pages().introduced();
    } ///< true once, when the introduction has gone
    void explain_room() { over_.pages().explain_room(); }
    bool room_explained() { return over_.pages().room_explained(); } ///< true once
    /// See OpenPages.
    void offer_earlier() { over_.pages().offer_earlier(); }
    std::optional<OfferedSession> take_continued();
    /// @return false: a panel in its own window has no room for the question
    bool ask_session_name() {
        if (!console_)
            over_.pages().ask_session_name();
        return !console_;
    }
    std::optional<std::string> take_session_name() { return over_.pages().take_session_name(); }
    void offer_files(std::function<std::vector<std::filesystem::path>()> recent) {
        over_.pages().offer_files(std::move(recent));
    }
    void offer_beside_files(FileWindow::Offers offers) {
        over_.pages().offer_beside_files(std::move(offers));
    }
    std::optional<std::filesystem::path> take_chosen() { return over_.pages().take_chosen(); }
    void offer_arrays(std::vector<ListedArray> others) {
        over_.pages().offer_arrays(std::move(others));
    }
    std::optional<std::string> take_chosen_array() { return over_.pages().take_chosen_array(); }

    std::optional<MovieWish> take_wanted_movie();
    /// What the user wants of the desktop; returned once.
    DesktopWish take_desktop_wish();

    /// Passes window events to the panel. @param shown the panel lies over the first window
    /// @return the events that it does not use
    std::vector<interaction::WindowEvent> feed(std::span<const interaction::WindowEvent> events,
                                               bool shown);

    /// Lays out the panel over the first window's picture, unless this frame has done so.
    /// Does nothing if the panel has its own window, or there is no first window.
    /// @param picture its size, pixels @param time of the session
    /// @param places number of eyes side by side (x) and above each other (y) that each have a part
    /// of the picture: the panel appears in every part
    /// @return commands of the operator
    interaction::Commands lay_out_over(glm::ivec2 picture, glm::ivec2 places, const Model& model,
                                       interaction::Seconds time);
    /// A hash of all that `draw_over` would draw; 0: nothing.
    std::size_t looks() const { return laid_out_ ? over_.digest() : 0; }
    /// Lays the panel out over a picture and draws it there; the picture is bound.
    interaction::Commands draw_over(glm::ivec2 picture, glm::ivec2 places, const Model& model,
                                    interaction::Seconds time);
    /// Draws it in its own window, if it has one. @return commands of the operator
    interaction::Commands draw_alone(const Model& model, interaction::Seconds time);
    /// Shows its own window, if it has one, and ends the frame.
    /// @param again even if it looks the same, as the window system has lost it
    void present(bool again);
    /// What the last frame tells about the next one.
    FrameOutlook outlook() const { return console_ ? console_->outlook() : over_.outlook(); }
    /// Pixels that the panel covers at the edges of the picture; none where they would leave less
    /// than half of its width. @param size of the part of the picture that one eye has
    /// @param curves their drawer is open
    stereo::Margins covered(glm::ivec2 size, const PanelRows& rows) const;
    /// Height of the panel's words, as a share of that part's height.
    float text_share(glm::ivec2 size) const;
    /// Whether the panel over the picture is under the cursor.
    bool covers(const interaction::MouseMoveEvent& cursor) const;

  private:
    stereo::GlContext& first_; ///< window
    const float font_scale_;
    PanelLayer over_;
    bool laid_out_ = false; ///< in this frame, for the first buffer of its window
    std::optional<Console> console_;
};

} // namespace isochron::app
