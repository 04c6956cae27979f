// A window with nothing but one page of the panel, before there are data to show.
#pragma once

#include "app/frame/idle_wait.h"
#include "app/frame/pacer.h"
#include "app/panel/operator_window.h"
#include "render/gl/gl.h"
#include "render/gl/render_target.h"
#include "stereo/presenter.h"
#include "stereo/windows.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace isochron::app {

struct PageWindowOptions {
    /// Called in each frame: true ends the page.
    std::function<bool()> ended = [] { return false; };
    glm::vec3 background{0.0f};   ///< sRGB
    double frame_rate_limit = 60; ///< [Hz]
    float font_scale = 1;         ///< times what the desktop asks for
    /// Ends the wait of a page on which only the user changes something. Null: the page may change
    /// at any time, so it never waits.
    std::shared_ptr<const stereo::Wake> wake = nullptr;
    /// Gets the events that the page does not use; null: they are dropped.
    std::vector<interaction::WindowEvent>* others = nullptr;
};

/// Draws in the first of the windows, whose context is current from then on.
class PageWindow {
  public:
    /// @param windows outlive this
    PageWindow(const stereo::Windows& windows, PageWindowOptions options);

    PanelLayer& layer() { return layer_; }
    /// Passes events to the page and makes one frame, at the window's pace, or once something
    /// happens. It is presented if it looks different.
    /// @param lay_out lays out the page in a picture of this size, at this time since the start
    /// @return the events that the page does not use
    std::vector<interaction::WindowEvent>
    frame(const std::function<void(glm::ivec2 size, interaction::Seconds time)>& lay_out);
    /// False once the user closes the window, or `ended` says so.
    bool goes_on() const { return !windows_.should_close() && !options_.ended(); }
    std::vector<std::filesystem::path> take_dropped() { return window_.take_dropped(); }

  private:
    const stereo::Windows& windows_;
    const PageWindowOptions options_;
    stereo::GlContext& window_;
    const render::Gl gl_;
    PanelLayer layer_;
    render::RenderTarget picture_;
    stereo::Presenter presenter_;
    Pacer pacer_;
    IdleWait idle_;
    std::optional<std::size_t> shown_; ///< digest of the layout that the window shows
    interaction::Seconds now() const { return std::chrono::steady_clock::now() - start_; }

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace isochron::app
