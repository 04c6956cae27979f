// The open windows of an installation: one context draws, the others only present.
//
//     Windows windows = open_windows(ContextKind::glfw, installation, {.title = "CAVE"});
//     const render::Gl gl(windows.drawing().loader());
#pragma once

#include "stereo/context/gl_context.h"
#include "stereo/installation.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::stereo {

/// Everything is drawn in the context `drawing()`, because contexts do not share vertex arrays and
/// framebuffers, and switching between contexts is slow. The windows' contexts only present.
class Windows {
  public:
    /// For an installation with one window: the caller's context, which outlives this.
    Windows(GlContext& only); // NOLINT: a context is a set of one window

    GlContext& drawing() const { return *drawing_; }
    std::size_t count() const { return windows_.size(); }
    GlContext& operator[](std::size_t window) const { return *windows_[window]; }
    /// Number of a window in the installation.
    std::size_t number(std::size_t window) const { return numbers_[window]; }
    /// The desktop window that shows the room of an emulated installation; null if the
    /// installation's windows are real. If there is one, its context draws, and the others are
    /// pictures without a window.
    GlContext* room() const { return room_; }
    /// The operator's window, which is not part of the installation; null: none. `poll_events` does
    /// not return its events.
    GlContext* console() const { return console_; }
    /// The window under the operator's panel: the room's, else the first.
    GlContext& first() const { return room_ ? *room_ : *windows_.front(); }

    bool should_close() const; ///< the user wants to close one of them
    void keep_open() const;    ///< takes back the wish to close, for all windows
    /// Events of all windows. Mouse positions are fractions of the window under the mouse.
    std::vector<interaction::WindowEvent> poll_events() const;
    /// Waits until any window, the console included, has something to poll; see `GlContext::wait`.
    void wait(const Wake& wake, interaction::Seconds longest) const { first().wait(wake, longest); }
    /// Whether the window system has lost what some window showed since the last call.
    bool take_damage() const;

  private:
    Windows() = default;
    friend Windows open_windows(ContextKind, const Installation&, const struct WindowOptions&);
    friend Windows open_room(ContextKind, const Installation&, const ContextOptions&);

    std::vector<std::unique_ptr<GlContext>> owned_; ///< the drawing context is the first
    std::vector<GlContext*> windows_;
    std::vector<std::size_t> numbers_;
    GlContext* drawing_ = nullptr;
    GlContext* room_ = nullptr;
    GlContext* console_ = nullptr;
};

struct WindowOptions {
    std::string title = "Isochron"; ///< further windows add their names
    /// The first window waits for the display; the others are presented right after it.
    bool vsync = true;
    StereoMode stereo{};                          ///< mode in which the first window starts
    ContextApi api = ContextApi::native;          ///< for making the windows' contexts
    std::optional<Window> console = std::nullopt; ///< the operator's window, if there is a desktop
    int rank = 0, ranks = 1;                      ///< process whose windows are opened, see nodes.h
};

/// Opens all windows of this process. Without a window system (`egl`, `osmesa`) each is a picture
/// in one context.
/// @throws render::Error naming the window
Windows open_windows(ContextKind kind, const Installation& installation,
                     const WindowOptions& options);

/// Makes the driver swap these windows together with the windows of other processes, see swap_group.h.
/// Pictures without a window are left out. @throws render::Error
void join_swap_group(const Windows& windows);

/// Opens one window that shows the room; the installation's windows are pictures without a window.
Windows open_room(ContextKind kind, const Installation& installation, const ContextOptions& room);

} // namespace isochron::stereo
